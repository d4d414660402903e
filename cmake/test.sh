#!/usr/bin/env bash
# Builds the project and runs its tests on any Vulkan device, lavapipe if there is no other.
# Closes with "N passed, N failed", and the number of skipped tests if test data is missing.
# With --long every suite runs its long form (NRD_TEST_LONG=1 in the environment of the tests). With --middle those run
# that have a form between (NRD_TEST_MIDDLE=1) or take too long for the short one: what the landing check runs besides.
# BUILD_DIR, NRD_TEST_DATA and JOBS may be set in the environment.
set -euo pipefail
cd "$(dirname "$0")/.."
tests=()
case "${1:-}" in
    "") tests=(-LE landing) ;;
    --middle) export NRD_TEST_MIDDLE=1 TIMEOUT=${TIMEOUT:-2400}; tests=(-L 'middle|landing') ;;
    --long) export NRD_TEST_LONG=1 TIMEOUT=${TIMEOUT:-14400} ;;
    *) echo "usage: $0 [--middle|--long]" >&2; exit 2 ;;
esac
build=${BUILD_DIR:-build}
jobs=${JOBS:-$(nproc)}

bash cmake/packages.sh
options=(-DNRD_WERROR=ON)
[ -z "${NRD_TEST_DATA:-}" ] || options+=("-DNRD_TEST_DATA=$NRD_TEST_DATA")
if [ ! -f "$build/build.ninja" ]; then cmake --preset ci -B "$build" "${options[@]}"; fi
cmake --build "$build" -j "$jobs"

bash cmake/sequences.sh "$build"
exec bash cmake/run_tests.sh "$build" "${tests[@]}"
