#!/bin/sh
# FCL (through python-fcl) and two boxes that overlap by 0.1, each of them as a shape and as a mesh of triangles, and a ball in place of the small one.
# One would guess that all pairs have the normal (1, 0, 0), which points from the first to the second, and the depth 0.1.
# What happens: two shapes and two meshes have these. A shape against a mesh has the normal (-1, 0, 0). A mesh against a box has two contacts whose normals
# are (0, 0.71, -0.71) and the opposite, within the side that is touched, and the depth 0.28, which is how far it would have to go from
# single triangles. A mesh against a sphere has the depth -0.1. Nothing in the result tells which of these it is.
# Who meets it: whoever pushes things apart by normal and depth, and has some links as meshes and some as boxes and balls.
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


def mesh(half):
    made = fcl.BVHModel()
    made.beginModel(len(POINTS), len(FACES))
    made.addSubModel(half * POINTS, FACES)
    made.endModel()
    return made


def contacts(a, b):
    """Normals and depths of a large thing and of a small one at 1.1 from its middle."""
    result = fcl.CollisionResult()
    objects = [fcl.CollisionObject(shape, fcl.Transform(np.array((x, 0, 0.0)))) for shape, x in ((a, 0), (b, 1.1))]
    fcl.collide(*objects, fcl.CollisionRequest(enable_contact=True, num_max_contacts=100), result)
    return sorted({(*(np.round(one.normal, 2) + 0.0).tolist(), round(float(one.penetration_depth), 2)) for one in result.contacts})


large, small, ball = fcl.Box(2, 2, 2), fcl.Box(0.4, 0.4, 0.4), fcl.Sphere(0.2)
found = {
    "shapes": contacts(large, small), "ball on a shape": contacts(large, ball), "meshes": contacts(mesh(1), mesh(0.2)),
    "shape and mesh": contacts(large, mesh(0.2)), "mesh and shape": contacts(mesh(1), small), "mesh and ball": contacts(mesh(1), ball),
}
print("python-fcl", importlib.metadata.version("python-fcl"), "normals and depths:", found)
assert all(found.pop(name) == [(1, 0, 0, 0.1)] for name in ("shapes", "ball on a shape", "meshes"))
assert found.pop("shape and mesh") == [(-1, 0, 0, 0.1)] and found.pop("mesh and ball") == [(1, 0, 0, -0.1)], "the signs are alike now"
assert found == {"mesh and shape": [(0, -0.71, 0.71, 0.28), (0, 0.71, -0.71, 0.28)]}, "the normal is that of the side now"
PY
