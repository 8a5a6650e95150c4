#!/usr/bin/env bash
# The main job: examples/demo.sh [MESH [SURFACE [ORGAN]]]
#
# Installs what is missing (Debian 12, as root), builds the library and the examples, and pushes a catheter through the
# vessels of MESH: a volume mesh (any of bindings/docs/meshes.md, also gzipped), or a surface (.stl, .obj or .ply) that is filled with
# tetrahedra first; without it through the embedded vessel. Every step is verified. Leaves figures, a picture and a page in
# build/demo/. Then the other scenes: a cloud of 10,000 particles in the same vessels; SURFACE (.obj, closed, triangles) falls
# among pyramids, without it $DARTSWEEP_DATA/surfaces/hand_12k.obj if there is one, else a ring; a scalpel cuts ORGAN (a volume
# mesh), without it $DARTSWEEP_DATA/organs/liver.msh, else one made here; the vessel beats, a box bends. Exit code 2: a file
# or an option can't be used; 1: anything else, and a step that was not verified.
set -euo pipefail

usage() {
  sed -n '2,11s/^# \{0,1\}//p' "$0"
  exit "$1"
}
name=demo
. "$(dirname "$0")/setup.sh"

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
insertion=$root/examples/insertion
venv=$root/build/venv
tree=$root/build/demo-release
out=$root/build/demo
log=$out/log.txt
mkdir -p "$out"
: > "$log"

needs_build_tools
needs_header CLI/CLI.hpp libcli11-dev
needs_header nlohmann/json.hpp nlohmann-json3-dev
needs_venv
ldconfig -p 2> /dev/null | grep -q 'libOSMesa\.so' || /sbin/ldconfig -p | grep -q 'libOSMesa\.so' ||
  missing+=(libosmesa6)
install_missing

echo "building the library and the examples"
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
# A quick build of few large units: the picture comes sooner, and a step takes half as long again as with the library that users get.
quietly "configuring" \
  cmake -S "$root" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" -DDSW_UNITY=ON \
  -DDSW_QUICK_BUILD="${DSW_QUICK_BUILD:-ON}" -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=ON
quietly "building" cmake --build "$tree" --target dartsweep_insertion example_demo example_plane example_replay &
build=$!
make_venv "$venv" python3 "$source/requirements.txt" "$insertion/requirements.txt" "$insertion/page/requirements.txt"
wait $build || exit 1

rm -rf "$out"/*.png "$out"/*.svg "$out"/*.vtu "$out"/*.csv "$out"/*.html "$out"/summary.txt "$out/insertion" "$out/haptic.txt"
mkdir "$out/insertion"
if [ -n "$mesh" ]; then
  title=$(basename "$mesh")
  case "${mesh,,}" in
    *.stl | *.obj | *.ply)
      "$venv/bin/python" "$insertion/fill_surface.py" "$mesh" "$out/filled.vtu"
      mesh=$out/filled.vtu
      ;;
  esac
  "$venv/bin/python" "$source/read_mesh.py" "$mesh" "$out/mesh.bin"
  input=(--mesh "$out/mesh.bin")
  source_name=(--source "$title")
else
  input=()
  source_name=()
  title="a branching vessel"
fi

echo
echo "a rod of 200 edges in $title, 10,000 steps of 1 ms:"
insert=$tree/examples/insertion/dartsweep_insertion
"$insert" "${input[@]}" "${source_name[@]}" --out "$out/insertion" --record "$out/insertion/calls.dswrec"
quietly "making the recording again" "$tree/examples/dartsweep_replay" "$out/insertion/calls.dswrec" --quiet
echo "replay.bit_identical 1"
"$venv/bin/python" "$insertion/draw.py" "$out/insertion/insertion.json" "$out/insertion.png"
quietly "making the page" \
  "$venv/bin/python" "$insertion/build_page.py" "$out/insertion/insertion.json" "$out/insertion.html"
echo
echo "the rod at the speed of a hand; of these figures:"
"$insert" --preset haptic "${input[@]}" > "$out/haptic.txt"
grep -E '^demo\.(steps|exactly_free_steps|lost|realtime_factor|realtime_factor.whole_step|detection_ms|detection_ms_p999|detection_ms_max|edges|rows_per_step|largest_stretch) ' "$out/haptic.txt"
echo
echo "the other scenes:"
[ -z "$surface" ] || input+=(--surface "$surface")
organ_title="an organ"
if [ -n "$organ" ]; then
  "$venv/bin/python" "$source/read_mesh.py" "$organ" "$out/organ.bin"
  input+=(--tissue "$out/organ.bin")
  organ_title=$(basename "$organ")
fi
"$tree/examples/dartsweep_demo" "${input[@]}" --threads "$(nproc)" --out "$out" | tee "$out/summary.txt"
"$venv/bin/python" "$source/draw.py" "$out" "Dartsweep: a cloud and catheters in $title" "$organ_title"
echo
echo "in the plane:"
"$tree/examples/dartsweep_plane" "$out"
rm -f "$out/mesh.bin" "$out/organ.bin" "$out/filled.vtu"

echo
echo "the main job, a catheter:"
echo "  page     $out/insertion.html (any browser, without a network)"
echo "  picture  $out/insertion.png"
echo "  tables   $out/insertion/summary.txt, steps.csv (every step), insertion.json (every figure); $out/haptic.txt"
echo "  replay   $out/insertion/calls.dswrec (every call, for dartsweep_replay)"
echo "  ParaView $out/insertion/catheter.vtu, contacts.vtu, wall.vtu"
echo "the other scenes:"
echo "  tables   $out/summary.txt, steps.csv (every step of the bodies)"
echo "  pictures $out/demo.png, surface.png, scalpel.png, beating.png, box.png"
echo "  plane    $out/city.svg, rope.svg"
echo "  ParaView $out/demo.vtu (cloud), catheter_*.vtu, surface.vtu, wall.vtu, outer.vtu, obstacles.vtu, *contacts.vtu,"
echo "           tissue.vtu, scalpel.vtu, probe.vtu, beating.vtu, box.vtu, ring_*.vtu"
