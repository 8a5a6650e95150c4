#!/bin/sh
# Drake and a hollow mesh: a tube with a thick wall, and a ball inside.
# One would guess that a ball inside of a tube stays there.
# What happens: with point contact a Mesh is its convex hull, so the ball is thrown out of the tube. With hydroelastic contact, a rigid tube and a
# compliant ball, the same mesh is hollow: the ball falls to the wall and lies there.
# Who meets it: everybody who takes a vessel or a pipe from a surface file. Releases after 1.51.1 ask for a Python newer than 3.11.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile drake==1.51.1
cd "$folder"
venv/bin/python - <<'PY'
import importlib.metadata
import time

import numpy as np
from pydrake import all as drake

print("drake", importlib.metadata.version("drake"))
around = np.arange(24) * np.pi / 12
ring = np.stack([np.cos(around), np.sin(around)], axis=1)
corners, faces = [], []
for radius, z in ((0.5, -1), (0.5, 1), (1.0, 1), (1.0, -1)):  # round the section of the wall
    corners.append(np.column_stack([radius * ring, np.full(24, float(z))]))
for k in range(4):
    for i in range(24):
        a, b, c, d = 24 * k + i, 24 * k + (i + 1) % 24, 24 * ((k + 1) % 4) + (i + 1) % 24, 24 * ((k + 1) % 4) + i
        faces += [(a, c, b), (a, d, c)]
points, faces = np.concatenate(corners), np.array(faces)
if np.einsum("ij,ij->", points[faces[:, 0]], np.cross(points[faces[:, 1]], points[faces[:, 2]])) < 0:
    faces = faces[:, ::-1]
with open("tube.obj", "w") as file:
    file.writelines("v %r %r %r\n" % tuple(map(float, point)) for point in points)
    file.writelines("f %d %d %d\n" % tuple(face + 1) for face in faces)


def distance(hydroelastic):
    """How far from the axis the ball is after two seconds, 1,000 steps."""
    builder = drake.DiagramBuilder()
    plant, _ = drake.AddMultibodyPlantSceneGraph(builder, 0.002)
    plant.set_contact_model(drake.ContactModel.kHydroelasticWithFallback if hydroelastic else drake.ContactModel.kPoint)
    plant.mutable_gravity_field().set_gravity_vector([-9.81, 0, 0])
    tube, ball = drake.ProximityProperties(), drake.ProximityProperties()
    if hydroelastic:
        drake.AddRigidHydroelasticProperties(1.0, tube)
        drake.AddCompliantHydroelasticProperties(0.05, 1e7, ball)
    for material in (tube, ball):
        drake.AddContactMaterial(dissipation=1.0, point_stiffness=1e5, friction=drake.CoulombFriction(0.5, 0.5), properties=material)
    body = plant.AddRigidBody("ball", drake.SpatialInertia(1.0, np.zeros(3), drake.UnitInertia.SolidSphere(0.1)))
    plant.RegisterCollisionGeometry(plant.world_body(), drake.RigidTransform(), drake.Mesh("tube.obj", 1.0), "tube", tube)
    plant.RegisterCollisionGeometry(body, drake.RigidTransform(), drake.Sphere(0.1), "ball", ball)
    plant.Finalize()
    diagram = builder.Build()
    simulator = drake.Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(context, body, drake.RigidTransform())
    begin = time.process_time()
    simulator.AdvanceTo(2.0)
    at = plant.EvalBodyPoseInWorld(context, body).translation()
    return float(np.hypot(at[0], at[1])), 1e3 * (time.process_time() - begin) / 1000


point, hydroelastic = distance(False), distance(True)
print("point contact: the ball is %.3f from the axis; %.3f ms a step" % point)
print("hydroelastic contact: the ball is %.3f from the axis; %.3f ms a step" % hydroelastic)
assert point[0] > 0.6, "a mesh is hollow now"
assert 0.3 < hydroelastic[0] < 0.5, "hydroelastic contact does not hold the ball"
PY
