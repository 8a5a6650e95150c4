#!/usr/bin/env bash
# Thousands of independent insertions on Dask: examples/planning.sh [OPTIONS OF planning/sweep.py]
#
# Installs what is missing (Debian 12, as root), builds the library with its Python binding, and feeds a catheter into a winding vessel for
# every entry angle, stiffness and friction of a sweep: 2,176 insertions by 2 workers, each of which loads a snapshot of the vessel
# once. Leaves build/planning/insertions.csv, a row for each, and success.png, where they arrive. --help tells the options.
set -euo pipefail

usage() {
  sed -n '2,6s/^# \{0,1\}//p' "$0"
  exit "$1"
}
name=planning
. "$(dirname "$0")/setup.sh"
case "${1:-}" in -h | --help) usage 0 ;; esac

root=$(cd "$(dirname "$0")/.." && pwd)
source=$root/examples/planning
out=$root/build/planning
venv=$out/venv
log=$out/log.txt
mkdir -p "$out"
: > "$log"

needs_build_tools
needs_venv /usr/bin/python3 # not that of a version manager: python3-dev belongs to this one
[ -n "$(find /usr/include -path '/usr/include/python3*/Python.h' -print -quit)" ] || missing+=(python3-dev)
install_missing

make_venv "$venv" /usr/bin/python3 "$source/requirements.txt"

echo "building the library and its Python binding"
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)} PATH=$venv/bin:$PATH # SWIG
quietly "building the binding" "$venv/bin/python" "$(pip_of /usr/bin/python3)" install --disable-pip-version-check --no-deps --no-build-isolation \
  --force-reinstall "$root/bindings/python" --config-settings=build-dir="$out/binding"

OMP_NUM_THREADS=1 "$venv/bin/python" "$source/sweep.py" --out "$out" "$@"
echo
echo "  table   $out/insertions.csv"
echo "  picture $out/success.png"
