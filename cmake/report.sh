#!/usr/bin/env bash
# Speed against error from a fresh clone: writes report.md with plots, tables and the benchmark's figures to the folder
# given (default: report), and the data behind them beside it.
# BUILD_DIR, NRD_TEST_DATA, JOBS, DEVICE (its number or a part of its name), BENCH and REPORT (options of nrd-bench and
# nrd-report, as --time-size 2560x1440 on a GPU) may be set in the environment.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-report}
build=${BUILD_DIR:-build}
device=(${DEVICE:+--device "$DEVICE"})
read -ra bench_options <<<"${BENCH:-}"
read -ra report_options <<<"${REPORT:-}"

bash cmake/packages.sh
options=()
[ -z "${NRD_TEST_DATA:-}" ] || options+=("-DNRD_TEST_DATA=$NRD_TEST_DATA")
if [ ! -f "$build/build.ninja" ]; then cmake --preset release -B "$build" "${options[@]}"; fi
cmake --build "$build" -j "${JOBS:-$(nproc)}" --target nrd-bench nrd-report nrd-sample nrd nrd_shared
bash cmake/sequences.sh "$build"

# Without the recorded sequences, one of the sample's own scene.
captures=("$build"/sequences/*/capture.json)
if [ ! -f "${captures[0]}" ]; then
    captures=("$build/report-capture/capture.json")
    [ -f "${captures[0]}" ] || "$build/bin/nrd-sample" --headless --size 320x180 --frames 32 --reference-spp 1024 \
        --capture "$build/report-capture"
fi

mkdir -p "$out"
# Pipelines are to be created cold: no driver may know them.
export MESA_SHADER_CACHE_DISABLE=true __GL_SHADER_DISK_CACHE=0
"$build/bin/nrd-bench" "${device[@]}" --json "$out/bench.json" "${bench_options[@]}" >"$out/bench.txt"
"$build/bin/nrd-report" "${device[@]}" --out "$out" "${report_options[@]}" "${captures[@]%/capture.json}" \
    >"$out/tables.md"
commit=$(git describe --always --dirty 2>/dev/null || echo unknown)
text_size() # of all objects
{
    size "$(find "$build" -name "$1" -type f -print -quit)" | awk 'NR > 1 { sum += $1 } END { print sum " bytes of text" }'
}
{
    echo "$(head -n 1 "$out/bench.txt"); $(date -u +%F), commit $commit"
    echo
    cat "$out/tables.md"
    echo -e "\n## Size of the library\n\nstatic: $(text_size libnrd.a), shared: $(text_size 'libnrd.so.*.*.*')"
    echo -e "\n## Benchmark\n\n\`\`\`"
    cat "$out/bench.txt"
    echo '```'
} >"$out/report.md"
rm "$out/tables.md"
echo "$out/report.md"
