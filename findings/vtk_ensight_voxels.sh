#!/bin/sh
# VTK and the cells that its writer of EnSight files leaves out: those of a thresholded image, hexahedra of 27 and wedges of 18 nodes.
# One would guess that voxels are written as hexahedra, for they are ones, that second-order cells lose their middle nodes at most, as EnSight has hexa20 and
# penta15, or that the writer says what it can not write.
# What happens: the points are written, and of these cells none. A threshold of an image, whose cells are of the type voxel, is a cloud of points in EnSight
# and ParaView; of a mesh with both, the hexahedra of 27 nodes are holes. Write() gives 1, and the log has no line. Hexahedra of 8 and 20
# nodes, and polyhedra, are kept.
# Who meets it: whoever goes from CT, segmentation or voxels to EnSight's files, or from solvers with full second-order elements.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pyvista==0.49.2 vtk==9.7.2 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import numpy as np
import pyvista
import vtk

vtk.vtkLogger.LogToFile("log.txt", vtk.vtkLogger.APPEND, vtk.vtkLogger.VERBOSITY_WARNING)


def grid(kinds):
    points, cells = np.empty((0, 3)), []
    for place, kind in enumerate(kinds):
        cell = vtk.vtkGenericCell.InstantiateCell(kind)
        count = cell.GetNumberOfPoints()
        corners = np.array([cell.GetParametricCoords()[i] for i in range(3 * count)]).reshape(-1, 3)
        cells += [count, *range(len(points), len(points) + count)]
        points = np.vstack([points, corners + [2 * place, 0, 0]])
    return pyvista.UnstructuredGrid(np.array(cells), np.array(kinds, np.uint8), points)


def round_trip(mesh, name):
    mesh.cell_data["BlockId"] = np.ones(mesh.n_cells, np.int32)
    writer = vtk.vtkEnSightWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(name + ".case")
    assert writer.Write() == 1
    reader = vtk.vtkEnSightGoldBinaryReader()
    reader.SetCaseFileName(name + ".0.case")
    reader.Update()
    found = pyvista.wrap(reader.GetOutput()).combine()
    return [mesh.n_cells, found.n_cells, found.n_points == mesh.n_points]


image = pyvista.ImageData(dimensions=(4, 4, 4))
image.cell_data["tissue"] = np.arange(27.0) % 2
found = {"threshold": round_trip(image.threshold(0.5), "threshold")}
for name, kind in {"27 nodes": vtk.VTK_TRIQUADRATIC_HEXAHEDRON, "18 nodes": vtk.VTK_BIQUADRATIC_QUADRATIC_WEDGE, "20 nodes": vtk.VTK_QUADRATIC_HEXAHEDRON}.items():
    found[name] = round_trip(grid([vtk.VTK_HEXAHEDRON, kind]), name.replace(" ", "_"))
warned = [line for line in open("log.txt") if "WARN|" in line or "ERR|" in line]
print("VTK", vtk.vtkVersion.GetVTKVersion(), "cells written, read, and whether all points are there:", found, "warnings:", len(warned))
assert found["threshold"] == [13, 0, True], "voxels are written now"
assert all(found[name] == [2, 1, True] for name in ("27 nodes", "18 nodes")) and found["20 nodes"] == [2, 2, True] and not warned
PY
