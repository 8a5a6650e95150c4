#!/bin/sh
# FCL (through python-fcl) and the nearest points of a mesh and a sphere (DistanceResult.nearest_points).
# One would guess that both points are in the coordinates of the world, as they are for a mesh and a box, a capsule, an ellipsoid or a mesh.
# What happens: the point of the sphere is given from the sphere's centre. For a ball of radius 0.2 at (2, 0, 0) it is (-0.2, 0, 0), which is not on the
# ball, and the points are 1.2 apart where the distance is 0.8. The distance and the point of the mesh are right. The order of the two objects changes nothing.
# Who meets it: whoever takes balls for the joints of a robot or the tip of a tool, and makes a direction or a witness line of the two points.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile python-fcl==0.7.0.11 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata
import itertools

import fcl
import numpy as np

POINTS = np.array(list(itertools.product((-1, 1), repeat=3)), float)
FACES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])
mesh = fcl.BVHModel()
mesh.beginModel(len(POINTS), len(FACES))
mesh.addSubModel(POINTS, FACES)
mesh.endModel()
cube = fcl.CollisionObject(mesh, fcl.Transform(np.zeros(3)))


def points(shape, place):
    """The distance, and how far the two points are apart."""
    result = fcl.DistanceResult()
    distance = fcl.distance(cube, fcl.CollisionObject(shape, fcl.Transform(np.array(place, float))), fcl.DistanceRequest(enable_nearest_points=True), result)
    first, second = result.nearest_points
    return round(distance, 3), round(float(np.linalg.norm(second - first)), 3), np.round(second, 3).tolist()


shapes = {"sphere": fcl.Sphere(0.2), "ellipsoid": fcl.Ellipsoid(0.2, 0.2, 0.2), "capsule": fcl.Capsule(0.2, 0.1), "box": fcl.Box(0.4, 0.4, 0.4)}
found = {name: [points(shape, place) for place in ((2, 0, 0), (0, 2, 0), (3, 3, 3))] for name, shape in shapes.items()}
print("python-fcl", importlib.metadata.version("python-fcl"), "distance, how far the points are apart, the second point:", found)
sphere = found.pop("sphere")
assert all(abs(distance - apart) < 0.01 for rows in found.values() for distance, apart, _ in rows)
assert sphere[0] == (0.8, 1.2, [-0.2, 0, 0]) and all(abs(distance - apart) > 0.3 for distance, apart, _ in sphere), "the point is one of the world now"
PY
