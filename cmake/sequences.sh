#!/usr/bin/env bash
# Renders the recorded sequences into the build folder given, where the test data is: once, in about a minute.
set -euo pipefail
build=$1
data=$(sed -n 's/^NRD_TEST_DATA:PATH=//p' "$build/CMakeCache.txt")
if [ -f "$data/peer/make-sequences.sh" ] && [ ! -f "$build/sequences/complete" ]; then
    echo "Rendering the recorded sequences"
    bash "$data/peer/make-sequences.sh" "$build/sequences"
    touch "$build/sequences/complete"
fi
