#!/bin/sh
# VTK, PyVista, and the wedge in which a place is: a unit cube of two wedges that meet in a plane from edge to edge.
# One would guess that find_containing_cell gives for each place the wedge that holds it, and for a place beside a single wedge none, as with tetrahedra.
# What happens: for 40 % of the places in the cube it names the other wedge, and for a wedge alone it finds places within the cube but beyond the sloped side, which are
# outside of all cells. sample has the cell data of the wrong wedge at half of the places. Only the bounds of the parameters r, s and t are
# tested, not r + s, when a locator asks. EvaluatePosition, which is asked for the nearest point, too, is right. So it is with linear wedges
# and those of 18 nodes; for those of 15, find_containing_cell is right and sample is not. No warning is given.
# Who meets it: whoever probes, interpolates, or places particles and seeds in boundary layers or extruded meshes, whose cells are wedges.
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

PLACES = np.random.default_rng(0).random((4000, 3))
PLACES = PLACES[np.abs(PLACES[:, 0] + PLACES[:, 1] - 1) > 0.01]
SECOND = PLACES[:, 0] + PLACES[:, 1] > 1
KINDS = {"6 nodes": vtk.VTK_WEDGE, "15 nodes": vtk.VTK_QUADRATIC_WEDGE, "18 nodes": vtk.VTK_BIQUADRATIC_QUADRATIC_WEDGE}


def grid(kind, both):
    cell = vtk.vtkGenericCell.InstantiateCell(kind)
    count = cell.GetNumberOfPoints()
    first = np.array([cell.GetParametricCoords()[i] for i in range(3 * count)]).reshape(-1, 3)
    points = np.vstack([first, first * [-1, -1, 1] + [1, 1, 0]]) if both else first
    cells = np.arange(len(points)).reshape(-1, count)
    made = pyvista.UnstructuredGrid(np.insert(cells, 0, count, axis=1).ravel(), np.full(len(cells), kind, np.uint8), points)
    made.cell_data["wedge"] = np.arange(float(len(cells)))
    return made


def right(made, place):
    nearest, part, parameters, away, weights = [0] * 3, vtk.reference(0), [0] * 3, vtk.reference(0.0), [0] * 6
    return made.GetCell(0).EvaluatePosition(place, nearest, part, parameters, away, weights) == 1


named, sampled, outside = {}, {}, {}
for name, kind in KINDS.items():
    two = grid(kind, True)
    assert np.allclose(two.compute_cell_sizes()["Volume"], 0.5)
    named[name] = round(float(np.mean(two.find_containing_cell(PLACES) != SECOND)), 2)
    sampled[name] = round(float(np.mean(pyvista.PolyData(PLACES).sample(two)["wedge"] != SECOND)), 2)
    outside[name] = round(float(np.mean(grid(kind, False).find_containing_cell(PLACES[SECOND]) >= 0)), 2)
alone = grid(vtk.VTK_WEDGE, False)
agree = all(right(alone, place) != beyond for place, beyond in zip(PLACES[:500], SECOND[:500]))
print("VTK", vtk.vtkVersion.GetVTKVersion(), "PyVista", pyvista.__version__, "share of places that are in the other wedge by find_containing_cell:", named, "by sample:", sampled)
print("share of those outside of a single wedge that are found in it:", outside, "EvaluatePosition is right:", agree)
assert named["6 nodes"] > 0.3 and named["18 nodes"] > 0.3 and outside["6 nodes"] > 0.3, "linear wedges are found now"
assert all(share > 0.3 for share in sampled.values()) and named["15 nodes"] < 0.01 and agree
PY
