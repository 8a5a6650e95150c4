#!/bin/sh
# MuJoCo and the mass that a closed mesh has by its density, if it has a hollow: a tube, and a cube with a closed hole beside its middle.
# One would guess that a wall weighs what its volume does, and that a hole moves the centre of mass to the other side.
# What happens: the tube with radii 0.5 and 0.6 weighs four times as much as it should, and more than a solid rod of its size. The cube with a hole weighs more than one
# without, and its centre of mass moves towards the hole. Inner walls are not subtracted, for the default of a mesh is inertia="legacy". No
# warning is given. With inertia="exact" all three numbers are right. It is the same for geoms of type sdf, whose contacts know the hollow.
# Who meets it: whoever gives density to pipes, cups, vessels or printed parts with hollows, as URDF and MJCF without inertias do.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco-core==4.0.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import itertools
import math

import mujoco
import numpy as np

SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def cube(half, x, is_hole):
    points = [(x + half * a, half * b, half * c) for a, b, c in itertools.product((-1, 1), repeat=3)]
    triangles = [triangle for a, b, c, d in SIDES for triangle in ((a, b, c), (a, c, d))]
    return points, [(a, c, b) if is_hole else (a, b, c) for a, b, c in triangles]


def joined(first, second):
    return first[0] + second[0], first[1] + [tuple(i + len(first[0]) for i in triangle) for triangle in second[1]]


def tube(count=64):
    rings = ((0.5, -1), (0.5, 1), (0.6, 1), (0.6, -1))
    points = [(r * math.cos(2 * math.pi * i / count), r * math.sin(2 * math.pi * i / count), z) for r, z in rings for i in range(count)]
    quads = [(k * count + i, k * count + (i + 1) % count, (k + 1) % 4 * count + (i + 1) % count, (k + 1) % 4 * count + i) for k in range(4) for i in range(count)]
    return points, [triangle for a, b, c, d in quads for triangle in ((a, c, b), (a, d, c))]


def volume(mesh):
    corners = np.array(mesh[0])[np.array(mesh[1])]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def weighed(mesh, kind, option):
    points, triangles = (" ".join(map(str, np.ravel(table))) for table in mesh)
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><asset><mesh name="part" vertex="{points}" face="{triangles}" {option}/></asset>
      <worldbody><body><freejoint/><geom type="{kind}" mesh="part" density="1"/></body></worldbody></mujoco>""")
    return round(float(model.body_mass[1]), 3), round(float(model.body_ipos[1][0]), 3)


parts = {"tube": tube(), "solid": cube(0.5, 0, False), "with a hole": joined(cube(0.5, 0, False), cube(0.2, 0.25, True))}
if volume(parts["tube"]) < 0:
    parts["tube"] = parts["tube"][0], [(a, c, b) for a, b, c in parts["tube"][1]]
found = {name: {"volume": round(volume(mesh), 3), "mesh": weighed(mesh, "mesh", ""), "exact": weighed(mesh, "mesh", 'inertia="exact"')} for name, mesh in parts.items()}
found["tube"]["sdf"] = weighed(parts["tube"], "sdf", "")
print("MuJoCo", mujoco.__version__, "mass at density 1 and x of its centre:", found)
for part in found.values():
    assert abs(part["exact"][0] - part["volume"]) < 0.002
assert found["tube"]["mesh"][0] > 4 * found["tube"]["volume"] and found["tube"]["sdf"] == found["tube"]["mesh"], "the tube has its weight now"
assert found["solid"]["mesh"] == (1, 0) and found["with a hole"]["mesh"][0] > 1
assert found["with a hole"]["mesh"][1] > 0 > found["with a hole"]["exact"][1]
PY
