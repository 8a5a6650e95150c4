#!/usr/bin/env bash
# build/python/venv, with the wheel as users get it and all that is used with it: bindings/python/install.sh FOLDER [ROD]. Dartsweep
# is installed in FOLDER as a static library, and ROD is bindings/rod as one, else it is compiled. The wheel is built from the source distribution and has a tag of the systems that it is for; but its library
# is that of FOLDER, and what is compiled here is optimized less.
set -euo pipefail
library=$(cd "$1" && pwd)
rod=${2:+$(realpath "$2")}
cd "$(dirname "$0")/../.."
out=$PWD/build/python
venv=$out/venv
mkdir -p "$out"

cat bindings/{python/tests,docs}/requirements.txt examples/{planning,couple}/requirements.txt >"$out/requirements.txt"
if ! cmp -s "$out/requirements.txt" "$venv/installed.txt"; then
  /usr/bin/python3 -m venv --clear "$venv" # not that of a version manager: python3-dev belongs to this one
  "$venv/bin/pip" install -q --no-compile -r "$out/requirements.txt"
  cp "$out/requirements.txt" "$venv/installed.txt"
fi
other=$out/vtk-9.6.2 # wedges and polyhedra are tested with a release from before VTK 9.7, too
[ -d "$other" ] || "$venv/bin/pip" install -q --no-compile --no-deps --target "$other" vtk==9.6.2
export PATH=$venv/bin:$PATH # its SWIG rather than Debian's
rm -rf "$out/dist"
python -m build --no-isolation --outdir "$out/dist" \
  -Ccmake.define.DSW_USE_INSTALLED=ON -Ccmake.define.CMAKE_PREFIX_PATH="$library" -Ccmake.define.DSW_QUICK_BUILD=ON "-Ccmake.define.DSW_ROD=$rod" bindings/python
auditwheel repair --wheel-dir "$out/dist/tagged" "$out"/dist/*.whl
pip install -q --no-deps --force-reinstall "$out"/dist/tagged/*-manylinux*.whl
