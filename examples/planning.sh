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
fail() {
  echo "planning: $1" >&2
  exit 1
}
case "${1:-}" in -h | --help) usage 0 ;; esac

root=$(cd "$(dirname "$0")/.." && pwd)
source=$root/examples/planning
out=$root/build/planning
venv=$out/venv
log=$out/log.txt
mkdir -p "$out"
: > "$log"

# Runs a command with its output in the log; on failure shows the end of it.
quietly() {
  local what=$1
  shift
  "$@" >> "$log" 2>&1 < /dev/null || {
    tail -n 20 "$log" >&2
    fail "$what failed; all of its output is in $log"
  }
}

# Packages: each line is a test that it is there, and what to install if it is not.
missing=()
command -v c++ > /dev/null && command -v cc > /dev/null || missing+=(g++)
command -v cmake > /dev/null || missing+=(cmake)
command -v make > /dev/null || missing+=(make)
[ -e /usr/include/eigen3/Eigen/Core ] || missing+=(libeigen3-dev)
command -v swig > /dev/null || missing+=(swig)
[ -n "$(find /usr/include -path '/usr/include/python3*/Python.h' -print -quit)" ] || missing+=(python3-dev)
/usr/bin/python3 -c 'import ensurepip, venv' 2> /dev/null || missing+=(python3-venv)
if [ ${#missing[@]} -gt 0 ]; then
  command -v apt-get > /dev/null && [ "$(id -u)" -eq 0 ] ||
    fail "these packages are missing and only root on Debian can have them installed here: ${missing[*]}"
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  quietly "updating the package lists" apt-get update -q
  quietly "installing ${missing[*]}" apt-get install -q -y --no-install-recommends "${missing[@]}"
fi

# Python modules, pinned, in a folder of their own; again only when the list has changed.
if ! cmp -s "$source/requirements.txt" "$venv/installed.txt"; then
  echo "installing Python modules"
  quietly "creating build/planning/venv" /usr/bin/python3 -m venv --clear "$venv"
  quietly "installing Python modules" "$venv/bin/pip" install --disable-pip-version-check -r "$source/requirements.txt"
  cp "$source/requirements.txt" "$venv/installed.txt"
fi

echo "building the library and its Python binding"
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
quietly "building the binding" "$venv/bin/pip" install --disable-pip-version-check --no-deps --no-build-isolation \
  --force-reinstall "$root/bindings/python" --config-settings=build-dir="$out/binding"

OMP_NUM_THREADS=1 "$venv/bin/python" "$source/sweep.py" --out "$out" "$@"
echo
echo "  table   $out/insertions.csv"
echo "  picture $out/success.png"
