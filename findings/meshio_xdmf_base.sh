#!/bin/sh
# meshio and XDMF files whose points are numbered from 1, or stand in another order (BaseOffset and Order of Topology).
# One would guess that a reader of XDMF follows these attributes of the format, or says that it does not know them.
# What happens: meshio takes the numbers as they stand. With BaseOffset="1" the cells name the next point each, so a tetrahedron has another shape if
# the file has a point more, and an index too large if not. With Order the corners of a hexahedron are crossed. VTK follows both. No warning is given.
# Who meets it: whoever reads XDMF of codes in Fortran, or of writers that keep their own order of corners.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile meshio==5.3.5 vtk==9.7.2 numpy==2.2.6 h5py==3.16.0
"$folder/venv/bin/python" - "$folder/one.xdmf" <<'PY'
import sys

import meshio
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

points = " ".join(f"{x} {y} {z}" for z in (0, 1) for y in (0, 1) for x in (0, 1)) + " 9 9 9"
found = {}
for name, kind, said, rows in (
    ("base 1", "Tetrahedron", 'BaseOffset="1"', [1, 2, 3, 5]),
    ("order", "Hexahedron", 'Order="0 1 3 2 4 5 7 6"', [0, 1, 2, 3, 4, 5, 6, 7]),
):
    with open(sys.argv[1], "w") as file:
        file.write(f"""<?xml version="1.0"?><Xdmf Version="3.0"><Domain><Grid Name="one" GridType="Uniform">
<Topology TopologyType="{kind}" NumberOfElements="1" {said}><DataItem Dimensions="1 {len(rows)}" NumberType="Int" Format="XML">{" ".join(map(str, rows))}</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="9 3" Format="XML">{points}</DataItem></Geometry></Grid></Domain></Xdmf>""")
    reader = vtkXdmfReader()
    reader.SetFileName(sys.argv[1])
    reader.Update()
    cell = reader.GetOutputDataObject(0).GetCell(0)
    found[name] = [cell.GetPointId(i) for i in range(len(rows))], meshio.read(sys.argv[1]).cells[0].data[0].tolist(), rows
print("VTK", vtkVersion.GetVTKVersion(), "meshio", meshio.__version__, "points of the cell by each, and the file's numbers:", found)
assert found["base 1"][0] == [0, 1, 2, 4] and found["order"][0] == [0, 1, 3, 2, 4, 5, 7, 6], "VTK does otherwise now"
assert all(by_meshio == rows for _, by_meshio, rows in found.values()), "meshio follows them now"
PY
