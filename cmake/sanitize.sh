#!/usr/bin/env bash
# Builds with Clang's sanitizers what needs no picture to be right, and runs it:
#   memory   AddressSanitizer and UndefinedBehaviorSanitizer over the unit, conformance and integration tests and the
#            fuzz targets
#   threads  ThreadSanitizer over objects side by side on threads
# Without an argument both. Closes with "N passed, N failed". JOBS may be set in the environment.
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
    "") exec bash cmake/total.sh "bash cmake/sanitize.sh memory" "bash cmake/sanitize.sh threads" ;;
    memory)
        preset=sanitize
        targets=(nrd-test-{nrd,rhi,integration,plugin,threads,capture,sample} nrd-fuzz-{nrd,integration,plugin,settings,gltf,capture})
        tests='nrd|rhi|integration|plugin|threads|capture|sample-cpu|fuzz-.*' ;;
    threads)
        preset=sanitize-threads
        targets=(nrd-test-{threads,plugin})
        tests='threads|plugin' ;;
    *) echo "usage: $0 [memory|threads]" >&2; exit 2 ;;
esac

bash cmake/packages.sh --sanitize
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$PWD/cmake/leaks_of_others.txt:print_suppressions=0
export TSAN_OPTIONS=second_deadlock_stack=1

[ -f "build-$preset/build.ninja" ] || cmake --preset "$preset"
cmake --build "build-$preset" -j "${JOBS:-$(nproc)}" --target "${targets[@]}"
exec bash cmake/run_tests.sh "build-$preset" -R "^($tests)\$"
