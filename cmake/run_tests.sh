#!/usr/bin/env bash
# Runs tests of a build folder: run_tests.sh BUILD [CTEST ARGUMENTS]. Prints their figures, what failed ones said,
# and last "N passed, N failed", with the number of skipped tests if test data is missing. JOBS and TIMEOUT, the seconds
# that a test may take, may be set in the environment.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
shift

log="$build/tests.log"
status=0
ctest --test-dir "$build" --verbose --no-tests=error --timeout "${TIMEOUT:-900}" \
    -j "${JOBS:-$(nproc)}" "$@" > "$log" 2>&1 || status=$?
grep -E '^[0-9]+: (SKIPPED|FIGURE)|^ *[0-9]+/[0-9]+ Test|\*\*\*' "$log" | sed -E 's/^[0-9]+: //' || true
for number in $(sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#([0-9]+):.*\*\*\*.*/\1/p' "$log"); do
    grep -E "^$number: " "$log" | sed -E 's/^[0-9]+: //' | grep -vE '^(SKIPPED|FIGURE)' | tail -n 100
done

# Each test program closes with Catch2's summary; a program without one (a crash, the layer check) counts as one test.
awk -v status=$status '
    /All tests passed \(/ { match($0, /in [0-9]+ test case/); passed += substr($0, RSTART + 3, RLENGTH - 13); counted++ }
    /test cases: / {
        if (match($0, /[0-9]+ passed/)) passed += substr($0, RSTART, RLENGTH - 7)
        if (match($0, /[0-9]+ failed/)) { failed += substr($0, RSTART, RLENGTH - 7); counted_failure++ }
    }
    /^[0-9]+: SKIPPED/ { skipped++ }
    /^[0-9]+: FIGURE fuzzed calls of / { fuzzed += $NF }
    / Test +#.*\*\*\*/ { bad++ }
    / Test +#.*Passed/ { good++ }
    END {
        if (good > counted) passed += good - counted
        if (bad > counted_failure) failed += bad - counted_failure
        if (status != 0 && failed == 0) failed = 1
        passed -= skipped
        if (fuzzed) printf("FIGURE fuzzed calls in all: %d\n", fuzzed)
        line = sprintf("%d passed, %d failed", passed, failed)
        if (skipped) line = line sprintf(", %d skipped", skipped)
        print line
    }' "$log"
exit $status
