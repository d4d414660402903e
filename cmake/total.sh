#!/usr/bin/env bash
# Runs each argument as a command, whatever became of the one before, and closes with the sum of their closing lines:
# "N passed, N failed". A command that fails without counting a failed test counts as one. The ends of what failed
# commands printed are repeated before that line, where they are found.
set -uo pipefail

log=$(mktemp) failures=$(mktemp)
trap 'rm -f "$log" "$failures"' EXIT
passed=0 failed=0 skipped=0
for command in "$@"; do
    bash -c "$command" 2>&1 | tee "$log"
    status=${PIPESTATUS[0]}
    counts=$(tail -n 1 "$log" | sed -nE 's/^([0-9]+) passed, ([0-9]+) failed(, ([0-9]+) skipped)?$/\1 \2 \4/p')
    read -r p f s <<< "$counts"
    if [ "$status" -ne 0 ]; then
        [ "${f:-0}" -gt 0 ] || f=1
        { echo "FAILED: $command"; tail -n 60 "$log"; } >> "$failures"
    fi
    passed=$((passed + ${p:-0})) failed=$((failed + ${f:-0})) skipped=$((skipped + ${s:-0}))
done
cat "$failures"
if [ "$skipped" -gt 0 ]; then note=", $skipped skipped"; fi
echo "$passed passed, $failed failed${note:-}"
[ "$failed" -eq 0 ]
