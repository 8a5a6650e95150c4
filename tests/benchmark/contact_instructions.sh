#!/usr/bin/env bash
# Instructions that a contact costs:
# tests/benchmark/contact_instructions.sh PROGRAM [--mesh FILE] [--moves FOLDER] [--json FILE]
#
# PROGRAM is dartsweep_bench_contact of a build that is not stripped: release will do. Valgrind counts the same moves as
# the part `contact` makes; --mesh and --moves are those of PROGRAM. Takes a minute or two.
set -euo pipefail

case ${1:-} in
  '' | -h | --help)
    sed -n '2,6s/^# \{0,1\}//p' "$0"
    [ -n "${1:-}" ] || exit 2
    exit 0
    ;;
esac
program=$1
shift
json=contact_instructions.json
given=()
while [ $# -gt 0 ]; do
  [ $# -ge 2 ] || { echo "contact_instructions: $1 needs a value" >&2; exit 2; }
  case $1 in
    --mesh | --moves) given+=("$1" "$2") ;;
    --json) json=$2 ;;
    *)
      echo "contact_instructions: unknown argument $1" >&2
      exit 2
      ;;
  esac
  shift 2
done

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
[[ " ${given[*]} " == *" --moves "* ]] || given+=(--moves "$folder")
# Records moves, if there are none.
"$program" --counted catheter "${given[@]}" --json "$folder/catheter.json" > /dev/null
for scene in catheter self; do
  valgrind --tool=callgrind --callgrind-out-file="$folder/$scene.out" --toggle-collect='dsw_bench_counted*' \
    "$program" --counted "$scene" "${given[@]}" --json "$folder/$scene.json" > "$folder/$scene.log" 2>&1 ||
    { cat "$folder/$scene.log" >&2; exit 1; }
  callgrind_annotate --inclusive=yes --threshold=100 "$folder/$scene.out" > "$folder/$scene.txt"
done
python3 - "$folder" "$json" << 'END'
import json
import re
import sys

folder, out = sys.argv[1], sys.argv[2]
figures = {}


def inclusive(text, name):
    """Instructions in functions of a name and in what they call."""
    found = re.findall(r"^ *([0-9,]+) .*:" + re.escape(name) + r"[^\n]*\[", text, re.M)
    if not found:
        raise SystemExit(f"contact_instructions: {name} was not called, or its symbol is gone")
    return max(int(number.replace(",", "")) for number in found)


for scene in ("catheter", "self"):
    with open(f"{folder}/{scene}.json", encoding="utf-8") as file:
        counts = json.load(file)
    with open(f"{folder}/{scene}.txt", encoding="utf-8") as file:
        text = file.read()
    contacts, moves = counts["contact.counted_contacts"], counts["contact.counted_moves"]
    alone = inclusive(text, "dsw::VertexMove<3>::move(")
    figures[f"contact.instructions_per_contact.{scene}"] = round(alone / contacts)
    figures[f"contact.instructions_per_move.{scene}"] = round(inclusive(text, "dsw_body_move") / moves)
    figures[f"contact.counted_per_move.{scene}"] = round(contacts / moves, 3)
for name, value in figures.items():
    print(name, value)
with open(out, "w", encoding="utf-8") as file:
    json.dump(figures, file, indent=1)
    file.write("\n")
END
