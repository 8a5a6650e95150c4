#!/usr/bin/env python3
"""Runs the scenes with SOFA, each for some steps, and asks for what must hold.

usage: test_scenes.py PROGRAM PLUGIN SCENES [STEPS-TIMES]    the program sofa_run_scene, the plugin, the folder of the scenes
Exit 0: all holds; 77: no scene could run, since modules of SOFA are missing; 1: every fault is named.
"""
import json
import pathlib
import subprocess
import sys

DT = 0.01
OURS = {"catheter": 400, "catheter_fine": 100, "thread_post": 300, "beating": 300, "rest": 400, "stop": 60, "carve": 600}
THEIRS = {"catheter_min_distance": 100, "catheter_fine_min_distance": 40, "catheter_tight_inclusion": 40, "catheter_fine_tight_inclusion": 40}
FAST = {"catheter_fine", *THEIRS}  # the wire is pushed at 52 mm/s, so it meets the wall


class Failed(Exception):
    pass


def run(program, plugin, scenes, name, steps, *more):
    """The numbers of a scene, and what was watched: for each path a list of lists of numbers."""
    command = [program, str(scenes / f"{name}.scn"), str(steps), "--path", str(pathlib.Path(plugin).parent), *more]
    done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    watched = {}
    for line in done.stderr.splitlines():
        words = line.split()
        if words[:1] == ["watch"]:
            watched.setdefault(words[2], []).append([float(word) for word in words[3:]])
        else:
            print(f"{name}: {line}")
    if not done.stdout.startswith("{"):
        raise Failed(f"{name} did not run ({done.returncode})")
    return json.loads(done.stdout), watched


def must(condition, words):
    if not condition:
        raise Failed(words)


def check_velocities(name, watched):
    """A velocity is that of the positions that were taken, also of points that stop."""
    positions, velocities = watched["points.position"], watched["points.velocity"]
    worst = 0.0
    for before, after, velocity in zip(positions, positions[1:], velocities[1:]):
        worst = max(worst, *(abs((b - a) / DT - v) for a, b, v in zip(before, after, velocity)))
    must(worst < 1e-6, f"{name}: a velocity differs by {worst} from the way that was made")


def energy(velocity):
    return sum(value * value for value in velocity) / 2


def check_energy(name, watched, from_step):
    energies = [energy(velocity) for velocity in watched["points.velocity"][from_step:]]
    must(max(energies) <= energies[0] * (1 + 1e-9) + 1e-12, f"{name}: energy at rest grows from {energies[0]} to {max(energies)}")


def check(name, numbers, watched, steps):
    must(numbers["errors"] == 0, f"{name}: {numbers['errors']} messages of error")
    if name in THEIRS:
        must(numbers["check.steps"] == steps and numbers["check.length"] > 5, f"{name}: the wire is not fed")
        return
    if "check.steps" in numbers:
        must(numbers["check.steps"] == steps, f"{name}: {numbers['check.steps']} of {steps} steps were checked")
        must(numbers["check.notFree"] == 0, f"{name}: not free after {numbers['check.notFree']} steps")
    must(numbers["body.notFree"] == 0, f"{name}: {numbers['body.notFree']} moves failed")
    if name == "catheter_fine":
        must(numbers["check.touching"] > 0, f"{name}: the wire does not meet the wall")
    if name == "carve":
        must(numbers["carver.carved"] > 50, f"carve: only {numbers['carver.carved']} tetrahedra are carved")
        must(numbers["environment.removed"] == numbers["carver.carved"], "carve: the environment does not follow the topology")
        must(numbers["body.stopped"] == 0, "carve: the ball does not arrive")
    if name == "stop":
        must(numbers["body.stops"] > 20, f"{name}: nothing stops")
    if name in ("stop", "rest"):
        check_velocities(name, watched)
    if name == "rest":
        must(numbers["contacts.active"] > 5, f"{name}: no row carries the wire")
        check_energy(name, watched, steps // 2)


def main(program, plugin, scenes, times=1):
    faults, ran = [], 0
    for name, steps in {**OURS, **THEIRS}.items():
        steps *= int(times)
        more = ["--watch", "points.position", "--watch", "points.velocity"] if name in ("stop", "rest") else []
        more += ["--set", "controller.speed=52"] if name in FAST else []
        try:
            numbers, watched = run(program, plugin, pathlib.Path(scenes), name, steps, *more)
            ran += 1
            check(name, numbers, watched, steps)
            print(f"{name}: {json.dumps(numbers)}")
        except Failed as fault:
            faults.append(str(fault))
    print("\n".join(faults) or f"{ran} scenes ran")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
