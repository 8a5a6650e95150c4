#!/bin/sh
# Newton and a mesh of two volumes in one file, as Gmsh writes it.
# One would guess that TetMesh.create_from_file has the tetrahedra of the whole file, because all of them are tetrahedra.
# What happens: of two cubes beside each other it has one, half of the tetrahedra. The points of the other cube are kept, and no tetrahedron has them.
# The reader takes the first block of tetrahedra that meshio gives, and meshio gives one for each volume of a .msh file. No warning is given.
# Who meets it: whoever has two tissues, or a part and its surroundings, in one mesh: a tool then moves through the second one as if it were air.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/cache"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile newton==1.8.0 warp-lang==1.19.0 meshio==5.3.5 gmsh==4.15.2 numpy==2.4.6
"$folder/venv/bin/python" - "$folder/two.msh" <<'PY'
import sys

import gmsh
import newton
import numpy as np

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
boxes = [(3, gmsh.model.occ.addBox(x, 0, 0, 1, 1, 1)) for x in (0, 1)]
gmsh.model.occ.fragment(boxes[:1], boxes[1:])
gmsh.model.occ.synchronize()
for number, (_, box) in enumerate(gmsh.model.getEntities(3), 1):
    gmsh.model.addPhysicalGroup(3, [box], number)
gmsh.option.setNumber("Mesh.MeshSizeMin", 1)
gmsh.option.setNumber("Mesh.MeshSizeMax", 1)
gmsh.model.mesh.generate(3)
count = sum(len(numbers) for numbers in gmsh.model.mesh.getElements(3)[1])
gmsh.write(sys.argv[1])
gmsh.finalize()

mesh = newton.TetMesh.create_from_file(sys.argv[1])
corners = np.asarray(mesh.vertices)[np.asarray(mesh.tet_indices).reshape(-1, 4)]
sides = corners[:, 1:] - corners[:, :1]
volume = float(np.abs(np.linalg.det(sides)).sum()) / 6
print("newton", newton.__version__, "has", mesh.tet_count, "of", count, "tetrahedra, with volume", volume, "of 2")
assert mesh.tet_count < count and abs(volume - 1) < 1e-5, "both volumes are there now"
PY
