#!/bin/sh
# MuJoCo and the flag "speculative", which since 4.0 keeps fast things from going through thin ones, and walls of several kinds.
# One would guess that a ball of 60 m/s, whose step of 10 ms is longer than wall and ball are thick, is held by whatever it touches when it is slow.
# What happens: of ten balls that start a little apart, nine go through a box or a convex mesh without the flag, and none with it. Through a height field, a mesh
# as signed distance field (sdf) and a cloth (flex) seven or eight go with it, the same as without: it changes no number of these flights. With the integrator
# RK4 all ten go through the box, and only lose speed in it. No warning is given by the compiler, the step or the log.
# Who meets it: whoever has terrain as a height field, a vessel or a cup as sdf, or a net, and sets the flag; and whoever takes RK4 because it is more exact.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco-core==4.0.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import itertools

import mujoco

CORNERS = " ".join(map(str, itertools.chain.from_iterable(itertools.product((-2, 2), (-2, 2), (-0.01, 0.01)))))
BOX = '<geom type="box" size="2 2 0.01"/>'
WALLS = {
    "box": (BOX, "Euler"),
    "mesh": ('<geom type="mesh" mesh="plate"/>', "Euler"),
    "plane": ('<geom type="plane" size="2 2 1"/>', "Euler"),
    "height field": ('<geom type="hfield" hfield="flat"/>', "Euler"),
    "sdf": ('<geom type="sdf" mesh="plate"/>', "Euler"),
    "flex": ('<body name="net"><flexcomp name="flex" type="grid" dim="2" count="9 9 1" spacing="0.5 0.5 0.1" mass="10" radius="0.01"><pin gridrange="0 0 8 8"/></flexcomp></body>', "Euler"),
    "box with RK4": (BOX, "RK4"),
}


def flight(wall, integrator, flag, start):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
      <option timestep="0.01" gravity="0 0 0" integrator="{integrator}"><flag speculative="{flag}"/></option>
      <asset><mesh name="plate" vertex="{CORNERS}"/><hfield name="flat" nrow="3" ncol="3" size="2 2 0.01 0.01" elevation="0 0 0 0 0 0 0 0 0"/></asset>
      <worldbody>{wall}<body name="ball" pos="0.13 0.07 {start}"><freejoint/><geom size="0.1"/></body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    ball, first = model.body("ball").id, model.body("ball").dofadr[0]
    data.qvel[first + 2] = -60
    for _ in range(30):
        mujoco.mj_step(model, data)
    return float(data.xpos[ball][2])


ends = {(name, flag): [flight(*wall, flag, 3 + 0.06 * i) for i in range(10)] for name, wall in WALLS.items() for flag in ("enable", "disable")}
through = {key: sum(z < -0.2 for z in values) for key, values in ends.items()}
print("MuJoCo", mujoco.__version__, "balls of ten that go through:", {name: {flag: through[name, flag] for flag in ("enable", "disable")} for name in WALLS})
assert all(through[name, "enable"] == 0 for name in ("box", "mesh", "plane")) and through["box", "disable"] == 9
for name in ("height field", "sdf", "flex"):
    assert through[name, "disable"] >= 5 and ends[name, "enable"] == ends[name, "disable"], name + " is held now"
assert through["box with RK4", "enable"] == 10, "RK4 holds now"
PY
