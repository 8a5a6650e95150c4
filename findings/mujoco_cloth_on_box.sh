#!/bin/sh
# MuJoCo and a cloth (flex) that falls on a slim bar or a blade, once as a box and once as a mesh of the same eight corners.
# One would guess that both carry the cloth, and if one does not, then the mesh.
# What happens: the mesh carries it. The box of 2 or 4 cm by 20 cm, and a blade of 60 cm by 8 mm, are met by the cloth, their first contacts have the right
# depth and normal, and then the cloth goes down through them and falls on. A wide box, or a cloth whose radius is 20 mm in place of 5, is held.
# No warning is given. This is so with the default integrator and all flags as they are.
# Who meets it: whoever hangs cloth over rods, edges of tables or plates, or lets a gripper of thin boxes take it.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco-core==4.0.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import itertools

import mujoco
import numpy as np


def fall(kind, halves, radius=0.005):
    corners = " ".join(map(str, itertools.chain.from_iterable(itertools.product(*((-half, half) for half in halves)))))
    geom = '<geom type="mesh" mesh="bar"/>' if kind == "mesh" else f'<geom type="box" size="{halves[0]} {halves[1]} {halves[2]}"/>'
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><asset><mesh name="bar" vertex="{corners}"/></asset>
      <worldbody>{geom}<body name="cloth" pos="0.035 0.02 0.2">
        <flexcomp name="flex" type="grid" dim="2" count="9 9 1" spacing="0.1 0.1 0.1" mass="1" radius="{radius}"><edge equality="true"/></flexcomp>
      </body></worldbody></mujoco>""")
    data, first = mujoco.MjData(model), None
    for _ in range(500):
        mujoco.mj_step(model, data)
        if first is None and data.ncon:
            first = data.ncon, float(np.array(data.contact.dist).min()), float(np.array(data.contact.frame)[:, 2].max())
    return round(float(data.flexvert_xpos[:, 2].max()), 2), first


SLIM = [(0.01, 0.01, 0.1), (0.02, 0.02, 0.1), (0.3, 0.004, 0.1)]
boxes, meshes = ([fall(kind, halves) for halves in SLIM] for kind in ("box", "mesh"))
others = [fall("box", (0.04, 0.04, 0.1)), fall("box", SLIM[0], 0.02)]
print("MuJoCo", mujoco.__version__, "highest point of the cloth after a second, number, depth and normal of the first contacts, on boxes:", boxes, "on meshes:", meshes, "on a wide box, and thick:", others)
assert all(height > 0 for height, _ in meshes + others)
assert all(count >= 4 and -0.004 < depth < 0 and up > 0.99 for _, (count, depth, up) in boxes)
assert all(height < -2 for height, _ in boxes), "boxes carry the cloth now"
PY
