#!/usr/bin/env bash
# Instructions that a cell costs on a cast's way: tests/benchmark/walk_instructions.sh PROGRAM [--json FILE]
#
# PROGRAM is dartsweep_bench_walk_counted. Valgrind counts what dsw_environment_cast_segments runs, reports included, with
# each kernel that valgrind knows; it knows no AVX-512. Takes a minute or two.
set -euo pipefail

json=walk_instructions.json
. "$(dirname "$0")/counted_arguments.sh"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
figures=()
for scene in hex hex_warped tet_short tet_long; do
  casts=$([ $scene = tet_long ] && echo 1000 || echo 9000)
  for kernel in avx2 portable; do
    DARTSWEEP_KERNEL=$kernel valgrind --tool=callgrind --callgrind-out-file="$folder/out" \
      --toggle-collect=dsw_environment_cast_segments "$program" $scene $casts > "$folder/cells" 2> "$folder/log" ||
      { cat "$folder/log" >&2; exit 1; }
    read -r _ cells < "$folder/cells"
    instructions=$(sed -n 's/^summary: //p' "$folder/out")
    [ "${instructions:-0}" -gt 0 ] || { echo "walk_instructions: nothing was counted" >&2; exit 1; }
    figures+=("\"walk.instructions_per_cell.$scene.$kernel\": $(awk "BEGIN { printf \"%.1f\", $instructions / $cells }")")
  done
done
{
  echo "{"
  printf ' %s,\n' "${figures[@]}" | sed '$s/,$//'
  echo "}"
} | tee "$json"
