#!/bin/sh
# MFEM (PyMFEM) and the .vtu files that it writes (Mesh.PrintVTU) of a mesh of linear hexahedra.
# One would guess that neighbours share points in the file, as in the mesh: 27 points for 2 x 2 x 2 cells of a cube, whose surface is 6.
# What happens: each cell has eight points of its own, so the file has 64 points and no two cells hang together: the surface has the area 12, since
# all faces within are on it, and there are eight connected regions. Mesh.PrintVTK, of the older format, shares the points. clean() of PyVista merges
# them, and with them the sides of a crack, where the mesh has one.
# Who meets it: whoever goes from MFEM to VTK, PyVista or ParaView for surfaces, smooth normals, streamlines or walls: every cell is an island.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mfem==4.10.0.1 pyvista==0.49.1 vtk==9.7.2 numpy==2.4.6 scipy==1.17.1
cd "$folder"
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata

import mfem.ser as mfem
import pyvista


def measured(name):
    """Points, connected regions, and the area of the surface of a file."""
    grid = pyvista.read(name)
    regions = len(set(grid.connectivity("all")["RegionId"].tolist()))
    return grid.n_points, regions, round(grid.extract_surface(algorithm="dataset_surface").area, 6), round(grid.volume, 6)


mesh = mfem.Mesh.MakeCartesian3D(2, 2, 2, mfem.Element.HEXAHEDRON)
mesh.PrintVTU("cube", 0)
mesh.PrintVTK("cube.vtk")
found = {name: measured(name) for name in ("cube.vtu", "cube.vtk")}
print("mfem", importlib.metadata.version("mfem"), "PyVista", pyvista.__version__, mesh.GetNV(), "vertices; points, regions, surface, volume of its files:", found)
assert mesh.GetNV() == 27 and found["cube.vtk"] == (27, 1, 6, 1)
assert found["cube.vtu"] == (64, 8, 12, 1), "cells share points now"
PY
