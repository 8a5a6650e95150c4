#!/bin/sh
# meshio and a wedge in a grid of FLAC3D (.f3grid).
# One would guess that a wedge has the same volume after meshio has written and read it.
# What happens: the volume changes its sign, 0.5 to -0.5; tetrahedra, pyramids and hexahedra keep theirs. A second round turns it back.
# Who meets it: whoever converts boundary layers or extruded soil layers to or from FLAC3D and needs signs: Jacobians, normals, inside tests.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q meshio==5.3.5
"$folder/venv/bin/python" - "$folder/one.f3grid" <<'PY'
import sys
import meshio
import numpy as np

cube = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
prism = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)], float)
faces = {  # counter-clockwise seen from outside
    "tetra": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
    "wedge": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    "hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
}
shapes = {"tetra": prism[:4], "pyramid": np.array([*cube[:4], (0.5, 0.5, 1)]), "wedge": prism, "hexahedron": cube}


def volume(mesh):
    (block,) = (block for block in mesh.cells if block.type in faces)
    corners = mesh.points[block.data[0]]
    return sum(corners[f[0]] @ np.cross(corners[b], corners[c]) / 6 for f in faces[block.type] for b, c in zip(f[1:], f[2:]))


ratios = {}
for kind, points in shapes.items():
    mesh = meshio.Mesh(points, [(kind, [list(range(len(points)))])])
    meshio.write(sys.argv[1], mesh)
    ratios[kind] = round(volume(meshio.read(sys.argv[1])) / volume(mesh), 9)
print("meshio", meshio.__version__, "volume after and before:", ratios)
assert ratios == {"tetra": 1, "pyramid": 1, "wedge": -1, "hexahedron": 1}, "this has changed"
PY
