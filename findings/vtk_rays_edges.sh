#!/bin/sh
# VTK, PyVista, and rays that meet a surface exactly at an edge or a corner of its triangles.
# One would guess that a ray down on a floor of triangles hits it wherever it comes down, and that a ray out of a ball meets its wall once.
# What happens: vtkOBBTree, asked for all points on a line, finds none on any ray through a corner, an edge or a diagonal of the floor; no tolerance helps.
# Beside the edges, and asked for the first hit only, it finds all. PyVista has had another locator in ray_trace since 0.49, which finds the floor,
# but it meets the wall of a ball twice on every other ray through the middle of an edge, though it drops double points.
# Who meets it: whoever casts a grid of rays on a mesh with round coordinates (voxels, terrain, a box), or counts hits to tell inside from outside.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pyvista==0.49.1 vtk==9.7.2 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkVersion
from vtkmodules.vtkFiltersGeneral import vtkOBBTree

floor = pv.Plane(i_size=8, j_size=8, i_resolution=8, j_resolution=8).triangulate()
tree = vtkOBBTree()
tree.SetDataSet(floor)
tree.BuildLocator()
inner = [(x, y) for x in range(-3, 4) for y in range(-3, 4)]


def hits(shift):
    """How many of the rays down on the inner points, moved by a shift, find the floor: by the tree, and by ray_trace."""
    by_tree, by_trace = 0, 0
    for x, y in np.array(inner) + shift:
        points = vtkPoints()
        tree.IntersectWithLine((x, y, 1), (x, y, -1), points, vtkIdList())
        by_tree += points.GetNumberOfPoints() == 1
        by_trace += len(floor.ray_trace((x, y, 1), (x, y, -1))[0]) == 1
    return by_tree, by_trace


found = {name: hits(shift) for name, shift in (("corners", (0, 0)), ("edges", (0.5, 0)), ("diagonals", (0.5, 0.5)), ("between", (0.3, 0.1)))}
ball = pv.Icosphere(nsub=2)
triangles = ball.faces.reshape(-1, 4)[:, 1:]
sides = np.unique(np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1), axis=0)
middles = np.asarray(ball.points, float)[sides].mean(axis=1)
twice = sum(len(ball.ray_trace((0, 0, 0), 2 * middle)[0]) > 1 for middle in middles)
print("VTK", vtkVersion.GetVTKVersion(), "PyVista", pv.__version__, "hits of 49 by the tree and by ray_trace", found, "; double hits", twice, "of", len(middles))
assert found["between"] == (49, 49)
assert all(found[name] == (0, 49) for name in ("corners", "edges", "diagonals")), "the tree finds them now"
assert twice > len(middles) / 4, "a wall is met once now"
PY
