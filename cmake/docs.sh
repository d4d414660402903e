#!/usr/bin/env bash
# docs.sh [FOLDER]: the reference by Doxygen, as HTML in FOLDER, build/docs unless given. Fails on any warning.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/docs}
mkdir -p "$folder"
{ cat cmake/Doxyfile; echo "OUTPUT_DIRECTORY = $folder"; } | doxygen -
echo "$folder/html/index.html"
