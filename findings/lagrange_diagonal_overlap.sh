#!/bin/sh
# Lagrange (adobe-lagrange) and the pairs of triangles that cross in one mesh of two cubes (bvh.compute_intersecting_pairs).
# One would guess that two cubes which overlap have crossing triangles wherever they are, for the documentation says that exact predicates decide.
# What happens: cubes that are shifted by the same amount along all three axes, and overlap by an eighth or by half, have none: the list is empty. Shifted by a
# ten-thousandth less along one axis, they have ten. Where two triangles cross, and the crossing begins and ends where edges meet edges, it is taken
# for a touch of borders; so two triangles alone can cross in half of their width and are no pair. No error is raised.
# Who meets it: whoever checks assemblies, repaired or generated meshes for crossings: round numbers, symmetry and equal diagonals are where it says "none".
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile adobe-lagrange==6.49.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata
import itertools

import lagrange
import numpy as np

CORNERS = np.array(list(itertools.product((-0.5, 0.5), repeat=3)))
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
CUBE = np.array([corners for a, b, c, d in SIDES for corners in ((a, b, c), (a, c, d))], np.uint32)
ONE = np.array([[0, 1, 2]], np.uint32)


def pairs(first, second, triangles):
    mesh = lagrange.SurfaceMesh()
    mesh.add_vertices(np.vstack([first, second]).astype(float))
    mesh.add_triangles(np.vstack([triangles, triangles + len(first)]).astype(np.uint32))
    return len(lagrange.bvh.compute_intersecting_pairs(mesh))


shifts = [(0.5, 0.5, 0.5), (0.2, 0.2, 0.2), (0.5, -0.5, 0.5), (0.5, 0.5, 0.4999), (0.5, 0.4, 0.5), (0.3, 0.3, 0.2)]
cubes = {shift: pairs(CORNERS, CORNERS + shift, CUBE) for shift in shifts}
flat, crossing = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0.25, -0.5, 1), (-0.25, -1.5, -1), (0.75, 0.5, -1)]
alone = [pairs(flat, crossing, ONE), pairs(flat, [(0.25, -0.49, 1), *crossing[1:]], ONE)]
print("lagrange", importlib.metadata.version("adobe-lagrange"), "pairs of crossing triangles in two cubes, by shift:", cubes, "of two triangles that cross between edges, and a little beside:", alone)
for shift, count in cubes.items():
    assert (count == 0) == (len({abs(part) for part in shift}) == 1), "overlaps along the diagonal are found now"
assert alone == [0, 1]
PY
