#!/bin/sh
# meshio, Gmsh and a .msh file with geometrical and physical numbers.
# One would guess that Gmsh reads what meshio writes in Gmsh's current format, 4.1, with the cell data that meshio's own reader gives.
# What happens: the file names an entity that it does not list, because meshio writes no entities for these numbers. Gmsh refuses it:
# "Unknown entity 1 of dimension 3". Without the numbers, or as version 2.2, Gmsh reads the same mesh.
# Who meets it: whoever reads a mesh of Gmsh's with meshio in Python, changes it, and writes it again as .msh.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q gmsh==4.15.2 meshio==5.3.5
"$folder/venv/bin/python" - "$folder/one.msh" <<'PY'
import sys
import gmsh
import meshio
import numpy as np

points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
numbers = {"gmsh:physical": [np.array([7])], "gmsh:geometrical": [np.array([1])]}
gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
found = {}
for version, data in (("gmsh", {}), ("gmsh22", numbers), ("gmsh", numbers)):
    meshio.write(sys.argv[1], meshio.Mesh(points, [("tetra", [[0, 1, 2, 3]])], cell_data=data), file_format=version)
    assert len(meshio.read(sys.argv[1]).cells_dict["tetra"]) == 1
    gmsh.clear()
    try:
        gmsh.merge(sys.argv[1])
        found[version, bool(data)] = sum(map(len, gmsh.model.mesh.getElements(3)[1]))
    except Exception as error:
        found[version, bool(data)] = str(error)
print("meshio", meshio.__version__, "gmsh", gmsh.__version__, found)
assert found == {("gmsh", False): 1, ("gmsh22", True): 1, ("gmsh", True): "Unknown entity 1 of dimension 3"}, "this has changed"
gmsh.finalize()
PY
