#!/usr/bin/env bash
# Instructions of the exact test of a pair: tests/benchmark/pairs/instructions.sh PROGRAM [--json FILE]
#
# PROGRAM is dartsweep_pairs. Valgrind counts every call of dsw_sweep_pairs on 1000 queries of each public set, and the
# script takes the median and the worst. Without DARTSWEEP_CCD_QUERIES there are no figures. Takes a minute.
set -euo pipefail

json=pairs_instructions.json
. "$(dirname "$0")/../counted_arguments.sh"
if [ -z "${DARTSWEEP_CCD_QUERIES:-}" ]; then
  echo "instructions: DARTSWEEP_CCD_QUERIES names no folder: no pairs.instructions_* figures"
  echo "{}" > "$json"
  exit 0
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
valgrind --tool=callgrind --callgrind-out-file="$folder/out" --toggle-collect=dsw_sweep_pairs --dump-after=dsw_sweep_pairs \
  "$program" --ask-alone 1000 > "$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
find "$folder" -name 'out.*' -exec sed -n 's/^summary: //p' {} + | awk '$1 > 0' | sort -n > "$folder/counts"
count=$(wc -l < "$folder/counts")
[ "$count" -gt 0 ] || { echo "instructions: nothing was counted" >&2; exit 1; }
{
  echo "{"
  echo " \"pairs.instructions_median\": $(sed -n "$(((count + 1) / 2))p" "$folder/counts"),"
  echo " \"pairs.instructions_p99\": $(sed -n "$(((count * 99 + 99) / 100))p" "$folder/counts"),"
  echo " \"pairs.instructions_max\": $(tail -n 1 "$folder/counts"),"
  echo " \"pairs.instructions_queries\": $count"
  echo "}"
} | tee "$json"
