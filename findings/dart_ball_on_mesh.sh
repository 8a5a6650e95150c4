#!/bin/sh
# DART (dartpy) and a ball and a box that are dropped on a table: once the table is a box, once a mesh of 12 triangles in the same place.
# One would guess that both come to rest on the table, with each of the four collision detectors that DART has.
# What happens: with the default detector, FCL, the ball falls through the mesh as if it were air, while the box rests on it. The contacts of ball and
# mesh are found, with the right normal, but their depth is negative, and the solver takes them for a gap. No warning is given. DART's own detector, ODE
# and Bullet hold the ball; so does FCL if the table is a box.
# Who meets it: whoever loads terrain, a vessel or a table from a mesh and sets balls on it, such as feet or tips of fingers, without choosing a detector.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile dartpy==6.20.0 numpy==2.4.6
cd "$folder"
venv/bin/python - <<'PY'
import itertools
import os

import dartpy as dart

corners = list(itertools.product((-2, 2), (-2, 2), (-0.5, 0.5)))
sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
triangles = [triangle for a, b, c, d in sides for triangle in ((a, b, c), (a, c, d))]
with open("table.obj", "w") as file:
    file.writelines(f"v {x} {y} {z}\n" for x, y, z in corners)
    file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)


def thing(shape, place):
    inertia = '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>'
    path = os.path.abspath("thing.urdf")
    with open(path, "w") as file:
        file.write(f'<robot name="r"><link name="l"><inertial><mass value="1"/>{inertia}</inertial><collision><geometry>{shape}</geometry></collision></link></robot>')
    skeleton = dart.utils.DartLoader().parseSkeleton(path)
    skeleton.setPositions([0, 0, 0, *place])
    return skeleton


def dropped(detector, table, shape):
    world = dart.simulation.World()
    if detector:
        world.getConstraintSolver().setCollisionDetector(getattr(dart.collision, detector + "CollisionDetector")())
    floor, body = thing(table, (0, 0, -0.5)), thing(shape, (0.23, 0.17, 0.6))
    floor.setName("table")
    floor.setMobile(False)
    world.addSkeleton(floor)
    world.addSkeleton(body)
    for _ in range(1000):
        world.step()
    return round(float(body.getPositions()[5]), 2)


def contacts():
    detector = dart.collision.FCLCollisionDetector()
    skeletons = thing('<mesh filename="table.obj"/>', (0, 0, -0.5)), thing('<sphere radius="0.5"/>', (0.23, 0.17, 0.45))
    group, result, option = detector.createCollisionGroup(), dart.collision.CollisionResult(), dart.collision.CollisionOption()
    for skeleton in skeletons:
        group.addShapeFrame(skeleton.getBodyNode(0).getShapeNode(0))
    option.enableContact, option.maxNumContacts = True, 10
    group.collide(option, result)
    return [round(contact.penetrationDepth, 3) for contact in result.getContacts()]


BOX, MESH, BALL, CUBE = '<box size="4 4 1"/>', '<mesh filename="table.obj"/>', '<sphere radius="0.5"/>', '<box size="1 1 1"/>'
usual = {name: dropped(None, *pair) for name, pair in {"ball on box": (BOX, BALL), "cube on box": (BOX, CUBE), "ball on mesh": (MESH, BALL), "cube on mesh": (MESH, CUBE)}.items()}
others = {name: dropped(name, MESH, BALL) for name in ("DART", "Ode", "Bullet")}
depths = contacts()
print("dartpy", dart.__version__, "heights after a second, 0.5 is at rest:", usual, "the ball on the mesh with other detectors:", others, "depths of FCL for a ball 0.05 deep:", depths)
assert usual.pop("ball on mesh") < -4 and depths and all(-0.06 < depth < -0.04 for depth in depths), "the ball is held now"
assert all(abs(height - 0.5) < 0.02 for height in [*usual.values(), *others.values()])
PY
