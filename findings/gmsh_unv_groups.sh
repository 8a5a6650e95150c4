#!/bin/sh
# Gmsh and the groups of a universal file (.unv), as Salome, FreeCAD and Netgen write them.
# One would guess that the groups "inlet" and "fluid" are physical groups after reading, because Gmsh writes its own physical groups so.
# What happens: Gmsh reads nodes and elements only. Each dimension has one physical group without a name, made of a number of the elements.
# No warning is given.
# Who meets it: whoever brings a mesh with boundary names from Salome or FreeCAD into Gmsh, or converts it by Gmsh.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q gmsh==4.15.2
"$folder/venv/bin/python" - "$folder/groups.unv" <<'PY'
import sys
import gmsh

points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
elements = [(1, 111, (1, 2, 3, 4)), (2, 91, (1, 3, 2))]  # a tetrahedron and its lower side
groups = [("fluid", 1), ("inlet", 2)]
with open(sys.argv[1], "w") as file:
    file.write("    -1\n  2411\n")
    for i, point in enumerate(points, 1):
        file.write(f"{i:10}{1:10}{1:10}{11:10}\n" + "".join(f"{x:25.16E}" for x in point) + "\n")
    file.write("    -1\n    -1\n  2412\n")
    for number, kind, nodes in elements:
        file.write(f"{number:10}{kind:10}{1:10}{1:10}{7:10}{len(nodes):10}\n" + "".join(f"{node:10}" for node in nodes) + "\n")
    file.write("    -1\n    -1\n  2467\n")
    for i, (name, element) in enumerate(groups, 1):
        file.write("".join(f"{n:10}" for n in (i, 0, 0, 0, 0, 0, 0, 1)) + f"\n{name}\n" + "".join(f"{n:10}" for n in (8, element, 0, 0)) + "\n")
    file.write("    -1\n")
gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.merge(sys.argv[1])
log = gmsh.logger.get()
names = [gmsh.model.getPhysicalName(*group) for group in gmsh.model.getPhysicalGroups()]
print("gmsh", gmsh.__version__, "names of physical groups:", names, "log:", log)
assert "inlet" not in names and "fluid" not in names, "the groups are read now"
assert not any(line.startswith(("Warning", "Error")) for line in log), "this is told now"
gmsh.finalize()
PY
