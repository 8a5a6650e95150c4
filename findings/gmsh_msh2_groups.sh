#!/bin/sh
# Gmsh, MSH 2.2 and tetrahedra that are in two physical groups.
# One would guess that a mesh has as many tetrahedra after it was written and read as before.
# What happens: the version 2.2 has one group for each element, so Gmsh writes an element once for each of its groups, under a new number.
# Gmsh and meshio then read both: twice as many tetrahedra, and twice the volume. No warning is given. Version 4.1 keeps them once.
# Who meets it: whoever has a group "all" beside "lumen" and "tissue", and writes 2.2 for a solver that wants it.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q gmsh==4.15.2 meshio==5.3.5
"$folder/venv/bin/python" - "$folder" <<'PY'
import sys
import gmsh
import meshio

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)


def count():
    return sum(map(len, gmsh.model.mesh.getElements(3)[1]))


gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
gmsh.model.occ.synchronize()
gmsh.model.addPhysicalGroup(3, [1], 1, "all")
gmsh.model.addPhysicalGroup(3, [1], 2, "lumen")
gmsh.model.mesh.generate(3)
made = count()
for version in (2.2, 4.1):
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.write(f"{sys.argv[1]}/{version}.msh")
gmsh.logger.start()
found = {}
for version in (2.2, 4.1):
    gmsh.clear()
    gmsh.merge(f"{sys.argv[1]}/{version}.msh")
    found[version] = count(), sum(len(block.data) for block in meshio.read(f"{sys.argv[1]}/{version}.msh").cells if block.type == "tetra")
log = gmsh.logger.get()
print("gmsh", gmsh.__version__, "made", made, "tetrahedra; Gmsh and meshio read by version:", found)
assert found == {2.2: (2 * made, 2 * made), 4.1: (made, made)}, "this has changed"
assert not any(line.startswith(("Warning", "Error")) for line in log), "this is told now"
gmsh.finalize()
PY
