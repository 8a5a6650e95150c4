#!/bin/sh
# MuJoCo's distance between two geoms (the sensors distance, normal and fromto, and mj_geomDistance), and a hollow tube as signed distance field (sdf).
# One would guess that a ball in the tube has its gap from the wall, since a distance field is what the geom is made of.
# What happens: as long as the two do not touch, the sensor gives its cutoff, here 5, which reads as "nothing is within 5": in the middle of the tube, 5 mm
# from its wall, and outside. The normal is 0. Once the ball is 0.03 in the wall, it jumps from 5 to -0.01. No warning is given. The same mesh as a geom of type
# mesh has distances, of the convex hull: the ball in the middle of the tube is 0.69 deep.
# Who meets it: whoever made a vessel, a pipe or a cup an sdf to have it hollow, and steers or rewards by the clearance from its wall.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco-core==4.0.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import math

import mujoco
import numpy as np

COUNT = 16
points, triangles = [], []
for radius, height in ((0.5, -1), (0.5, 1), (0.6, 1), (0.6, -1)):
    points += [(radius * math.cos(2 * math.pi * i / COUNT), radius * math.sin(2 * math.pi * i / COUNT), height) for i in range(COUNT)]
for ring in range(4):
    for i in range(COUNT):
        a, b = ring * COUNT + i, ring * COUNT + (i + 1) % COUNT
        c, d = (b + COUNT) % (4 * COUNT), (a + COUNT) % (4 * COUNT)
        triangles += [(a, c, b), (a, d, c)]
corners = np.array(points)[np.array(triangles)]
if np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) < 0:
    triangles = [(a, c, b) for a, b, c in triangles]
POINTS, TRIANGLES = (" ".join(map(str, np.ravel(table))) for table in (points, triangles))


def ask(kind, place):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><asset><mesh name="tube" vertex="{POINTS}" face="{TRIANGLES}"/></asset>
      <worldbody><geom name="wall" type="{kind}" mesh="tube"/><body pos="{place} 0 0"><freejoint/><geom name="ball" size="0.1"/></body></worldbody>
      <sensor><distance geom1="wall" geom2="ball" cutoff="5"/><normal geom1="wall" geom2="ball" cutoff="5"/></sensor></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    deepest = min((round(float(contact.dist), 2) for contact in data.contact), default=None)
    return round(float(data.sensordata[0]), 2), data.sensordata[1:].tolist(), deepest


PLACES = (0, 0.3, 0.385, 0.9, 0.42)
field, hull = ([ask(kind, place) for place in PLACES] for kind in ("sdf", "mesh"))
print("MuJoCo", mujoco.__version__, "distance, normal and deepest contact of a ball of radius 0.1 at x =", PLACES, "and a tube with a wall from 0.5 to 0.6: as sdf", field, "as mesh", hull)
assert all(distance == 5 and normal == [0, 0, 0] for distance, normal, _ in field[:4]), "there are distances now"
assert field[4][0] == field[4][2] and -0.05 < field[4][0] < 0
assert hull[3][0] == 0.2 and hull[0][0] < -0.6
PY
