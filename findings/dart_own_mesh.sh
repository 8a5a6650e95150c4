#!/bin/sh
# DART's own collision detector (DARTCollisionDetector of dartpy 6.20) and a cube of triangles that stands on a table.
# One would guess that the cube rests. This detector takes meshes, holds balls, boxes and cylinders on them, and holds a cube that is a box shape.
# What happens: a cube whose sides are divided into 4 x 4 squares sinks into the table and turns over in it: after a second it lies on its side, with
# its centre level with the table's top. A pair with a mesh has four contacts, whatever maxNumContacts says, and all four are at one edge or corner of
# the base, so the rest has no support. No warning is given. A cube with two triangles a side rests. With FCL, ODE and Bullet both rest.
# Who meets it: whoever has fine meshes and takes this detector because, unlike the default FCL, it holds balls on meshes.
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


def write_cube(n):
    points, triangles = [], []

    def number(axis, side, i, j):
        point = [0, 0, 0]
        point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = side, i / n - 0.5, j / n - 0.5
        if point not in points:
            points.append(point)
        return points.index(point) + 1

    for axis, side, i, j in itertools.product(range(3), (-0.5, 0.5), range(n), range(n)):
        a, b, c, d = [number(axis, side, *corner) for corner in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
        triangles += [(a, b, c), (a, c, d)] if side > 0 else [(a, c, b), (a, d, c)]
    with open("cube.obj", "w") as file:
        file.writelines(f"v {x} {y} {z}\n" for x, y, z in points)
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in triangles)


def thing(shape, height):
    inertia = '<inertia ixx="0.1667" iyy="0.1667" izz="0.1667" ixy="0" ixz="0" iyz="0"/>'
    path = os.path.abspath("thing.urdf")
    with open(path, "w") as file:
        file.write(f'<robot name="r"><link name="l"><inertial><mass value="1"/>{inertia}</inertial><collision><geometry>{shape}</geometry></collision></link></robot>')
    skeleton = dart.utils.DartLoader().parseSkeleton(path)
    skeleton.setPositions([0, 0, 0, 0.23, 0.17, height])
    return skeleton


def stands(name, shape):
    detector = getattr(dart.collision, name + "CollisionDetector")()
    world, group = dart.simulation.World(), detector.createCollisionGroup()
    world.getConstraintSolver().setCollisionDetector(detector)
    table, body = thing('<box size="4 4 1"/>', -0.5), thing(shape, 0.49)
    table.setName("table")
    table.setMobile(False)
    for skeleton in (table, body):
        world.addSkeleton(skeleton)
        group.addShapeFrame(skeleton.getBodyNode(0).getShapeNode(0))
    result, option = dart.collision.CollisionResult(), dart.collision.CollisionOption()
    option.enableContact, option.maxNumContacts = True, 100
    group.collide(option, result)
    places = [contact.point - (0.23, 0.17, 0) for contact in result.getContacts()]
    reach = [round(float(min(place[axis] for place in places)), 2) for axis in (0, 1)]
    for _ in range(1000):
        world.step()
    turn = body.getBodyNode(0).getWorldTransform().matrix()
    return round(float(turn[2, 3]), 2), round(float(turn[2, 2]), 2), len(places), reach


CUBE, BOX = '<mesh filename="cube.obj"/>', '<box size="1 1 1"/>'
write_cube(1)
coarse, box = stands("DART", CUBE), stands("DART", BOX)
write_cube(4)
fine, others = stands("DART", CUBE), {name: stands(name, CUBE)[:2] for name in ("FCL", "Ode", "Bullet")}
print("dartpy", dart.__version__, "height, upright (1 is yes), contacts and their least x and y (the base has -0.5 to 0.5) of a fine cube:", fine, "of a coarse one:", coarse, "of a box:", box)
print("the fine one with other detectors:", others)
assert all(height > 0.48 and up > 0.99 for height, up, *_ in (box, coarse, *others.values()))
assert abs(fine[0]) < 0.1 and abs(fine[1]) < 0.5 and fine[2] == 4 and max(fine[3]) > 0.2, "the cube rests now"
PY
