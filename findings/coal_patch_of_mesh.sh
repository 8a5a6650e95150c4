#!/bin/sh
# Coal (the successor of hpp-fcl) and the contact patch of a box that stands on another one (computeContactPatch).
# One would guess that the patch is the square where they touch, whether a box is a shape or a mesh of triangles.
# What happens: of two shapes it has four points. As soon as one of them is a mesh, each contact of a triangle has a patch of one point, so what stands
# there has no support polygon. No error or warning tells. buildConvexRepresentation of the mesh gives four points, if it is convex.
# Who meets it: whoever asks whether a foot, a gripper or a part on a table stands, and has the links as meshes, as robot descriptions do.
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
    """A cube of 12 triangles that share 8 points, counter-clockwise seen from outside."""
    made, points, triangles = coal.BVHModelOBBRSS(), coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    for corner in itertools.product((-half, half), repeat=3):
        points.append(np.array(corner, float))
    for face in FACES:
        triangles.append(coal.Triangle(*face))
    made.beginModel(len(FACES), 8)
    made.addSubModel(points, triangles)
    made.endModel()
    return made


def patches(below, above):
    """The number of points of each patch."""
    up, request, result = coal.Transform3s(), coal.CollisionRequest(), coal.CollisionResult()
    up.setTranslation(np.array((0.1, 0.1, 1.49)))
    request.num_max_contacts = 100
    coal.collide(below, coal.Transform3s(), above, up, request, result)
    wanted, made = coal.ContactPatchRequest(), coal.ContactPatchResult()
    wanted.max_num_patch = 100
    coal.computeContactPatch(below, coal.Transform3s(), above, up, result, wanted, made)
    return [made.getContactPatch(i).size() for i in range(made.numContactPatches())]


hull = mesh(1)
hull.buildConvexRepresentation(False)
table, box = coal.Box(2, 2, 2), coal.Box(1, 1, 1)
found = {
    "shapes": patches(table, box), "hull below": patches(hull.convex, box),
    "mesh below": patches(mesh(1), box), "mesh above": patches(table, mesh(0.5)), "meshes": patches(mesh(1), mesh(0.5)),
}
print("coal", coal.__version__, "points of each patch:", found)
assert found.pop("shapes") == found.pop("hull below") == [4]
assert all(sizes and set(sizes) == {1} for sizes in found.values()), "meshes have patches now"
PY
