#!/usr/bin/env bash
# Builds the sample, path traces its Cornell box on any Vulkan device (lavapipe if there is no other), denoises it and
# writes noisy.png, denoised.png, reference.png and side-by-side.png to the folder given (default: demo).
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-demo}
build=${BUILD_DIR:-build}

bash cmake/packages.sh
if [ ! -f "$build/build.ninja" ]; then cmake --preset release -B "$build"; fi
cmake --build "$build" -j "${JOBS:-$(nproc)}" --target nrd-sample
mkdir -p "$out"
"$build/bin/nrd-sample" --headless --demo "$out"
