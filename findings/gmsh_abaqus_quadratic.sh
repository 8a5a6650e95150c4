#!/bin/sh
# Gmsh and quadratic wedges and hexahedra in Abaqus files (.inp).
# One would guess that wedges of 15 nodes are written as C3D15 and hexahedra as C3D20, the types that Abaqus and CalculiX have.
# What happens: wedges of 18 nodes are written as C3D6, the type with 6 nodes, and hexahedra of 27 nodes as C3D27, which CalculiX has not.
# With the option Mesh.SecondOrderIncomplete, cells have 15 and 20 nodes and the right names. No warning is given.
# Who meets it: whoever extrudes a boundary layer in Gmsh, sets order 2 and solves with CalculiX, or reads the file with meshio, which stops.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q gmsh==4.15.2
"$folder/venv/bin/python" - "$folder/mesh.inp" <<'PY'
import re
import sys
import gmsh

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("Mesh.MeshSizeMin", 2)
gmsh.logger.start()


def written(quads, incomplete):
    """The type that the file names, and how many nodes its first element has."""
    gmsh.clear()
    face = gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.extrude([(2, face)], 0, 0, 1, numElements=[1], recombine=True)
    gmsh.model.occ.synchronize()
    if quads:
        gmsh.model.mesh.setTransfiniteSurface(face)
        gmsh.model.mesh.setRecombine(2, face)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", incomplete)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    gmsh.write(sys.argv[1])
    name, row = re.search(r"type=(C3D\d+).*\n((?:.*,\s*\n)*.*)", open(sys.argv[1]).read()).groups()
    return name, len(gmsh.model.mesh.getElements(3)[2][0]) // len(gmsh.model.mesh.getElements(3)[1][0])


found = {(quads, incomplete): written(quads, incomplete) for quads in (0, 1) for incomplete in (0, 1)}
log = gmsh.logger.get()
print("gmsh", gmsh.__version__, "(quads, incomplete): (type, nodes):", found)
assert found[0, 0] == ("C3D6", 18) and found[1, 0] == ("C3D27", 27), "this has changed"
assert not any(line.startswith(("Warning", "Error")) for line in log), "this is told now"
gmsh.finalize()
PY
