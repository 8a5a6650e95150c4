#!/bin/sh
# MuJoCo's flag "sleep" and a box on a lift: a table that is a mocap body and is lowered by half a metre in a second.
# One would guess that the box rides down on the table, because bodies at rest fall asleep to save time and wake when what they stand on goes away.
# What happens: the box hangs in the air where the table was, asleep. A table that is raised takes the box along. A box on a fixed floor sleeps on as gravity
# is tilted by 45 degrees, where it slides without the flag. Nothing is printed, and the state looks like one of rest.
# Who meets it: whoever moves tables, jaws, lifts or hands as mocap bodies, as teleoperation and motion capture do, and turns on sleep for many parts.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco-core==4.0.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import mujoco

LIFT = '<body mocap="true" pos="0 0 -0.1"><geom type="box" size="1 1 0.1"/></body>'
FLOOR = '<geom type="plane" size="5 5 1"/>'


def lower(model, data):
    data.mocap_pos[0, 2] -= 0.001


def lift(model, data):
    data.mocap_pos[0, 2] += 0.001


def tilt(model, data):
    model.opt.gravity[:] = 7, 0, -7


def run(flag, ground, change):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><option sleep_tolerance="1e-3"><flag sleep="{flag}"/></option>
      <default><geom friction="0.3"/></default><worldbody>{ground}<body name="box" pos="0 0 0.1"><freejoint/><geom type="box" size="0.1 0.1 0.1"/></body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    for _ in range(3000):
        mujoco.mj_step(model, data)
    for _ in range(500):
        change(model, data)
        mujoco.mj_step(model, data)
    return [round(float(data.xpos[model.body("box").id][axis]), 2) for axis in (0, 2)]


found = {name: {flag: run(flag, ground, change) for flag in ("enable", "disable")} for name, ground, change in (("lowered", LIFT, lower), ("raised", LIFT, lift), ("tilted", FLOOR, tilt))}
print("MuJoCo", mujoco.__version__, "x and z of the box after a second, first at 0, 0.1:", found)
assert found["lowered"] == {"enable": [0, 0.1], "disable": [0, -0.4]}, "the box rides down now"
assert found["raised"]["enable"][1] > 0.5 and found["raised"]["disable"][1] > 0.5
assert found["tilted"]["enable"] == [0, 0.1] and found["tilted"]["disable"][0] > 0.5, "the box slides now"
PY
