"""Adds MuJoCo to the curve `integrator`: mujoco_peer.py FOLDER

The folder is that of `dials`, whose swing.json has the rope and the truth about it. In MuJoCo each point is a body on three slides and each
link a tendon with stiffness and length: the same springs and masses. Contacts and constraints are off. Needs mujoco (PyPI).
"""
import csv
import json
import os
import sys
import tempfile
import time
from pathlib import Path

import mujoco
import numpy as np

METHODS = {"MuJoCo Euler": "Euler", "MuJoCo implicit": "implicit", "MuJoCo RK4": "RK4"}
NOTES = {"MuJoCo Euler": "semi-implicit, as symplectic Euler", "MuJoCo implicit": "in velocities, not in springs", "MuJoCo RK4": ""}


def model_of(rope, integrator, dt):
    bodies, tendons = [], []
    for i, (x, y, z) in enumerate(rope["points"]):
        place = f'pos="{x!r} {y!r} {z!r}"'
        if i == 0:
            bodies.append(f'<site name="0" {place}/>')
            continue
        slides = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
        mass = f'<inertial pos="0 0 0" mass="{rope["mass"]}" diaginertia="1e-3 1e-3 1e-3"/>'
        bodies.append(f'<body {place}>{slides}{mass}<site name="{i}"/></body>')
        tendons.append(f'<spatial stiffness="{rope["stiffness"]}" springlength="{rope["rest"]}">'
                       f'<site site="{i - 1}"/><site site="{i}"/></spatial>')
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{dt!r}" integrator="{integrator}" gravity="0 0 -{rope["gravity"]}">'
        '<flag contact="disable" constraint="disable"/></option>'
        f'<worldbody>{"".join(bodies)}</worldbody><tendon>{"".join(tendons)}</tendon></mujoco>')


def run(rope, integrator, dt):
    """(processor seconds per simulated one, largest distance to the truth, exploded)"""
    model = model_of(rope, integrator, dt)
    start_places = np.array(rope["points"])[1:]
    seconds = []
    for _ in range(3):
        data = mujoco.MjData(model)
        steps = round(rope["seconds"] / rope["samples"] / dt)
        trace, start = [], time.process_time_ns()
        for _ in range(rope["samples"]):
            mujoco.mj_step(model, data, nstep=steps)
            trace.append(start_places + data.qpos.reshape(-1, 3))
        seconds.append(1e-9 * (time.process_time_ns() - start) / rope["seconds"])
        if seconds[-1] > 1:
            break
    distances = np.linalg.norm(np.array(trace) - np.array(rope["truth"])[:, 1:], axis=2)
    return min(seconds), float(distances.max()), data.warning.number.any()


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit("usage: mujoco_peer.py FOLDER")
    folder = Path(sys.argv[1]).resolve()
    rope = json.loads((folder / "swing.json").read_text(encoding="utf-8"))
    table = folder / "integrator.csv"
    with open(table, encoding="utf-8", newline="") as file:
        rows = [row for row in csv.reader(file) if row[1] not in METHODS]
    like = dict(zip(rows[0], rows[1]))
    mujoco.set_mju_user_warning(lambda message: None)  # what explodes is left out below
    with tempfile.TemporaryDirectory() as place:  # MuJoCo leaves a log where it runs
        os.chdir(place)
        for method, integrator in METHODS.items():
            for dt in rope["time_steps"]:
                seconds, error, exploded = run(rope, integrator, dt)
                if exploded or not np.isfinite(error):
                    continue  # it begins again from the start, so there is no error to tell
                own = {"method": method, "setting": f"{dt:g}", "seconds_per_item": f"{seconds:.6g}", "error": f"{error:.6g}",
                       "note": NOTES[method]}
                rows.append([{**like, **own}[column] for column in rows[0]])
        os.chdir(folder)
    with open(table, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


main()
