#!/bin/sh
# TetGen for Python and the regions of a mesh that PyVista takes over.
# One would guess that `grid` has the numbers of the regions as cell data, because add_region gave them and tetrahedralize returns them.
# What happens: the array that tetrahedralize returns, and `attributes`, have 1 and 2; `grid` has no cell data at all, so a file that it saves is one
# region. No warning is given. grid.cell_data["region"] = tetgen.attributes helps. Numbers of boundary triangles are not in it, either.
# Who meets it: whoever meshes lumen and wall, or bone and tissue, at once and goes on by the grid, in PyVista or by a file of it.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile tetgen==0.8.4 pyvista==0.49.1 vtk==9.7.2 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata

import numpy as np
import tetgen

points = np.array([(x, y, z) for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)], float)  # two cubes with a wall between them
quads = [(4 * i, 4 * i + 1, 4 * i + 3, 4 * i + 2) for i in range(3)]
quads += [(4 * i + a, 4 * i + b, 4 * i + 4 + b, 4 * i + 4 + a) for i in range(2) for a, b in ((0, 1), (1, 3), (3, 2), (2, 0))]
triangles = np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))], np.int32)
mesher = tetgen.TetGen(points, triangles)
mesher.add_region(1, (0.5, 0.5, 0.5))
mesher.add_region(2, (1.5, 0.5, 0.5))
returned = mesher.tetrahedralize(switches="pAQ")
attributes = np.unique(np.asarray(returned[2])).tolist()
data = {name: np.unique(values).tolist() for name, values in mesher.grid.cell_data.items()}
print("tetgen", importlib.metadata.version("tetgen"), "returns regions", attributes, "and its grid has", data)
assert attributes == [1, 2] == np.unique(mesher.attributes).tolist()
assert data == {}, "regions are kept now"
PY
