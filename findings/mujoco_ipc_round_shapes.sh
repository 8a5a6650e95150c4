#!/bin/sh
# MuJoCo's flag "ipc" (integrator "discrete"), whose contact of cloth cannot tunnel, and slim shapes that stand below a cloth of coarse triangles.
# One would guess that the cloth comes to hang on each of them, as without the flag, or that shapes which the mode does not know are named.
# What happens: a ball, a capsule, a box and a mesh in the middle of a triangle carry the cloth, which falls at 1 m/s. A cylinder and an ellipsoid, also a
# cylinder that lies like a bar and is three triangles long, go through it, and no vertex of the cloth is slowed. With ipc="disable" the same cylinders and
# ellipsoid carry it. Wide ellipsoids, which vertices of the cloth meet, carry it with the flag, too. The compiler and the step give no warning.
# Who meets it: whoever lays cloth or tissue on posts, pegs, rollers or needles, with the mode that promises most.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco-core==4.0.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import mujoco

SHAPES = {
    "ball": '<geom size="0.02"/>',
    "capsule": '<geom type="capsule" size="0.01 0.09"/>',
    "box": '<geom type="box" size="0.01 0.01 0.1"/>',
    "mesh": '<geom type="mesh" mesh="point"/>',
    "cylinder": '<geom type="cylinder" size="0.01 0.1"/>',
    "lying cylinder": '<geom type="cylinder" size="0.004 0.3" euler="0 90 20"/>',
    "ellipsoid": '<geom type="ellipsoid" size="0.01 0.01 0.1"/>',
    "wide ellipsoid": '<geom type="ellipsoid" size="0.2 0.2 0.1"/>',
}


def highest(flag, shape):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
      <option timestep="0.002" gravity="0 0 0" integrator="discrete"><flag ipc="{flag}"/></option>
      <asset><mesh name="point" vertex="-.01 -.01 -.1 .01 -.01 -.1 0 .01 -.1 0 0 .1"/></asset>
      <worldbody>{shape}<body name="cloth" pos="0.035 0.02 0.3">
        <flexcomp name="flex" type="grid" dim="2" count="9 9 1" spacing="0.1 0.1 0.1" mass="1" radius="0.005"><edge equality="true"/></flexcomp>
      </body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    data.qvel[2::3] = -1
    for _ in range(300):
        mujoco.mj_step(model, data)
    return round(float(data.flexvert_xpos[:, 2].max()), 3)


found = {name: {flag: highest(flag, shape) for flag in ("enable", "disable")} for name, shape in SHAPES.items()}
print("MuJoCo", mujoco.__version__, "highest point of the cloth, -0.3 in free flight:", found)
for name in ("ball", "capsule", "box", "mesh", "wide ellipsoid"):
    assert found[name]["enable"] > 0
for name in ("cylinder", "lying cylinder", "ellipsoid"):
    assert found[name]["enable"] < -0.29 and found[name]["disable"] > 0, name + " carries the cloth now"
PY
