#!/bin/sh
# Coal (the successor of hpp-fcl) and the convex representation of a cube whose triangles have points of their own, as STL files have them.
# One would guess that buildConvexRepresentation gives the cube, because the triangles form one and the mesh itself finds balls on all six sides.
# What happens: a ball that overlaps a side by half its radius is found on one side of six. Support points are sought from neighbour to neighbour,
# and a triangle with points of its own has no neighbours. No error is given. With points that triangles share, or with buildConvexHull, all
# six are found. The loader of coal merges points; addTriangle does not.
# Who meets it: whoever fills a BVHModel triangle by triangle, or from arrays of STL, and wants it fast: most touches are missed.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile coal==3.0.3 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import itertools

import coal
import numpy as np

POINTS = [np.array(corner, float) for corner in itertools.product((-1, 1), repeat=3)]
FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
SIDES = [sign * 1.05 * axis for axis in np.eye(3) for sign in (1, -1)]


def cube(is_shared):
    made, points, triangles = coal.BVHModelOBBRSS(), coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    made.beginModel(len(FACES), 8)
    if is_shared:
        for point in POINTS:
            points.append(point)
        for face in FACES:
            triangles.append(coal.Triangle(*face))
        made.addSubModel(points, triangles)
    else:
        for face in FACES:
            made.addTriangle(*(POINTS[i] for i in face))
    made.endModel()
    return made


def touched(shape):
    """How many of six balls of radius 0.1, which overlap a side each by 0.05, are found."""
    found = 0
    for place in SIDES:
        there = coal.Transform3s()
        there.setTranslation(place)
        result = coal.CollisionResult()
        coal.collide(shape, coal.Transform3s(), coal.Sphere(0.1), there, coal.CollisionRequest(), result)
        found += result.isCollision()
    return found


def convex(mesh):
    mesh.buildConvexRepresentation(False)
    return mesh.convex


def hull(mesh):
    mesh.buildConvexHull(True, "Qt")
    return mesh.convex


apart, shared = cube(False), cube(True)
found = {"mesh": touched(apart), "representation": touched(convex(apart)), "hull": touched(hull(cube(False))), "shared points": touched(convex(shared))}
print("coal", coal.__version__, "balls found of six:", found)
assert found["mesh"] == found["hull"] == found["shared points"] == 6
assert found["representation"] < 6, "no touch is missed now"
PY
