#!/bin/sh
# MEDCoupling (Salome's library of meshes) and places in a polyhedron in the form of an L: five unit cubes in one cell.
# One would guess that getCellContainingPoint finds the cell for every place in it: the volume, 5, the centre of mass and overlaps with a grid are right.
# What happens: it finds the cell for places in the corner of the L only. In both arms, four fifths of the cell, there is no cell. Each side of the cell is
# taken for a wall of all of space, which holds for convex cells only. No warning is given.
# Who meets it: whoever interpolates at points, or places particles and probes, in meshes of polyhedra, such as code_saturne's, of cut cells or after
# an agglomeration.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile medcoupling==9.15.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata

import medcoupling
import numpy as np

BASE = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
points = np.array([(x, y, z) for z in (0, 1) for x, y in BASE], float)
faces = [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11]] + [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
mesh = medcoupling.MEDCouplingUMesh("L", 3)
mesh.allocateCells(1)
mesh.insertNextCell(medcoupling.NORM_POLYHED, [number for i, face in enumerate(faces) for number in ([-1] if i else []) + face])
mesh.setCoords(medcoupling.DataArrayDouble(points))
mesh.checkConsistency()
steps, heights = medcoupling.DataArrayDouble([0.0, 1.0, 2.0, 3.0]), medcoupling.DataArrayDouble([0.0, 1.0])
grid = medcoupling.MEDCouplingCMesh()
grid.setCoords(steps, steps, heights)
remapper = medcoupling.MEDCouplingRemapper()
remapper.prepare(mesh, grid.buildUnstructured(), "P0P0")
overlaps = [round(sum(row.values()), 6) for row in remapper.getCrudeMatrix()]
volume = mesh.getMeasureField(True).getArray().getValues()[0]
cells = {place: mesh.getCellContainingPoint(list(place), 1e-9) for place in ((0.5, 0.5, 0.5), (1.5, 0.5, 0.5), (2.5, 0.5, 0.5), (0.5, 1.5, 0.5), (0.5, 2.5, 0.5), (2, 2, 0.5))}
print("medcoupling", importlib.metadata.version("medcoupling"), "volume", volume, "overlaps with unit cubes", overlaps, "cells at the middles of its cubes and outside:", cells)
assert abs(volume - 5) < 1e-9 and overlaps == [1, 1, 1, 1, 0, 0, 1, 0, 0]
assert list(cells.values()) == [0, -1, -1, -1, -1, -1], "the arms are found now"
PY
