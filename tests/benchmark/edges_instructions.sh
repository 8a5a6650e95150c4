#!/usr/bin/env bash
# Instructions that edges cost in figure 12: tests/benchmark/edges_instructions.sh PROGRAM [--json FILE]
#
# PROGRAM is dartsweep_bench_edges_counted. Valgrind counts what dsw_body_move runs in the 60 steps in which the surface falls,
# for a vertex and step, and over that of vertices alone. With the kernel for AVX2: valgrind knows no AVX-512. DARTSWEEP_DATA
# names the folder with the hand; without it a generated surface falls. Takes some minutes.
set -euo pipefail

json=edges_instructions.json
. "$(dirname "$0")/counted_arguments.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
figures=() points=0
for variant in points edges edges_environment edges_back_edge edges_hybrid edges_paper_62 edges_paper_63; do
  DARTSWEEP_KERNEL=avx2 valgrind --tool=callgrind --callgrind-out-file="$folder/out" --toggle-collect=dsw_body_move \
    "$program" "${DARTSWEEP_DATA:-.}" $variant > "$folder/moved" 2> "$folder/log" || { cat "$folder/log" >&2; exit 1; }
  read -r moved _ < <(tail -n 1 "$folder/moved")
  instructions=$(sed -n 's/^summary: //p' "$folder/out")
  [ "${instructions:-0}" -gt 0 ] || { echo "edges_instructions: nothing was counted" >&2; exit 1; }
  [ $variant != points ] || points=$(awk "BEGIN { print $instructions / $moved }")
  figures+=("\"edges.instructions.$variant\": $(awk "BEGIN { printf \"%.1f\", $instructions / $moved }")")
  figures+=("\"edges.instructions.over_points.$variant\": $(awk "BEGIN { printf \"%.3f\", $instructions / $moved / $points }")")
done
{
  echo "{"
  printf ' %s,\n' "${figures[@]}" | sed '$s/,$//'
  echo "}"
} | tee "$json"
