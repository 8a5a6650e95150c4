"""Curves of error against run time for dials of moves, walls and changes, from Python: measure.py FOLDER [--quick].

Truth is what has no dial: a target that each vertex reaches for itself, a way without limits, a shape that a formula knows.
examples/report/dials.csv says which dial is on which curve; ../README.md has the format.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import moves
import near
import surgery
import together
import walls
from scene import Curve

# How each curve is made, and of how many cases: in a short run, and in a long one.
CURVES: dict[str, tuple[Callable[[int], Curve], int, int]] = {
    "response": (moves.responses, 40, 1000),
    "min_part": (moves.min_part, 60, 2000),
    "min_length": (moves.min_length, 60, 2000),
    "passes": (moves.passes, 60, 2000),
    "max_volumes": (moves.work_limit, 10, 200),
    "query_limit": (moves.casts_limited, 40, 2000),
    "noise_share": (moves.noise_share, 30, 500),
    "keep_walls": (moves.keep_walls, 40, 1000),
    "back_edges": (moves.back_edges, 20, 300),
    "faces_of_cells": (moves.faces_of_cells, 40, 1000),
    "together_stop": (together.stop, 4, 40),
    "together_response": (together.response, 4, 40),
    "rigid": (together.rigid, 30, 500),
    "rigid_slide": (together.rigid_slide, 20, 200),
    "wall_response": (walls.wall_response, 2, 30),
    "wall_min_part": (walls.wall_min_part, 3, 60),
    "most_halvings": (walls.most_halvings, 3, 40),
    "max_holds": (walls.max_holds, 2, 30),
    "invalid_response": (walls.invalid, 3, 30),
    "remesh": (walls.remesh, 2, 20),
    "snap": (surgery.snap, 3, 40),
    "tie_snap": (surgery.tie, 4, 60),
    "crack_width": (surgery.crack_width, 6, 60),
    "coarsen": (surgery.coarsen, 3, 20),
    "detach": (surgery.detach, 2, 20),
    "near_margin": (near.margin, 40, 600),
}


def make(name: str, quick: bool) -> Curve:
    """A curve by its name."""
    measure, few, many = CURVES[name]
    return measure(few if quick else many)


def main() -> None:
    parser = argparse.ArgumentParser(description="Curves of error against run time for dials of moves, walls and changes.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--quick", action="store_true", help="few cases: times scatter more")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for name in CURVES:
        made = make(name, options.quick)
        made.write(options.folder)
        print(f"{name}: {made.advice}")


if __name__ == "__main__":
    main()
