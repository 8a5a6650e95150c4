#!/bin/sh
# PyVista and a field that is replaced by a part of itself.
# One would guess that mesh.field_data["a"] = mesh.field_data["a"][:3] leaves three numbers.
# What happens: all numbers stay, without a warning, because a slice knows the array of VTK that it comes from and that array is added again.
# Who meets it: whoever shortens a field in place; np.array(...) round the slice helps.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q pyvista==0.49.1 vtk==9.7.2
"$folder/venv/bin/python" - <<'PY'
import numpy as np
import pyvista

print("pyvista", pyvista.__version__)
mesh = pyvista.PolyData()
mesh.field_data["a"] = np.arange(10)
mesh.field_data["a"] = mesh.field_data["a"][:3]
print("after a[:3]:", mesh.field_data["a"])
assert len(mesh.field_data["a"]) == 10, "the slice is taken now"
mesh.field_data["a"] = np.array(mesh.field_data["a"][:3])
assert len(mesh.field_data["a"]) == 3
PY
