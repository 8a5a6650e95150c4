#!/bin/sh
# VTK, PyVista, and a polyhedron in the form of an L: five unit cubes, as a cell of one mesh.
# One would guess that its volume is 5, that points in the notch are in no cell, that the part with x < 1.5 has the
# volume 3.5, and a slice the area 5.
# What happens: the volume is 7, that of the convex hull, and find_containing_cell and sampling find the cell in the notch, too: 44 % of random points in the
# box of the cell are wrong. A slice has the area 9, and the part with x < 1.5 the volume 4. No warning is given. IsInside of the
# cell, and the surface of the mesh, are right.
# Who meets it: whoever has cells that are not convex, such as those of OpenFOAM and Fluent at snapped corners, of cut cells and of coarsening, and sums
# volumes, probes or seeds particles in VTK, PyVista or ParaView.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pyvista==0.49.1 vtk==9.7.2 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import numpy as np
import pyvista
from vtkmodules.vtkCommonCore import vtkVersion

BASE = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
points = np.array([(x, y, z) for z in (0, 1) for x, y in BASE], float)
faces = [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11]] + [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
stream = [len(faces)] + [number for face in faces for number in (len(face), *face)]
mesh = pyvista.UnstructuredGrid(np.array([len(stream), *stream]), np.array([42], np.uint8), points)
places = np.random.default_rng(1).uniform((0, 0, 0), (3, 3, 1), (1000, 3))
is_in = (places[:, 0] < 1) | (places[:, 1] < 1)
cell = mesh.GetCell(0)
wrong = {
    "find_containing_cell": int(np.sum((mesh.find_containing_cell(places) >= 0) != is_in)),
    "sample": int(np.sum(pyvista.PolyData(places).sample(mesh)["vtkValidPointMask"].astype(bool) != is_in)),
    "IsInside": int(np.sum(np.array([bool(cell.IsInside(place, 1e-6)) for place in places]) != is_in)),
}
sizes = {
    "volume": mesh.volume,
    "volume of the surface": mesh.extract_surface(algorithm="dataset_surface").triangulate().volume,
    "slice": mesh.slice("z", origin=(0, 0, 0.5)).area,
    "x < 1.5": mesh.clip("x", origin=(1.5, 0, 0)).volume,
}
sizes = {name: round(float(size), 3) for name, size in sizes.items()}
print("VTK", vtkVersion.GetVTKVersion(), "PyVista", pyvista.__version__, sizes, "wrong of 1,000 places:", wrong)
assert sizes.pop("volume of the surface") == 5 and wrong.pop("IsInside") == 0
assert sizes == {"volume": 7, "slice": 9, "x < 1.5": 4} and all(390 < count < 490 for count in wrong.values()), "other cells count as they are now"
PY
