#!/usr/bin/env bash
# Error against run time, stability, what is left out: examples/report.sh [--quick]
#
# Installs what is missing (Debian 12, as root), builds a release of the measuring programs, runs them and puts all figures
# into one page, build/report/report.html, with CSV and SVG of every chart beside it. With DARTSWEEP_DATA naming a folder
# of meshes, real ones are measured, too; with DARTSWEEP_CCD_QUERIES naming a folder, its public queries on moving pairs.
# --quick takes some minutes, and times scatter more. Exit code 1: something failed, or a bar of the page is not met; 2: an
# option can't be used.
set -euo pipefail

usage() {
  sed -n '2,8s/^# \{0,1\}//p' "$0"
  exit "$1"
}
name=report
. "$(dirname "$0")/setup.sh"

quick=()
for argument in "$@"; do
  case $argument in
    --quick) quick=(--quick) ;;
    -h | --help) usage 0 ;;
    *) usage 2 >&2 ;;
  esac
done

root=$(cd "$(dirname "$0")/.." && pwd)
source=$root/examples/report
venv=$root/build/venv-report
tree=$root/build/report-release
out=$root/build/report
log=$out/log.txt
mkdir -p "$out"
: > "$log"

needs_build_tools
needs_venv
command -v pkg-config > /dev/null || missing+=(pkg-config)
needs_header gmpxx.h libgmp-dev
needs_header bullet/btBulletCollisionCommon.h libbullet-dev
needs_header embree3/rtcore.h libembree-dev
needs_header CLI/CLI.hpp libcli11-dev
needs_header nlohmann/json.hpp nlohmann-json3-dev
needs_header fcl/fcl.h libfcl-dev
needs_header ccd/ccd.h libccd-dev
python3 -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")' 2> /dev/null || missing+=(python3-dev)
install_missing

quietly "installing Python modules in build/venv-report" "$source/venv.sh"
quietly "installing SWIG in build/venv-report" "$venv/bin/python" -m pip install --disable-pip-version-check swig==4.5.1
peers=" " skipped=()
for peer in $(grep -v '^#' "$source/requirements-peers.txt"); do
  if "$venv/bin/python" -m pip install --disable-pip-version-check "$peer" >> "$log" 2>&1 < /dev/null; then
    peers+="${peer%%=*} "
  else
    skipped+=(--skipped "$peer could not be installed, so its points are absent.")
    echo "report: $peer can't be installed here: its points are left out"
  fi
done

echo "building the library and the measuring programs"
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
quietly "configuring" env PATH="$venv/bin:$PATH" cmake -S "$root" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=ON \
  -DDSW_BUILD_BENCH=ON -DDSW_WITH_LIBCCD=ON -DDSW_BUILD_PYTHON=ON -DPython3_EXECUTABLE="$venv/bin/python"
quietly "building" cmake --build "$tree" --target dartsweep_error dartsweep_error_deform dartsweep_left_out dartsweep_left_out_core \
  physics_contacts physics_dials physics_stability dartsweep_pairs dartsweep_python

# Results of another run are not mixed with these.
rm -f "$out"/*.csv "$out"/*.svg "$out"/*.json "$out"/*.html
find "$out" -name '*.txt' ! -name log.txt -delete

# measure WHAT COMMAND...: one of the measuring programs, and how long it took.
measure() {
  local what=$1 start=$SECONDS
  shift
  echo "measuring $what"
  quietly "measuring $what" "$@"
  echo "  $((SECONDS - start)) s"
}
measure "detection" "$tree/tests/benchmark/error/dartsweep_error" "${quick[@]}" --out "$out"
[[ $peers != *" ipctk "* ]] ||
  measure "Tight-Inclusion" "$venv/bin/python" "$root/tests/benchmark/error/tight_inclusion.py" "$out"
# The page says which answers are not exact (exit code 1).
exact_pairs() {
  local pairs=$tree/tests/benchmark/pairs run
  run=("$pairs/dartsweep_pairs")
  [[ $peers != *" ipctk "* ]] ||
    run=("$venv/bin/python" "$root/tests/benchmark/pairs/with_tight_inclusion.py" "$pairs/libdartsweep_pairs.so")
  "${run[@]}" "${quick[@]}" --generated "$([ ${#quick[@]} -gt 0 ] && echo 20000 || echo 200000)" --out "$out" || [ $? -eq 1 ]
}
[ -n "${DARTSWEEP_CCD_QUERIES:-}" ] || skipped+=(--skipped "DARTSWEEP_CCD_QUERIES names no folder, so public queries on moving pairs are absent.")
measure "moving pairs" exact_pairs
measure "deformations" "$tree/tests/benchmark/error/dartsweep_error_deform" "${quick[@]}" --out "$out"
measure "moves, walls and changes" env PYTHONPATH="$tree/bindings/python" "$venv/bin/python" \
  "$root/tests/benchmark/error/dials/measure.py" "$out" "${quick[@]}"
measure "physics" "$tree/examples/physics/dials" "${quick[@]}" --out "$out"
[[ $peers != *" mujoco "* ]] || measure "MuJoCo" "$venv/bin/python" "$root/examples/physics/mujoco_peer.py" "$out"
measure "stability" "$tree/examples/physics/stability" "${quick[@]}" --out "$out"
measure "stability in contact" "$tree/examples/physics/contacts" "${quick[@]}" --out "$out"

# What is left out: all rows in one run, libccd's in one for each build of the library.
bench=$tree/tests/benchmark
steps=(--steps "$([ ${#quick[@]} -gt 0 ] && echo 60 || echo 400)")
measure "what is left out" "$bench/dartsweep_left_out" "${steps[@]}" --csv "$out/left_out.csv" --json "$tree/left_out.json"
for build in dartsweep_left_out dartsweep_left_out_core; do
  quietly "measuring $build" "$bench/$build" "${steps[@]}" --libccd-only --csv "$tree/libccd.csv" --json "$tree/libccd.json"
  tail -n 1 "$tree/libccd.csv" >> "$out/left_out.csv"
done
quietly "measuring the library's size" python3 "$root/tests/benchmark/library_size.py" "$out" "$tree/left_out.json" \
  "not built:$bench/libdartsweep_core.so" "built:$tree/src/libdartsweep.so"

echo "drawing"
status=0
"$venv/bin/python" "$source/make_report.py" "$out" --command "examples/report.sh${quick:+ --quick}" "${quick[@]}" "${skipped[@]}" || status=$?
[ $status -ne 2 ] || exit 1
echo
echo "  page     $out/report.html"
echo "  figures  $out/report.json, and CSV and SVG of every chart"
exit $status
