#!/bin/sh
# Coal (the successor of hpp-fcl) and the normal of the distance between two meshes (DistanceResult.normal).
# One would guess that it is the unit vector between the nearest points, as it is for two shapes, and for a mesh and a shape.
# What happens: distance and nearest points are right, but nothing is written into the normal: it is 0, or some numbers that were in memory, whose length
# is not 1. No error and no warning tells that meshes have none. The difference of the nearest points, divided by the distance, serves.
# Who meets it: whoever makes a push, a gradient or a barrier of distance and normal, as planners and controllers do: with links of meshes it is no direction.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile coal==3.0.3 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import itertools

import coal
import numpy as np

FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def mesh(half):
    """A cube of 12 triangles, counter-clockwise seen from outside."""
    made, points, triangles = coal.BVHModelOBBRSS(), coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    for corner in itertools.product((-half, half), repeat=3):
        points.append(np.array(corner, float))
    for face in FACES:
        triangles.append(coal.Triangle(*face))
    made.beginModel(len(FACES), 8)
    made.addSubModel(points, triangles)
    made.endModel()
    return made


def at(place):
    made = coal.Transform3s()
    made.setTranslation(np.array(place, float))
    return made


pairs = {
    "meshes": (mesh(1), mesh(0.2)),
    "mesh and box": (mesh(1), coal.Box(0.4, 0.4, 0.4)),
    "box and mesh": (coal.Box(2, 2, 2), mesh(0.2)),
    "boxes": (coal.Box(2, 2, 2), coal.Box(0.4, 0.4, 0.4)),
}
right = {}
for name, (a, b) in pairs.items():
    right[name] = 0
    for place in itertools.product((-2, 0, 2), repeat=3):
        if any(place):
            result = coal.DistanceResult()
            distance = coal.distance(a, at((0, 0, 0)), b, at(place), coal.DistanceRequest(), result)
            way = result.getNearestPoint2() - result.getNearestPoint1()
            assert abs(distance - np.linalg.norm(way)) < 1e-6 and abs(distance - 0.8 * np.sqrt(np.count_nonzero(place))) < 1e-6
            right[name] += bool(np.allclose(result.normal, way / distance, atol=1e-3))
print("coal", coal.__version__, "right normals at 26 places:", right)
assert right.pop("meshes") == 0, "meshes have normals now"
assert set(right.values()) == {26}
PY
