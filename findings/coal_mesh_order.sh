#!/bin/sh
# Coal (the successor of hpp-fcl) and two boxes of triangles that overlap by 0.01.
# One would guess that swapping the two objects turns the normal round and leaves the depth, as it does for shapes.
# What happens: with the large box first, all contacts have the normal (1, 0, 0) and the depth 0.01. With the small one first, all have a normal along
# y or z and a depth of 1.4 or 1.6, which is how far the triangles of the side would have to go. If one of the boxes is a shape, the order does not matter.
# Who meets it: whoever pushes meshes apart by normal and depth, as planners and simulators on Pinocchio do: half of the pairs fly sideways.
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
    """A cube of 12 triangles with 8 points, counter-clockwise seen from outside."""
    made, points, triangles = coal.BVHModelOBBRSS(), coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    for corner in itertools.product((-half, half), repeat=3):
        points.append(np.array(corner, float))
    for face in FACES:
        triangles.append(coal.Triangle(*face))
    made.beginModel(len(FACES), 8)
    made.addSubModel(points, triangles)
    made.endModel()
    return made


def at(*place):
    made = coal.Transform3s()
    made.setTranslation(np.array(place, float))
    return made


def contacts(a, place_a, b, place_b):
    """Axes and depths of all contacts."""
    request, result = coal.CollisionRequest(), coal.CollisionResult()
    request.num_max_contacts = 1000
    coal.collide(a, place_a, b, place_b, request, result)
    return {(int(np.argmax(np.abs(c.normal))), round(-c.penetration_depth, 6)) for c in result.getContacts()}


large, small = (mesh(1), at(0, 0, 0)), (mesh(0.5), at(1.49, 0.1, 0.1))
box = coal.Box(1, 1, 1), small[1]
print("coal", coal.__version__, "large first", contacts(*large, *small), "small first", contacts(*small, *large), "shape", contacts(*large, *box), contacts(*box, *large))
assert contacts(*large, *small) == contacts(*large, *box) == contacts(*box, *large) == {(0, 0.01)}
assert contacts(*small, *large) == {(1, 1.4), (1, 1.6), (2, 1.4), (2, 1.6)}, "the order does not matter now"
PY
