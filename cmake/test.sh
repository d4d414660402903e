#!/usr/bin/env bash
# Builds the project and runs its tests on any Vulkan device, lavapipe if there is no other.
# Closes with "N passed, N failed", and the number of skipped tests if test data is missing.
# With --long every suite runs its long form (NRD_TEST_LONG=1 in the environment of the tests).
# BUILD_DIR, NRD_TEST_DATA and JOBS may be set in the environment.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in
    "") ;;
    --long) export NRD_TEST_LONG=1 ;;
    *) echo "usage: $0 [--long]" >&2; exit 2 ;;
esac
build=${BUILD_DIR:-build}
jobs=${JOBS:-$(nproc)}

bash cmake/packages.sh
options=(-DNRD_WERROR=ON)
[ -z "${NRD_TEST_DATA:-}" ] || options+=("-DNRD_TEST_DATA=$NRD_TEST_DATA")
if [ ! -f "$build/build.ninja" ]; then cmake --preset ci -B "$build" "${options[@]}"; fi
cmake --build "$build" -j "$jobs"

# The recorded sequences, where the test data is: rendered once, in about a minute.
data=$(sed -n 's/^NRD_TEST_DATA:PATH=//p' "$build/CMakeCache.txt")
if [ -f "$data/peer/make-sequences.sh" ] && [ ! -f "$build/sequences/complete" ]; then
    echo "Rendering the recorded sequences"
    bash "$data/peer/make-sequences.sh" "$build/sequences"
    touch "$build/sequences/complete"
fi

log="$build/tests.log"
status=0
ctest --test-dir "$build" --verbose --timeout 900 -j 2 > "$log" 2>&1 || status=$?
grep -E '^[0-9]+: (SKIPPED|FIGURE)|^ *[0-9]+/[0-9]+ Test|\*\*\*' "$log" | sed -E 's/^[0-9]+: //' || true
if [ $status -ne 0 ]; then grep -E '^[0-9]+: ' "$log" | sed -E 's/^[0-9]+: //' | grep -vE '^(SKIPPED|FIGURE)' | tail -n 200; fi

# Each test program closes with Catch2's summary; a program without one (a crash, the layer check) counts as one test.
awk -v status=$status '
    /All tests passed \(/ { match($0, /in [0-9]+ test case/); passed += substr($0, RSTART + 3, RLENGTH - 13); counted++ }
    /test cases: / {
        if (match($0, /[0-9]+ passed/)) passed += substr($0, RSTART, RLENGTH - 7)
        if (match($0, /[0-9]+ failed/)) { failed += substr($0, RSTART, RLENGTH - 7); counted_failure++ }
    }
    /^[0-9]+: SKIPPED/ { skipped++ }
    / Test +#.*\*\*\*/ { bad++ }
    / Test +#.*Passed/ { good++ }
    END {
        if (good > counted) passed += good - counted
        if (bad > counted_failure) failed += bad - counted_failure
        if (status != 0 && failed == 0) failed = 1
        passed -= skipped
        line = sprintf("%d passed, %d failed", passed, failed)
        if (skipped) line = line sprintf(", %d skipped", skipped)
        print line
    }' "$log"
exit $status
