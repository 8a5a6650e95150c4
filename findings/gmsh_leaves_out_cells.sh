#!/bin/sh
# Gmsh and wedges and pyramids in Medit's .mesh and I-deas' .unv files.
# One would guess that a mesh of a tetrahedron, a hexahedron, a wedge and a pyramid has four cells in every file that Gmsh writes without a
# word, and that Gmsh reads the four of a .mesh file, whose format has keywords for each.
# What happens: .mesh files get two cells, .unv files three, since the pyramid is left out. Of a .mesh file with all four, which meshio writes and
# reads, Gmsh reads two. There is no error and no warning either way. MED and .msh files keep all.
# Who meets it: whoever has boundary layers or pyramids between hexahedra and tetrahedra, and passes them to Medit, Mmg, Salome or FreeCAD.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile gmsh==4.15.2 meshio==5.3.5 numpy==2.2.6
cd "$folder"
venv/bin/python - <<'PY'
import gmsh
import meshio
import numpy as np

POINTS = np.array([(x, y, z) for z in (0, 1, 2) for y in (0, 1) for x in (0, 1, 2)], float)
CELLS = {"hexahedron": (5, [1, 2, 5, 4, 7, 8, 11, 10]), "wedge": (6, [2, 3, 5, 8, 9, 11]), "pyramid": (7, [7, 8, 11, 10, 13]), "tetra": (4, [8, 9, 11, 15])}


def count():
    return sum(map(len, gmsh.model.mesh.getElements(3)[1]))


def messages():
    return [line for line in gmsh.logger.get() if line.startswith(("Warning", "Error"))]


gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.model.addDiscreteEntity(3, 1)
gmsh.model.mesh.addNodes(3, 1, list(range(1, len(POINTS) + 1)), POINTS.ravel())
for i, (kind, nodes) in enumerate(CELLS.values(), 1):
    gmsh.model.mesh.addElementsByType(1, kind, [i], nodes)
gmsh.model.addPhysicalGroup(3, [1], 1, "all")
made = count()
for ending in ("mesh", "unv", "med", "msh"):
    gmsh.write("own." + ending)
found = {}
for ending in ("mesh", "med", "msh"):
    gmsh.clear()
    gmsh.merge("own." + ending)
    found[ending] = count()
elements = open("own.unv").read().split("  2412\n")[1].split("\n    -1")[0].splitlines()
found["unv"] = sum(1 for line in elements if line.split()[1:2] in (["111"], ["112"], ["115"]) and len(line.split()) == 6)  # solids with 4, 6 and 8 nodes
text = open("own.mesh").read()
meshio.write("four.mesh", meshio.Mesh(POINTS, [(name, [np.array(nodes) - 1]) for name, (_, nodes) in CELLS.items()]))
again = sum(len(block.data) for block in meshio.read("four.mesh").cells)
gmsh.clear()
gmsh.merge("four.mesh")
read, log = count(), messages()
print("gmsh", gmsh.__version__, "has", made, "cells and in files of its own", found, "and from one of meshio's, in which meshio finds", again, ":", read, log)
gmsh.finalize()
assert made == 4 and found == {"mesh": 2, "med": 4, "msh": 4, "unv": 3} and "Prisms" not in text and "Pyramids" not in text, "files have them now"
assert again == 4 and read == 2, "cells of .mesh are read now"
assert not log, "this is told now"
PY
