#!/bin/sh
# Gmsh and quadratic cells in legacy VTK files (.vtk).
# One would guess that a straight hexahedron of 20 nodes with volume 1 has volume 1 after Gmsh has read it, at least from a file of its own.
# What happens: Gmsh writes nodes in VTK's order, and VTK finds volume 1. Reading, it takes them as in its own order: hexahedra of 20 and 27 nodes
# and wedges of 15 and 18 have sides that run across the cell, and integrals over them are even negative. Tetrahedra are right. No warning is
# given. Files of version 5.1, which VTK has written since 9.0 unless told otherwise, are refused.
# Who meets it: whoever takes a mesh of second order from VTK, ParaView or PyVista to Gmsh, or reads one back that Gmsh has written as .vtk.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile gmsh==4.15.2 vtk==9.7.2 numpy==2.4.6
"$folder/venv/bin/python" - "$folder/one.vtk" <<'PY'
import sys

import gmsh
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkUnstructuredGrid
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader, vtkUnstructuredGridWriter

TYPES = {"tetrahedron 10": 24, "hexahedron 20": 25, "hexahedron 27": 29, "wedge 15": 26, "wedge 18": 32}


def write(kind, version):
    """One straight cell, its nodes where VTK says that they are."""
    cell = vtkGenericCell.InstantiateCell(kind)
    places, points, ids = cell.GetParametricCoords(), vtkPoints(), vtkIdList()
    points.SetDataTypeToDouble()
    for i in range(cell.GetNumberOfPoints()):
        ids.InsertNextId(points.InsertNextPoint(*(places[3 * i + k] for k in range(3))))
    grid, writer = vtkUnstructuredGrid(), vtkUnstructuredGridWriter()
    grid.SetPoints(points)
    grid.InsertNextCell(kind, ids)
    writer.SetFileName(sys.argv[1])
    writer.SetFileVersion(version)
    writer.SetInputData(grid)
    writer.Write()


def by_vtk():
    reader, sizes = vtkUnstructuredGridReader(), vtkCellSizeFilter()
    reader.SetFileName(sys.argv[1])
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    return round(sizes.GetOutput().GetCellData().GetArray("Volume").GetValue(0), 3)


def by_gmsh():
    gmsh.clear()
    gmsh.merge(sys.argv[1])
    (kind,), _, _ = gmsh.model.mesh.getElements(3)
    places, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss6")
    return round(float(gmsh.model.mesh.getJacobians(kind, places)[1] @ weights), 3)


gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
found, own = {}, {}
for name, kind in TYPES.items():
    write(kind, 42)
    found[name] = by_vtk(), by_gmsh()
log = [line for line in gmsh.logger.get() if line.startswith(("Warning", "Error"))]
for incomplete in (0, 1):
    gmsh.clear()
    face = gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.extrude([(2, face)], 0, 0, 1, numElements=[1], recombine=True)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.setTransfiniteAutomatic()
    gmsh.model.mesh.setTransfiniteSurface(face)
    gmsh.model.mesh.setRecombine(2, face)
    for curve in gmsh.model.getEntities(1):
        gmsh.model.mesh.setTransfiniteCurve(curve[1], 2)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", incomplete)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    gmsh.model.addPhysicalGroup(3, [1], 1)  # only its elements are written
    gmsh.write(sys.argv[1])
    own[(27, 20)[incomplete]] = by_vtk(), by_gmsh()
write(25, 51)
try:
    newer = by_gmsh()
except Exception as error:
    newer = "refused" if "Error loading" in str(error) else str(error)
gmsh.finalize()
print("gmsh", gmsh.__version__, "VTK", vtkVersion.GetVTKVersion(), "volumes by VTK and by Gmsh:", found)
print("of hexahedra that Gmsh wrote, by nodes:", own, "version 5.1:", newer)
assert all(name == "tetrahedron 10" and pair[0] == pair[1] or pair[0] > 0.49 and pair[1] < 0.7 * pair[0] for name, pair in found.items()), "nodes are renumbered now"
assert all(pair[0] == 1 and pair[1] < 0 for pair in own.values()) and newer == "refused", "Gmsh does otherwise now"
assert not log, "this is told now"
PY
