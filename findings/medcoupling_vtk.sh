#!/bin/sh
# MEDCoupling (Salome's library of meshes) and the .vtu files that it writes.
# One would guess that cells whose volume it calls 1 have volume 1 in VTK, since writeVTK is there for VTK and ParaView.
# What happens: nodes are written in MED's order, which is the other way round, so tetrahedra, pyramids, wedges and hexahedra have negative volumes in
# VTK, and normals of their faces point inwards. Polyhedra are right. A mesh with both has both signs. No warning is given.
# Who meets it: whoever looks at meshes of Salome in ParaView and cuts, integrates or asks for Jacobians, or goes on to a solver by .vtu.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile medcoupling==9.15.0 vtk==9.7.2 numpy==2.4.6
cd "$folder"
venv/bin/python - <<'PY'
import importlib.metadata

import medcoupling
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

BASE, TOP = [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)], [(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)]
CELLS = {  # in MED's order, so that MEDCoupling has positive volumes
    "tetrahedron": (medcoupling.NORM_TETRA4, [*BASE[:2], BASE[3], TOP[0]]),
    "pyramid": (medcoupling.NORM_PYRA5, [*BASE, TOP[0]]),
    "wedge": (medcoupling.NORM_PENTA6, [*BASE[:2], BASE[3], *TOP[:2], TOP[3]]),
    "hexahedron": (medcoupling.NORM_HEXA8, BASE + TOP),
    "polyhedron": (medcoupling.NORM_HEXA8, BASE + TOP),
}
found = {}
for name, (kind, points) in CELLS.items():
    mesh = medcoupling.MEDCouplingUMesh("one", 3)
    mesh.setCoords(medcoupling.DataArrayDouble([float(x) for point in points for x in point], len(points), 3))
    mesh.allocateCells(1)
    mesh.insertNextCell(kind, list(range(len(points))))
    mesh.finishInsertingCells()
    if name == "polyhedron":
        mesh.convertAllToPoly()
    mesh.writeVTK("one.vtu", False)
    reader, sizes = vtkXMLUnstructuredGridReader(), vtkCellSizeFilter()
    reader.SetFileName("one.vtu")
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    found[name] = round(mesh.getMeasureField(False).getArray()[0], 3), round(sizes.GetOutput().GetCellData().GetArray("Volume").GetValue(0), 3)
print("medcoupling", importlib.metadata.version("medcoupling"), "VTK", vtkVersion.GetVTKVersion(), "volumes by each:", found)
assert all(own > 0 and (by_vtk == own if name == "polyhedron" else by_vtk == -own) for name, (own, by_vtk) in found.items()), "this has changed"
PY
