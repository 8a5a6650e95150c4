#!/bin/sh
# MuJoCo, a cloth (flex) that carries a ball, and a ray that looks down on it.
# One would guess that a rangefinder sees the cloth, because the ball rests on it: it is there for contacts.
# What happens: the sensor and mj_ray go through the cloth and give the distance to the floor below, 1.4 for 0.5. mj_rayFlex finds the cloth, but has to be
# called for each flex with its number, and no sensor calls it. No warning is given.
# Who meets it: whoever steers a needle, a probe or a drone by its distance from tissue or cloth that deforms.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco==4.0.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_string("""<mujoco><option timestep="0.001"/><worldbody>
  <flexcomp name="cloth" type="grid" dim="2" count="5 5 1" spacing=".25 .25 .25" mass="1" radius="0.005" pos="0 0 0">
    <edge equality="true"/><pin id="0 1 2 3 4 5 9 10 14 15 19 20 21 22 23 24"/>
  </flexcomp>
  <site name="eye" pos=".3 .3 .5" zaxis="0 0 -1"/>
  <body pos="0 0 -1"><geom type="box" size="2 2 .1"/></body>
  <body pos="-.1 -.1 .1"><freejoint/><geom name="ball" size=".05" mass="0.01"/></body>
</worldbody><sensor><rangefinder site="eye"/></sensor></mujoco>""")
data = mujoco.MjData(model)
for _ in range(1000):
    mujoco.mj_step(model, data)
mujoco.mj_forward(model, data)
eye, down = np.array([0.3, 0.3, 0.5]), np.array([0.0, 0.0, -1.0])
cloth = mujoco.mj_rayFlex(model, data, 0, False, False, True, False, 0, eye, down, np.zeros(1, np.int32))
ball = float(data.geom("ball").xpos[2])
by_ray = mujoco.mj_ray(model, data, eye, down, None, True, -1, None)
print("MuJoCo", mujoco.__version__, "ball at height", round(ball, 3), "contacts", data.ncon, "distance by sensor", float(data.sensordata[0]), "by mj_ray", by_ray, "by mj_rayFlex", cloth)
assert ball > -0.3 and data.ncon > 0 and 0 < cloth < 0.9, "the cloth carries the ball"
assert data.sensordata[0] > 1.3 and by_ray > 1.3, "rays see the cloth now"
PY
