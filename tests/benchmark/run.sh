#!/usr/bin/env bash
# The benchmark: tests/benchmark/run.sh [--quick] [--json FILE]
#
# Installs what is missing (Debian 12, as root), builds a release in build/bench, runs ours and the peers on the same
# queries, and writes one flat JSON object, name: number. --quick stays under 10 minutes on two cores. With
# DARTSWEEP_DATA naming a folder with vessels/vascular_phantom.msh.gz a real vessel is measured too, and with
# DARTSWEEP_CCD_QUERIES naming a folder its public queries on moving pairs. The last line is the verdict: exit status 1 where
# a part found a fault (topology.violations, *.missed, *.phantom, ...).
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/tests/benchmark
tree=$root/build/bench
quick=
json=$tree/benchmark.json
while [ $# -gt 0 ]; do
  case $1 in
    --quick) quick=--quick ;;
    --json)
      [ $# -ge 2 ] || { echo "benchmark: --json needs a file" >&2; exit 2; }
      json=$2
      shift
      ;;
    -h | --help)
      sed -n '2,8s/^# \{0,1\}//p' "$0"
      exit 0
      ;;
    *)
      echo "benchmark: unknown argument $1" >&2
      exit 2
      ;;
  esac
  shift
done
case $json in /*) ;; *) json=$PWD/$json ;; esac

install() {
  [ "$(id -u)" = 0 ] || { echo "benchmark: please install $*" >&2; exit 1; }
  echo "installing $*"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends "$@" > /dev/null
}

missing=()
python3 -c 'import ensurepip, venv' 2> /dev/null || missing+=(python3-venv)
command -v c++ > /dev/null || missing+=(g++)
for tool in cmake:cmake make:make pkg-config:pkg-config readelf:binutils python3:python3 valgrind:valgrind; do
  command -v "${tool%%:*}" > /dev/null || missing+=("${tool##*:}")
done
for header in embree3/rtcore.h:libembree-dev bullet/btBulletCollisionCommon.h:libbullet-dev \
  CGAL/version.h:libcgal-dev gmpxx.h:libgmp-dev nlohmann/json.hpp:nlohmann-json3-dev CLI/CLI.hpp:libcli11-dev \
  gtest/gtest.h:libgtest-dev eigen3/Eigen/Core:libeigen3-dev ccd/ccd.h:libccd-dev box2d/box2d.h:libbox2d-dev \
  fcl/fcl.h:libfcl-dev; do
  found=
  for folder in /usr/include /usr/local/include /usr/include/*-linux-gnu; do
    if [ -e "$folder/${header%%:*}" ]; then found=1; fi
  done
  [ -n "$found" ] || missing+=("${header##*:}")
done
[ ${#missing[@]} = 0 ] || install "${missing[@]}"

vessel=() folder=() mesh=() line=()
data=${DARTSWEEP_DATA:-}/vessels/vascular_phantom.msh.gz
if [ -n "${DARTSWEEP_DATA:-}" ] && [ -e "$data" ]; then
  mkdir -p "$tree"
  python=
  for candidate in python3 /usr/bin/python3; do
    if [ -z "$python" ] && "$candidate" -c 'import meshio' 2> /dev/null; then python=$candidate; fi
  done
  if [ -z "$python" ]; then
    install python3-meshio
    python=/usr/bin/python3
  fi
  "$python" "$here/read_mesh.py" "$data" "$tree/vessel.bin"
  "$python" "$root/examples/demo/read_mesh.py" "$data" "$tree/mesh.bin"
  mesh=(--mesh "$tree/mesh.bin")
  vessel=(--vessel "$tree/vessel.bin") folder=(--data "$DARTSWEEP_DATA")
  line=(--line "$DARTSWEEP_DATA/vessels/vascular_phantom_centreline.csv")
else
  echo "benchmark: DARTSWEEP_DATA names no folder with vessels/vascular_phantom.msh.gz: no walk.vessel.* figures, and a generated vessel and surface for edges.*"
fi

mkdir -p "$tree"
cmake -S "$root" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DDSW_BUILD_BENCH=ON -DDSW_BUILD_TESTS=ON \
  -DDSW_BUILD_EXAMPLES=ON -DDSW_WITH_LIBCCD=ON > "$tree-configure.log" || { cat "$tree-configure.log" >&2; exit 1; }
cmake --build "$tree" -j "$(nproc)" \
  --target dartsweep_bench dartsweep_bench_contact dartsweep_bench_walk_counted dartsweep_bench_edges_counted dartsweep_bench_drill dartsweep_bench_predicates dartsweep_pairs dartsweep_rigid dartsweep_oracle dartsweep_core edits_tests together_tests together_deform_tests near_tests rays_tests cross_check_tests dartsweep_cross_check_kinds_test paper_catheter_length

bench=$tree/tests/benchmark
if [ -n "$quick" ]; then casts=120000 sweeps=20000 bodies=5000 deformations=1000 pushes=2000 edits=2 cases=110000 pairs=20000 together=1 near=1 rays=1 rigid=()
else casts=10000000 sweeps=1000000 bodies=250000 deformations=100000 pushes=100000 edits=25 cases=500000 pairs=1000000 together=10 near=40 rays=25 rigid=(--long); fi
"$bench/dartsweep_bench" $quick --json "$tree/walk.json" "${vessel[@]}" "${folder[@]}"
rm -rf "$tree/moves" # of an older run
mkdir -p "$tree/moves"
"$bench/dartsweep_bench_contact" $quick --json "$tree/contact.json" "${mesh[@]}" "${vessel[@]}" "${line[@]}" --moves "$tree/moves"
"$here/contact_instructions.sh" "$bench/dartsweep_bench_contact" "${mesh[@]}" --moves "$tree/moves" --json "$tree/contact_instructions.json"
"$here/walk_instructions.sh" "$bench/dartsweep_bench_walk_counted" --json "$tree/walk_instructions.json"
"$here/edges_instructions.sh" "$bench/dartsweep_bench_edges_counted" --json "$tree/edges_instructions.json"
"$tree/examples/paper/catheter_length" "${mesh[@]}" --csv "$tree/fig9.csv" --json "$tree/fig9.json"
# The exact parts report what they find and fail on a single difference; their figures are wanted either way.
failed=()
"$bench/dartsweep_bench_drill" --json "$tree/drill.json" || failed+=(dartsweep_bench_drill)
"$bench/dartsweep_bench_predicates" --cases "$cases" --json "$tree/predicates.json" || failed+=(dartsweep_bench_predicates)
"$tree/tests/oracle/dartsweep_oracle" --casts "$casts" --sweeps "$sweeps" --bodies "$bodies" --back-edges 100000 --deformations "$deformations" \
  --plane "$sweeps" --plane-sweeps "$sweeps" --plane-deformations "$deformations" --wall-pushes "$pushes" --json "$tree/oracle.json" || failed+=(dartsweep_oracle)
# Moving pairs: in Python's process where Tight-Inclusion can be installed, or else without it.
peer=$(grep '^ipctk=' "$root/examples/report/requirements-peers.txt")
run_pairs=("$bench/pairs/dartsweep_pairs")
if { [ -e "$tree/venv/bin/python" ] || python3 -m venv "$tree/venv"; } &&
  "$tree/venv/bin/python" -m pip install -q --disable-pip-version-check "$peer"; then
  run_pairs=("$tree/venv/bin/python" "$here/pairs/with_tight_inclusion.py" "$bench/pairs/libdartsweep_pairs.so")
else
  echo "benchmark: $peer can't be installed here: no pairs.tight_inclusion.* figures"
fi
"${run_pairs[@]}" $quick --generated "$pairs" --out "$tree" || failed+=(dartsweep_pairs)
"$bench/rigid/dartsweep_rigid" "${rigid[@]}" --json "$tree/rigid.json" || failed+=(dartsweep_rigid)
"$here/pairs/instructions.sh" "$bench/pairs/dartsweep_pairs" --json "$tree/pairs_instructions.json"
# property NAME EFFORT [FILTER]: random tests; their log is shown if one fails.
property() {
  DSW_EFFORT=$2 "$tree/tests/property/$1_tests" --gtest_filter="${3:-*}" --gtest_output="json:$tree/$1.json" > "$tree/$1.log" && return
  failed+=("$1_tests")
  tail -n 40 "$tree/$1.log"
}
property edits "$edits" "*EveryChange*"
property together "$together"
property together_deform "$together"
property near "$near"
property rays "$rays"
property cross_check 1
"$tree/tests/unit/cross_check/dartsweep_cross_check_kinds_test" --gtest_output="json:$tree/kinds.json" > "$tree/kinds.log" || failed+=(dartsweep_cross_check_kinds_test)
python3 "$here/merge.py" "$json" "$tree/tests/benchmark/libdartsweep_core.so" "$tree/edits.json" "$tree/cross_check.json" "$tree/together.json" "$tree/together_deform.json" "$tree/near.json" "$tree/rays.json" "$tree/walk.json" "$tree/contact.json" "$tree/contact_instructions.json" "$tree/walk_instructions.json" "$tree/edges_instructions.json" "$tree/fig9.json" "$tree/predicates.json" "$tree/exact_pairs.json" "$tree/pairs_instructions.json" "$tree/rigid.json" "$tree/drill.json" "$tree/oracle.json" "$tree/kinds.json"
echo "wrote $json"
[ ${#failed[@]} = 0 ] || { echo "benchmark: FAILED, because it found faults: ${failed[*]}" >&2; exit 1; }
echo "benchmark: no part found a fault"
