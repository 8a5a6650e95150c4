#!/bin/sh
# PyBullet and a bar that lies on a table with its middle beyond the edge, as a box and as a mesh of triangles (GEOM_FORCE_CONCAVE_TRIMESH).
# One would guess that both tip over and fall.
# What happens: the box falls. The mesh lies there with its middle in the air, for its moments of inertia are 0, which stands for a body that does not
# turn. createMultiBody takes the mass, and gives no warning. The same points without indices, as a convex hull, have moments and fall.
# Who meets it: whoever needs a body with a hollow (a cup, a ring, a hook) that moves: it can be pushed, but never turns.
# changeDynamics(localInertiaDiagonal=...) helps.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pybullet==3.2.7 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata
import itertools

import pybullet

HALF = (1, 0.1, 0.1)
POINTS = list(itertools.product(*((-half, half) for half in HALF)))
TRIANGLES = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3]


def fall(kind, inertia=None, **shape):
    """The moments of inertia of a bar, and its height after a second."""
    pybullet.resetSimulation()
    pybullet.setGravity(0, 0, -10)
    pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=(1, 1, 1)), basePosition=(0, 0, -1))
    bar = pybullet.createMultiBody(1, pybullet.createCollisionShape(kind, **shape), basePosition=(1.5, 0, 0.1))
    if inertia:
        pybullet.changeDynamics(bar, -1, localInertiaDiagonal=inertia)
    moments = pybullet.getDynamicsInfo(bar, -1)[2]
    for _ in range(240):
        pybullet.stepSimulation()
    return [round(moment, 3) for moment in moments], round(pybullet.getBasePositionAndOrientation(bar)[0][2], 1)


pybullet.connect(pybullet.DIRECT)
concave = {"vertices": POINTS, "indices": TRIANGLES, "flags": pybullet.GEOM_FORCE_CONCAVE_TRIMESH}
found = {
    "box": fall(pybullet.GEOM_BOX, halfExtents=HALF),
    "convex hull": fall(pybullet.GEOM_MESH, vertices=POINTS),
    "triangles": fall(pybullet.GEOM_MESH, **concave),
    "triangles with moments": fall(pybullet.GEOM_MESH, (0.007, 0.337, 0.337), **concave),
}
print("pybullet", importlib.metadata.version("pybullet"), "moments, and height after a second:", found)
assert found.pop("triangles") == ([0, 0, 0], 0.1), "the mesh falls now"
assert all(min(moments) > 0 and height < -1 for moments, height in found.values())
PY
