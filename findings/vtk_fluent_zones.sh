#!/bin/sh
# VTK and the boundary zones of a Fluent file (.msh, .cas).
# One would guess that the block of the zone "inlet" has the faces of the inlet, because other readers with patches (OpenFOAM, CGNS) give faces.
# What happens: the block has the cells beside these faces, whole, and once for each face. A cell with two faces in the zone "wall" is there twice.
# No warning is given. Areas and surface integrals of the block are of all sides of the cells.
# Who meets it: whoever takes a patch of a Fluent mesh by VTK, PyVista or ParaView, and whoever merges all blocks, which counts cells several times.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q vtk==9.7.2
cat > "$folder/one.msh" <<'MSH'
(0 "one cube; the inlet is its side at x = 0")
(2 3)
(10 (0 1 8 0 3))
(10 (1 1 8 1 3)(
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
))
(12 (0 1 1 0))
(12 (2 1 1 1 4))
(13 (0 1 6 0))
(13 (3 1 1 a 4)(
1 4 8 5 1 0
))
(13 (4 2 6 3 4)(
2 6 7 3 1 0
1 5 6 2 1 0
4 3 7 8 1 0
1 2 3 4 1 0
5 8 7 6 1 0
))
(39 (2 fluid water)())
(39 (3 velocity-inlet inlet)())
(39 (4 wall wall)())
MSH
"$folder/venv/bin/python" - "$folder/one.msh" <<'PY'
import sys
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOGeometry import vtkFLUENTReader

reader = vtkFLUENTReader()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput()
blocks = {}
for i in range(data.GetNumberOfBlocks()):
    block = data.GetBlock(i)
    types = [block.GetCell(k).GetClassName() for k in range(block.GetNumberOfCells())]
    blocks[data.GetMetaData(i).Get(data.NAME())] = types
print("VTK", vtkVersion.GetVTKVersion(), blocks)
inlet, wall = (next(types for name, types in blocks.items() if name.startswith(zone)) for zone in ("inlet", "wall"))
assert inlet == ["vtkHexahedron"] and wall == 5 * ["vtkHexahedron"], "faces are given now"
PY
