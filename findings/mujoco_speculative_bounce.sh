#!/bin/sh
# MuJoCo, the flag "speculative" of 4.0 against going through thin things, and balls that bounce on a plane.
# One would guess that the flag changes nothing where nothing would be missed, or that balls of all sizes bounce alike, because solref says how they bounce.
# What happens: two balls fall by one metre on the same plane, in steps of 5 ms. The ball of radius 0.1 comes up with 4 m/s, with the flag as without. The ball
# of radius 0.01 comes up with 4 m/s without it, and with it stops dead on the plane. A contact that is foreseen takes all of the speed away and lands
# the ball in the surface's height, so solref has nothing left to throw back. In steps of 2 ms both balls bounce again. No warning is given.
# Who meets it: whoever drops, sorts or throws small parts, balls of a mill or grains: the bounce depends on size, speed and step.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mujoco-core==4.0.1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import mujoco


def speed_up(flag, radius, step):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
      <option timestep="{step}"><flag speculative="{flag}"/></option><default><geom solref="-10000 -5"/></default>
      <worldbody><geom type="plane" size="4 4 1"/><body pos="0 0 {1 + radius}"><freejoint/><geom size="{radius}"/></body></worldbody></mujoco>""")
    data, fastest = mujoco.MjData(model), 0.0
    for _ in range(round(1.2 / step)):
        mujoco.mj_step(model, data)
        fastest = max(fastest, float(data.qvel[2]))
    return round(fastest, 2)


found = {step: {radius: {flag: speed_up(flag, radius, step) for flag in ("disable", "enable")} for radius in (0.1, 0.01)} for step in (0.002, 0.005)}
print("MuJoCo", mujoco.__version__, "speed after the first bounce by step, radius and flag:", found)
small = found[0.005].pop(0.01)
assert small["disable"] > 3.9 and small["enable"] < 0.2, "small balls bounce now"
assert all(speed > 3.9 for radii in found.values() for flags in radii.values() for speed in flags.values())
PY
