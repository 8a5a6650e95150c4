#!/usr/bin/env bash
# The main job: examples/demo.sh [MESH [SURFACE [ORGAN]]]
#
# Installs what is missing (Debian 12, as root), builds the library and the demo, drives a cloud of 10,000 particles and
# catheters through the lumen of MESH (.msh, .vtk or .vtu, also gzipped), or of the embedded vessel, and lets SURFACE
# (.obj, closed, triangles) fall among pyramids; without it $DARTSWEEP_DATA/surfaces/hand_12k.obj if there is one, else a
# ring. Then the environment changes: a scalpel cuts ORGAN (a volume mesh), without it $DARTSWEEP_DATA/organs/liver.msh, else
# one made here; the vessel beats, a box bends. Leaves tables, pictures and .vtu files in build/demo/. Exit code 2: a file or
# an option can't be used; 1: anything else.
set -euo pipefail

usage() {
  sed -n '2,10s/^# \{0,1\}//p' "$0"
  exit "$1"
}
fail() {
  echo "demo: $2" >&2
  exit "$1"
}

[ $# -le 3 ] || usage 2 >&2
case "${1:-}" in
  -h | --help) usage 0 ;;
  -*) usage 2 >&2 ;;
esac
mesh=""
if [ $# -ge 1 ] && [ -n "$1" ]; then
  [ -f "$1" ] || fail 2 "cannot open mesh file '$1'"
  mesh=$(realpath "$1")
fi
surface=${2:-}
[ -z "$surface" ] || [ -f "$surface" ] || fail 2 "cannot open surface file '$surface'"
hand=${DARTSWEEP_DATA:-/nowhere}/surfaces/hand_12k.obj
[ -n "$surface" ] || [ ! -f "$hand" ] || surface=$hand
[ -z "$surface" ] || surface=$(realpath "$surface")
organ=${3:-}
[ -z "$organ" ] || [ -f "$organ" ] || fail 2 "cannot open organ file '$organ'"
liver=${DARTSWEEP_DATA:-/nowhere}/organs/liver.msh
[ -n "$organ" ] || [ ! -f "$liver" ] || organ=$liver
[ -z "$organ" ] || organ=$(realpath "$organ")

root=$(cd "$(dirname "$0")/.." && pwd)
source=$root/examples/demo
venv=$root/build/venv
tree=$root/build/demo-release
out=$root/build/demo
log=$out/log.txt
mkdir -p "$out"
: > "$log"

# Runs a command with its output in the log; on failure shows the end of it.
quietly() {
  local what=$1
  shift
  "$@" >> "$log" 2>&1 < /dev/null || {
    tail -n 20 "$log" >&2
    fail 1 "$what failed; all of its output is in $log"
  }
}

# Packages: each line is a test that it is there, and what to install if it is not.
missing=()
command -v c++ > /dev/null && command -v cc > /dev/null || missing+=(g++)
command -v cmake > /dev/null || missing+=(cmake)
command -v make > /dev/null || missing+=(make)
[ -e /usr/include/eigen3/Eigen/Core ] || missing+=(libeigen3-dev)
python3 -c 'import ensurepip, venv' 2> /dev/null || missing+=(python3-venv)
ldconfig -p 2> /dev/null | grep -q 'libOSMesa\.so' || /sbin/ldconfig -p | grep -q 'libOSMesa\.so' ||
  missing+=(libosmesa6)
if [ ${#missing[@]} -gt 0 ]; then
  command -v apt-get > /dev/null && [ "$(id -u)" -eq 0 ] ||
    fail 1 "these packages are missing and only root on Debian can have them installed here: ${missing[*]}"
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  quietly "updating the package lists" apt-get update -q
  quietly "installing ${missing[*]}" apt-get install -q -y --no-install-recommends "${missing[@]}"
fi

# Python modules, pinned, in a folder of their own; again only when the list has changed.
if ! cmp -s "$source/requirements.txt" "$venv/installed.txt"; then
  echo "installing $(grep -v '^#' "$source/requirements.txt" | tr '\n' ' ')in build/venv"
  quietly "creating build/venv" python3 -m venv --clear "$venv"
  quietly "installing Python modules" \
    "$venv/bin/python" -m pip install --disable-pip-version-check -r "$source/requirements.txt"
  cp "$source/requirements.txt" "$venv/installed.txt"
fi

echo "building the library and the demo"
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
quietly "configuring" \
  cmake -S "$root" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=ON
quietly "building" cmake --build "$tree" --target example_demo

rm -f "$out"/*.png "$out"/*.vtu "$out"/*.csv "$out"/summary.txt
if [ -n "$mesh" ]; then
  "$venv/bin/python" "$source/read_mesh.py" "$mesh" "$out/mesh.bin"
  input=(--mesh "$out/mesh.bin")
  title=$(basename "$mesh")
else
  input=()
  title="a branching vessel"
fi
[ -z "$surface" ] || input+=(--surface "$surface")
organ_title="an organ"
if [ -n "$organ" ]; then
  "$venv/bin/python" "$source/read_mesh.py" "$organ" "$out/organ.bin"
  input+=(--tissue "$out/organ.bin")
  organ_title=$(basename "$organ")
fi
"$tree/examples/dartsweep_demo" "${input[@]}" --threads "$(nproc)" --out "$out" | tee "$out/summary.txt"
"$venv/bin/python" "$source/draw.py" "$out" "Dartsweep: a cloud and catheters in $title" "$organ_title"
rm -f "$out/mesh.bin" "$out/organ.bin"

echo
echo "  tables   $out/summary.txt, steps.csv (every step of the bodies)"
echo "  pictures $out/demo.png, surface.png, scalpel.png, beating.png, box.png"
echo "  ParaView $out/demo.vtu (cloud), catheter_*.vtu, surface.vtu, wall.vtu, outer.vtu, obstacles.vtu, *contacts.vtu,"
echo "           tissue.vtu, scalpel.vtu, probe.vtu, beating.vtu, box.vtu, ring_*.vtu"
