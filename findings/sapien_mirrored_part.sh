#!/bin/sh
# SAPIEN (PhysX on the processor, as under ManiSkill) and a part that is the mirror image of another: one convex mesh with the scale -1 along an axis.
# One would guess that the mirrored part has the weight of the first and its centre on the other side: left and right links of robots are often given by
# one file, and there is a scale for each axis in URDF and in SAPIEN's builder, whose help says nothing of its sign. A ball that falls on it lies on it rightly.
# What happens: a wedge of 1000 kg by its density weighs a milligram once it is mirrored by x, by y or by all three, and its centre of mass is 667 m away
# (mirrored twice, it is right). It does not come to rest on flat ground as the first does, but moves on by more than 10 m within three seconds. It is the
# same as a mesh that is not convex, and from a URDF file whose links have no inertial element. No warning is given.
# Who meets it: whoever mirrors hands, legs, shoes or halves of a case, and lets weights be found by density: one half flies off or hangs limply.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile sapien==3.0.3 numpy==2.4.6
"$folder/venv/bin/python" -W ignore - <<'PY'
import pathlib

import numpy as np
import sapien
from sapien import physx

POINTS = [(0, 0, 0), (2, 0, 0), (0, 0, 1), (0, 1, 0), (2, 1, 0), (0, 1, 1)]
TRIANGLES = [(1, 2, 3), (4, 6, 5), (1, 4, 2), (2, 4, 5), (2, 5, 3), (3, 5, 6), (1, 3, 4), (3, 6, 4)]
rows = [f"v {x} {y} {z}" for x, y, z in POINTS] + [f"f {a} {b} {c}" for a, b, c in TRIANGLES]
pathlib.Path("wedge.obj").write_text("\n".join(rows) + "\n")
SCALES = [(1, 1, 1), (-1, 1, 1), (1, -1, 1), (-1, -1, -1), (-1, -1, 1)]


def scene():
    made = sapien.Scene([physx.PhysxCpuSystem()])
    made.set_timestep(1 / 240)
    made.add_ground(0, render=False)
    return made


def drop(scale, convex=True):
    """Weight, centre of mass, and how far sideways a part has moved three seconds after it was let go just above the ground."""
    made = scene()
    builder = made.create_actor_builder()
    (builder.add_convex_collision_from_file if convex else builder.add_nonconvex_collision_from_file)("wedge.obj", scale=scale)
    part = builder.build()
    body = part.find_component_by_type(physx.PhysxRigidDynamicComponent)
    part.set_pose(sapien.Pose((0, 0, 0.01 if scale[2] > 0 else 1.01)))
    if convex:
        for _ in range(720):
            made.step()
    return float(body.mass), [round(float(x), 1) for x in body.cmass_local_pose.p], round(float(np.hypot(*part.pose.p[:2])), 1)


def linked(scale):
    geometry = f'<geometry><mesh filename="wedge.obj" scale="{scale}"/></geometry>'
    links = [f'<link name="{name}"><collision>{geometry}</collision></link>' for name in ("base", "tip")]
    joint = '<joint name="hinge" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="9" velocity="9"/></joint>'
    pathlib.Path("two.urdf").write_text(f'<robot name="two">{"".join(links)}{joint}</robot>')
    made = scene()
    robot = made.create_urdf_loader().load("two.urdf")
    return [float(link.mass) for link in robot.links]


parts = {scale: drop(scale) for scale in SCALES}
others = {scale: drop(scale, convex=False)[0] for scale in SCALES[:2]}
robots = {scale: linked(scale) for scale in ("1 1 1", "1 -1 1")}
print("sapien", sapien.__version__, "weight, centre of mass and way along the ground, by scale:", parts)
print("weights as meshes that are not convex:", others, "of links of URDF:", robots)
for scale in ((1, 1, 1), (-1, -1, 1)):
    assert abs(parts[scale][0] - 1000) < 1 and parts[scale][2] < 0.1
for scale in SCALES[1:4]:
    assert parts[scale][0] < 1e-5, "a mirrored part has its weight now"
    assert max(map(abs, parts[scale][1])) > 100
assert parts[-1, 1, 1][2] > 1, "a mirrored part stays where it is now"
assert abs(others[1, 1, 1] - 1000) < 1 and others[-1, 1, 1] < 1e-5
assert abs(robots["1 1 1"][1] - 1000) < 1 and robots["1 -1 1"][1] < 1e-5
PY
