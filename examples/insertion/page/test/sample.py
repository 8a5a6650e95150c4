#!/usr/bin/env python3
"""Writes a small insertion as the program would: sample.py OUTPUT.json. A catheter goes 30 frames far into a bent tube."""
import json
import math
import sys

FRAMES, RINGS, SIDES, RADIUS = 30, 40, 16, 1.5
TITLE = "A tube “β₃ 試験” </script><!-- <b>& one catheter"
KINDS = ["plane", "edge", "vertex"]


def centre(along):
    return [along, 2 * math.sin(along / 6), 1.5 * math.cos(along / 5)]


def wall():
    positions = []
    for ring in range(RINGS):
        x, y, z = centre(ring)
        for side in range(SIDES):
            turn = 2 * math.pi * side / SIDES
            positions += [x, y + RADIUS * math.cos(turn), z + RADIUS * math.sin(turn)]
    triangles = []
    for ring in range(RINGS - 1):
        for side in range(SIDES):
            here, beside = ring * SIDES + side, ring * SIDES + (side + 1) % SIDES
            triangles += [here, beside, here + SIDES, beside, beside + SIDES, here + SIDES]
    return {"positions": positions, "triangles": triangles}


def contact(frame, number):
    x, y, z = centre(1 + 0.7 * frame * (1 - 0.2 * number))
    turn = 0.4 * frame + 1.3 * number
    out = [0, math.cos(turn), math.sin(turn)]
    return {"point": [x, y + RADIUS * out[1], z + RADIUS * out[2]], "normal": [0, -out[1], -out[2]],
            "kind": KINDS[(frame + number) % 3], "time": (frame * 7 + number) % 10 / 10, "tag": number,
            "vertex": frame - 2 * number, "impulse": 0.125 * (frame + number)}


def frame(number):
    reached = 1 + 1.2 * number
    vertices = 2 + number
    positions = [value for at in range(vertices) for value in centre(reached * at / (vertices - 1))]
    return {"step": 20 * number, "time": 0.2 * number, "positions": positions, "inserted": list(range(3, vertices - 1, 4)),
            "contacts": [contact(number, at) for at in range(number % 4)]}


def insertion():
    frames = [frame(number) for number in range(FRAMES)]
    counts = [number % 5 for number in range(FRAMES)]
    every = [one for entry in frames for one in entry["contacts"]]
    by_kind = [[one for one in every if one["kind"] == kind] for kind in KINDS]
    return {
        "format": 1, "title": TITLE, "unit": "mm", "dt": 0.01,
        "environment": {"volumes": 3744, "passable": 1248, "points": RINGS * SIDES, "source": "sample.py"},
        "wall": wall(),
        "summary": {"demo.steps": 600, "demo.exactly_free_steps": 600, "demo.cells_tested_share_max": 0.00712345,
                    "demo.realtime_factor": 12.5, "demo.contacts": len(every), "demo.undefined": math.nan},
        "frames": frames,
        "series": {"time": [entry["time"] for entry in frames], "reached": [1 + 1.2 * at for at in range(FRAMES)],
                   "vertices": [2 + at for at in range(FRAMES)], "contacts": counts,
                   "cells_tested_share": [0.002 + 0.0001 * at for at in range(FRAMES)],
                   "orientation_tests": [12345 + 1000 * at for at in range(FRAMES)],
                   "detection_ms": [0.02 + 0.001 * at for at in range(FRAMES)],
                   "step_ms": [0.2 + 0.01 * at for at in range(FRAMES)], "verified": [1] * FRAMES},
        "series_about": {"contacts": "Contacts of all steps since the frame before."},
        "contact_table": {"columns": ["kind", "contacts", "largest impulse"],
                          "rows": [[kind, len(some), max(one["impulse"] for one in some)]
                                   for kind, some in zip(KINDS, by_kind)]},
    }


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        json.dump(insertion(), file, ensure_ascii=False)
