#!/usr/bin/env bash
# Recording and replay of the main job: examples/replay.sh [MESH [PRESET]]
#
# Installs what is missing (Debian 12, as root), builds the library and the programs, and records the 10,000 steps of a catheter in MESH (arrays
# that examples/demo/read_mesh.py made; without it or with "" the embedded vessel; PRESET figure8 or haptic), once to the end and once killed with SIGKILL in the middle. Both
# recordings are made again; after each call its results and the checksum of the whole state must be those of the process that recorded. Prints figures
# as `key value`. Exit code 1: something differs; 2: a file can't be used.
set -euo pipefail

usage() {
  sed -n '2,8s/^# \{0,1\}//p' "$0"
  exit "$1"
}
name=replay
. "$(dirname "$0")/setup.sh"

[ $# -le 2 ] || usage 2 >&2
case "${1:-}" in
  -h | --help) usage 0 ;;
  -*) usage 2 >&2 ;;
esac
options=(--preset "${2:-figure8}")
if [ -n "${1:-}" ]; then
  [ -f "$1" ] || fail 2 "cannot open mesh file '$1'"
  options+=(--mesh "$(realpath "$1")")
fi
steps=${DSW_REPLAY_STEPS:-10000}

root=$(cd "$(dirname "$0")/.." && pwd)
tree=$root/build/demo-release
out=$root/build/replay
log=$out/log.txt
mkdir -p "$out"
: > "$log"

needs_build_tools
needs_header CLI/CLI.hpp libcli11-dev
needs_header nlohmann/json.hpp nlohmann-json3-dev
install_missing
echo "building the library and the programs"
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
quietly "configuring" \
  cmake -S "$root" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=ON
quietly "building" cmake --build "$tree" --target dartsweep_insertion example_replay
insert=("$tree/examples/insertion/dartsweep_insertion" "${options[@]}" --steps "$steps")
replay=$tree/examples/dartsweep_replay

size_of() { stat -c %s "$1" 2> /dev/null || echo 0; }
# milliseconds COMMAND...: how long it took, in `took`.
milliseconds() {
  local start
  start=$(date +%s%N)
  quietly "$1" "$@"
  took=$((($(date +%s%N) - start) / 1000000))
}
# made_again FILE: in `calls` how many calls did the same, in `identical` whether all did.
made_again() {
  identical=0
  if "$replay" "$1" --quiet > "$out/validation.txt" 2>> "$log" && grep -q '^the recording ends here' "$out/validation.txt"; then identical=1; fi
  cat "$out/validation.txt" >> "$log"
  calls=$(sed -n 's/ calls did what was recorded$//p' "$out/validation.txt")
}

milliseconds "${insert[@]}"
plain=$took
milliseconds "${insert[@]}" --record "$out/whole.dswrec"
recorded=$took
size=$(size_of "$out/whole.dswrec")
milliseconds "$replay" "$out/whole.dswrec" --to 0
opened=$took
beginning=$("$replay" "$out/whole.dswrec" --to 0 | sed -n 's/^its beginning takes \([0-9]*\) bytes$/\1/p')
milliseconds "$replay" "$out/whole.dswrec" --quiet
replayed=$took
made_again "$out/whole.dswrec"
echo "replay.bit_identical $identical"
echo "replay.calls $calls"
echo "replay.bytes $size"
echo "replay.bytes_per_step $(((size - beginning) / steps))"
echo "replay.seconds.not_recorded $((plain / 1000)).$(printf %03d $((plain % 1000)))"
echo "replay.seconds.recorded $((recorded / 1000)).$(printf %03d $((recorded % 1000)))"
echo "replay.seconds.made_again $(((replayed - opened) / 1000)).$(printf %03d $(((replayed - opened) % 1000)))"
result=$identical

rm -f "$out/killed.dswrec"
"${insert[@]}" --record "$out/killed.dswrec" >> "$log" 2>&1 &
process=$!
while [ "$(size_of "$out/killed.dswrec")" -lt $(((size + beginning) / 2)) ] && kill -0 $process 2> /dev/null; do sleep 0.002; done
kill -9 $process || fail 1 "the process to be killed has ended before"
wait $process 2>> "$log" || true
made_again "$out/killed.dswrec"
echo "replay.bit_identical.killed $identical"
echo "replay.calls.killed $calls"
sed -n 's/^the recording ends here.* with \([0-9]*\) bytes of an entry.*/replay.torn_bytes.killed \1/p' "$out/validation.txt"
[ $((result * identical)) -eq 1 ] || exit 1
