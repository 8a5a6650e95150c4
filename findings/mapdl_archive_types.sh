#!/bin/sh
# mapdl-archive, which reads Ansys's archives (.cdb) into PyVista, and solids of the coupled-field and porous types.
# One would guess that a brick is a brick, whatever physics its type has, or that a type which is not known is told.
# What happens: of the bricks SOLID185, SOLID225 and CPT215 the grid has one. The two others are elements of the archive (n_elem is 3), but no cells;
# tetrahedra of the same family (SOLID227, CPT217) are. No warning is given. A part of a body is a hole then, and its wall is open.
# Who meets it: whoever takes thermal, electric or poroelastic models, such as of bone and cartilage, from Ansys to VTK, PyVista or ParaView.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mapdl-archive==0.4.2 pyvista==0.49.1 vtk==9.7.2 numpy==2.4.6
"$folder/venv/bin/python" - "$folder/three.cdb" <<'PY'
import sys
import warnings

import mapdl_archive

TYPES = (185, 225, 215)
corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
points = [(x + 2 * i, y, z) for i in range(3) for x, y, z in corners]
with open(sys.argv[1], "w") as file:
    file.write("/PREP7\n" + "".join(f"ET,{i},{kind}\n" for i, kind in enumerate(TYPES, 1)))
    file.write(f"NBLOCK,6,SOLID,{len(points):10},{len(points):10}\n(3i9,6e21.13e3)\n")
    file.writelines(f"{i:9}{0:9}{0:9}{x:21.13E}{y:21.13E}{z:21.13E}\n" for i, (x, y, z) in enumerate(points, 1))
    file.write("N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID,3,3\n(19i9)\n")
    for i in range(3):
        row = [1, i + 1, 1, 1, 0, 0, 0, 0, 8, 0, i + 1, *range(8 * i + 1, 8 * i + 9)]
        file.write("".join(f"{number:9}" for number in row) + "\n")
    file.write(f"{-1:9}\nFINISH\n")
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    archive = mapdl_archive.Archive(sys.argv[1])
    cells = archive.grid.n_cells
print("mapdl-archive", mapdl_archive.__version__, "has", archive.n_elem, "elements and", cells, "cells; warnings:", [str(one.message) for one in told])
assert archive.n_elem == 3
assert cells == 1, "other types are read now"
assert not any("225" in str(one.message) or "type" in str(one.message) for one in told), "this is told now"
PY
