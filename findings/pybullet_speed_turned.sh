#!/bin/sh
# PyBullet and a ball in empty space that is given the velocity (1000, 300, 0).
# One would guess that the ball keeps this velocity, as bodies in space do, or is slowed down on its way.
# What happens: resetBaseVelocity takes it, and getBaseVelocity gives it back. From the first step on the ball has the velocity (100, 100, 0): each
# component is cut at 100, so the ball flies at 45 degrees in place of 17. Angular velocities are cut so, too. No warning is given.
# changeDynamics(maxJointVelocity=...) raises the limit, which its name does not tell of a body without joints. Bodies made with
# useMaximalCoordinates=True keep both velocities.
# Who meets it: whoever simulates in millimetres (100 mm/s), throws fast, or spins a tool, and wonders where the thing went.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pybullet==3.2.7 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata

import pybullet


def velocities(maximal=False, limit=None):
    """Linear and angular velocity of a ball before and after a step."""
    pybullet.resetSimulation()
    ball = pybullet.createMultiBody(1, pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.1), useMaximalCoordinates=maximal)
    pybullet.changeDynamics(ball, -1, linearDamping=0, angularDamping=0, **({} if limit is None else {"maxJointVelocity": limit}))
    pybullet.resetBaseVelocity(ball, (1000, 300, 0), (300, 0, 50))
    before = pybullet.getBaseVelocity(ball)
    pybullet.stepSimulation()
    return before, tuple(tuple(round(number) for number in row) for row in pybullet.getBaseVelocity(ball))


pybullet.connect(pybullet.DIRECT)
found = {"default": velocities(), "maxJointVelocity=1e4": velocities(limit=1e4), "maximal coordinates": velocities(True)}
print("pybullet", importlib.metadata.version("pybullet"), "velocities before and after a step:", found)
given = (1000, 300, 0), (300, 0, 50)
assert all(before == given for before, _ in found.values())
assert found["maxJointVelocity=1e4"][1] == found["maximal coordinates"][1] == given
assert found["default"][1] == ((100, 100, 0), (100, 0, 50)), "the velocity is kept now"
PY
