#!/bin/sh
# meshio and quadratic tetrahedra of PERMAS files (.dato, .post), as Netgen writes them, too.
# One would guess that meshio reads back what it has written, and that corners are corners.
# What happens: in these files the middle of a side stands between its two corners. meshio writes TET10 so, as Netgen does, but takes the ten nodes
# as they stand when it reads: two of the corners are middles of sides, and a straight tetrahedron has volume 0. No warning is given.
# Who meets it: whoever converts a mesh of second order from PERMAS, or sends one through this format.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile meshio==5.3.5 netgen-mesher==6.2.2608 numpy==2.4.6
cd "$folder"
venv/bin/python - <<'PY'
import importlib.metadata
import itertools
import re

import meshio
import numpy as np
from netgen.csg import unit_cube

CORNERS = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
SIDES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def volume(points, row):
    a, b, c, d = (points[i] for i in row[:4])
    return float(np.cross(b - a, c - a) @ (d - a)) / 6


def places_of_middles(points, row):
    """Which of the ten nodes lie in the middle of two others."""
    return [k for k in range(10) if any(np.allclose(points[row[k]], (points[row[i]] + points[row[j]]) / 2) for i, j in itertools.combinations(range(10), 2) if k not in (i, j))]


points = np.array([*CORNERS, *((CORNERS[a] + CORNERS[b]) / 2 for a, b in SIDES)])
mesh = meshio.Mesh(points, [("tetra10", [list(range(10))])])
meshio.write("one.dato", mesh)
back = meshio.read("one.dato")
print("meshio", meshio.__version__, "wrote", volume(points, range(10)), "and reads", volume(back.points, back.cells_dict["tetra10"][0]))
written = places_of_middles(back.points, back.cells_dict["tetra10"][0])

cube = unit_cube.GenerateMesh(maxh=2)
cube.SecondOrder()
cube.Export("cube.dato", "Permas Format")
text = open("cube.dato").read()
row = [int(word) for word in re.search(r"TET10.*\n((?:.*\n&)*.*)", text).group(1).replace("&", " ").split()][1:]
nodes = [line.split() for line in text.partition("$COOR")[2].splitlines()[1:]]
at = {int(line[0]): np.array(line[1:4], float) for line in nodes if len(line) == 4 and line[0].isdigit()}
own = places_of_middles(at, row)
print("netgen", importlib.metadata.version("netgen-mesher"), "has middles at", own, "and meshio at", written, "of the ten")
assert own == written == [1, 3, 5, 6, 7, 8], "the order of a file is another one"
assert volume(back.points, back.cells_dict["tetra10"][0]) < 0.1 * volume(points, range(10)), "the order is undone now"
PY
