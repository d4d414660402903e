#!/usr/bin/env bash
# Lets libFuzzer drive a target, with the libraries under it instrumented: fuzz.sh TARGET [SECONDS], an hour unless told
# otherwise. What it learns stays in build-fuzz/corpus/TARGET; an input that breaks a promise is written beside it, and
# build-fuzz/bin/nrd-fuzz-TARGET FILE repeats it. JOBS may be set in the environment.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ $# -lt 1 ] || [ $# -gt 2 ]; then
    echo "usage: $0 TARGET [SECONDS], TARGET one of those of tests/fuzz: nrd, integration, plugin, settings, gltf, capture" >&2
    exit 2
fi
target=$1
seconds=${2:-3600}
bash cmake/packages.sh --sanitize
[ -f build-fuzz/build.ninja ] || cmake --preset fuzz
cmake --build build-fuzz -j "${JOBS:-$(nproc)}" --target "nrd-fuzz-$target"
corpus=build-fuzz/corpus/$target
mkdir -p "$corpus"
export LSAN_OPTIONS=suppressions=$PWD/cmake/leaks_of_others.txt:print_suppressions=0
exec "build-fuzz/bin/nrd-fuzz-$target" -max_len=1024 -max_total_time="$seconds" -len_control=0 -print_final_stats=1 \
    -artifact_prefix="$corpus.broken-" "$corpus"
