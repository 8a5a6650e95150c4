#!/usr/bin/env bash
# The tests of the wheel that install.sh has installed, the examples, the planning and the coupling that stand on it, and the demo's surfaces:
# bindings/python/test.sh [ROD], which is bindings/rod as a static library, else it is compiled.
set -euo pipefail
rod=${1:+$(realpath "$1")}
cd "$(dirname "$0")/../.."
python=$PWD/build/python/venv/bin/python
tests=$PWD/build/python/tests.xml

# The module once more, with the shared library that the tests of abi/ guard, in build/dartsweep: another processor compiles it meanwhile.
build_shared() {
  PATH=$(dirname "$python"):$PATH cmake -S bindings/python -B build/python/shared -DCMAKE_BUILD_TYPE=Release -DDSW_QUICK_BUILD=ON -DDSW_USE_INSTALLED=ON \
    -DDSW_PYTHON_SHARED=ON "-DDSW_ROD=$rod" -DCMAKE_PREFIX_PATH="$PWD/build/dartsweep" -DPython3_EXECUTABLE="$python" && cmake --build build/python/shared
}
build_shared >build/python/shared.log 2>&1 &
build=$!
trap 'kill "$build" 2>/dev/null || true' EXIT

export DARTSWEEP_OTHER_VTK=$PWD/build/python/vtk-9.6.2
"$python" -m pytest bindings/python --junitxml="$tests"
wait "$build" || { tail -n 20 build/python/shared.log >&2; exit 1; }
DARTSWEEP_LIBRARY=$PWD/build/dartsweep/lib/libdartsweep.so PYTHONPATH=$PWD/build/python/shared "$python" -m pytest -p no:cacheprovider \
  bindings/python/tests/test_{shared,scenario,ids,ownership,together,rod,near,errors}.py
for example in "$PWD"/bindings/python/examples/*.py; do (cd build/python && "$python" "$example"); done # one leaves a picture
"$python" -m pytest examples/planning examples/insertion
"$python" -m pytest examples/couple # apart: modules of planning have the same names
"$python" -m pytest -p no:cacheprovider tests/benchmark/error/dials # the curves of dials in a small form
# The demo's meshes want a Python that has the readers.
if [ -e build/release/examples/insertion/dartsweep_insertion ]; then
  PATH=$(dirname "$python"):$PATH ctest --test-dir build/release -R '^insertion_real$' --no-tests=error --output-on-failure
else
  echo "insertion_real is skipped: the step release has not run"
fi
echo "python: $(grep -o 'tests="[0-9]*"' "$tests" | tr -dc 0-9) tests passed, and the examples"
