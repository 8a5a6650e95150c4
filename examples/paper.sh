#!/usr/bin/env bash
# The experiments of [JCD10], one command each: examples/paper.sh FIGURE [--quick] [MESH]
#
# FIGURE is 8 (a catheter in a vascular network), 9 (cells tested against its length), 10 (the lattices of the benchmark), 11 (time
# against the size of the scene, with Bullet and GIMPACT), 12 (what edges cost on a surface of 12,000 vertices, and what eliminations
# save), text (what the text states: figure 2, sections 3.3, 4.2, 4.3, 4.4, 5.1 and 5.2) or all. Installs what is missing (Debian 12, as
# root), builds, runs, and prints a table `ours | paper`, with a sentence for each figure; CSV, SVG and PNG in build/paper/.
# MESH is the vessel of the text and of figures 8 and 9, in mm (.msh, .vtk, .vtu, also gzipped); without it
# $DARTSWEEP_DATA/vessels/vascular_phantom.msh.gz if there is one, else a vessel that is made. Figure 12 takes
# $DARTSWEEP_DATA/surfaces/hand_12k.obj if there is one, else a ring of 12,000 vertices. --quick: fewer steps and rounds of
# the text and of figures 11 and 12. Exit code 2: a file or an option can't be used; 1: anything else.
set -euo pipefail

usage() {
  sed -n '2,12s/^# \{0,1\}//p' "$0"
  exit "$1"
}
name=paper
. "$(dirname "$0")/setup.sh"

figures=() quick=() mesh= text=
for argument in "$@"; do
  case $argument in
    -h | --help) usage 0 ;;
    --quick) quick=(--quick) ;;
    text) text=yes ;;
    8 | 9 | 10 | 11 | 12) figures+=("$argument") ;;
    all) figures+=(8 9 10 11 12) text=yes ;;
    -*) usage 2 >&2 ;;
    *)
      [ -z "$mesh" ] || usage 2 >&2
      [ -f "$argument" ] || fail 2 "'$argument' is no figure and no mesh file that can be opened"
      mesh=$(realpath "$argument")
      ;;
  esac
done
[ ${#figures[@]} -gt 0 ] || [ -n "$text" ] || usage 2 >&2
wanted() { [[ " ${figures[*]} " == *" $1 "* ]]; }
benchmark= catheter=
if wanted 10 || wanted 11 || wanted 12; then benchmark=yes; fi
if wanted 8 || wanted 9; then catheter=yes; fi
vessel=$catheter$text
phantom=${DARTSWEEP_DATA:-/nowhere}/vessels/vascular_phantom.msh.gz
[ -n "$mesh" ] || [ ! -f "$phantom" ] || mesh=$(realpath "$phantom")

root=$(cd "$(dirname "$0")/.." && pwd)
source=$root/examples/paper
venv=$root/build/venv-paper
tree=$root/build/paper-release
out=$root/build/paper
log=$out/log.txt
mkdir -p "$out"
: > "$log"

needs_build_tools
needs_venv
needs_header nlohmann/json.hpp nlohmann-json3-dev
needs_header CLI/CLI.hpp libcli11-dev
if [ -n "$benchmark" ]; then
  command -v pkg-config > /dev/null || missing+=(pkg-config)
  needs_header embree3/rtcore.h libembree-dev
  needs_header bullet/btBulletCollisionCommon.h libbullet-dev
  needs_header CGAL/version.h libcgal-dev
  needs_header gmpxx.h libgmp-dev
  needs_header box2d/box2d.h libbox2d-dev
fi
install_missing

lists=("$source/requirements.txt")
if [ -n "$mesh" ] && [ -n "$vessel" ]; then lists+=("$root/examples/demo/requirements.txt"); fi # readers of meshes
make_venv "$venv" python3 "${lists[@]}"

echo "building the library and the programs"
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
targets=()
[ -z "$catheter" ] || targets+=(paper_catheter_length)
[ -z "$text" ] || targets+=(paper_statements)
[ -z "$benchmark" ] || targets+=(dartsweep_bench)
quietly "configuring" cmake -S "$root" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=ON \
  -DDSW_BUILD_BENCH="$([ -n "$benchmark" ] && echo ON || echo OFF)"
quietly "building" cmake --build "$tree" --target "${targets[@]}"

data=(--data "${DARTSWEEP_DATA:-/nowhere}")
for figure in "${figures[@]}"; do rm -f "$out/figure$figure".*; done
input=()
if [ -n "$mesh" ] && [ -n "$vessel" ]; then
  "$venv/bin/python" "$root/examples/demo/read_mesh.py" "$mesh" "$out/mesh.bin"
  input=(--mesh "$out/mesh.bin")
fi
if [ -n "$text" ]; then
  echo "measuring what the text states"
  "$tree/examples/paper/paper_statements" "${input[@]}" "${quick[@]}" | tee "$out/text.txt"
fi
if [ -n "$catheter" ]; then
  echo "pushing the catheter of figures 8 and 9"
  "$tree/examples/paper/catheter_length" "${input[@]}" --csv "$out/catheter_length.csv" --picture "$out/picture.json"
fi
rm -f "$out/mesh.bin"
[ ${#figures[@]} -gt 0 ] || exit 0
bench=$tree/tests/benchmark/dartsweep_bench
if wanted 10 || wanted 11; then
  echo "measuring figures 10 and 11"
  quietly "measuring figure 11" "$bench" --part fig11 "${quick[@]}" --scene "$out/scene.json" --json "$out/fig11.json"
fi
if wanted 12; then
  echo "measuring figure 12"
  quietly "measuring figure 12" "$bench" --part fig12 "${quick[@]}" "${data[@]}" --json "$out/fig12.json"
fi

"$venv/bin/python" "$source/results.py" "$out" "${figures[@]}"
"$venv/bin/python" "$source/draw.py" "$out" "${figures[@]}"
echo
echo "  tables   $out/results.csv, figure*.csv"
echo "  pictures $out/figure*.svg and .png"
