#!/bin/sh
# DART (dartpy) and a capsule and an ellipsoid that lie or stand on a table, which is a box, with each of the four collision detectors.
# One would guess that a capsule of radius 0.25 and height 1 rests with its centre at 0.5, because DART reads capsules from MJCF and SDF files, and
# that a detector which has no capsules leaves them out or raises an error.
# What happens: with the default detector, FCL, the capsule sinks into the table until its centre is at 0.05: it is replaced by a ball of radius 0.1,
# whatever its size. With ODE an ellipsoid is replaced by a ball of radius 0.01, and so is a cone. An error is printed on stderr and nothing is raised, so the
# simulation goes on. With Bullet, which prints nothing, an ellipsoid of half a metre rests 0.01 too high. DART's own detector holds all three.
# Who meets it: whoever simulates humanoids or arms, whose links are capsules in most MJCF files, without choosing a detector.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile dartpy==6.20.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import dartpy as dart

UP = [0, 0, 0, 0.03, 0.02, 0.55]


def body(shape, maker, place):
    skeleton = dart.dynamics.Skeleton()
    joint, node = getattr(skeleton, maker)()
    part = node.createShapeNode(shape)
    part.createCollisionAspect()
    part.createDynamicsAspect()
    if place:
        skeleton.setPositions(place)
    return skeleton


def rest(detector, shape):
    world = dart.simulation.World()
    if detector:
        world.getConstraintSolver().setCollisionDetector(getattr(dart.collision, detector + "CollisionDetector")())
    table = body(dart.dynamics.BoxShape([8, 8, 1]), "createFreeJointAndBodyNodePair", [0, 0, 0, 0, 0, -0.5])
    table.setMobile(False)
    table.setName("table")
    thing = body(shape, "createFreeJointAndBodyNodePair", UP)
    for skeleton in (table, thing):
        world.addSkeleton(skeleton)
    for _ in range(1000):
        world.step()
    return round(float(thing.getPositions()[5]), 3)


shapes = {
    "capsule": lambda: dart.dynamics.CapsuleShape(0.25, 0.5),
    "ellipsoid": lambda: dart.dynamics.EllipsoidShape([1.4, 1.4, 1.0]),
    "cylinder": lambda: dart.dynamics.CylinderShape(0.5, 1.0),
}
heights = {name: [rest(name, make()) for make in shapes.values()] for name in (None, "FCL", "DART", "Bullet", "Ode")}
print("dartpy", dart.__version__, "heights of", list(shapes), "that are at rest at 0.5, by detector:", heights)
near = lambda height, where: abs(height - where) < 0.004
for name in (None, "FCL"):
    assert near(heights[name][0], 0.05), "the capsule is one now"
assert near(heights["Ode"][1], 0.008), "the ellipsoid is one now"
assert near(heights["Bullet"][1], 0.51)
assert all(near(height, 0.5) for height in heights["DART"])
assert near(heights["Ode"][0], 0.5) and near(heights[None][1], 0.5) and all(near(values[2], 0.5) for values in heights.values())
PY
