"""Every curve of measure.py in a small form, and what must hold on it."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable
from pathlib import Path

import pytest

from measure import CURVES, make
from scene import COLUMNS, Curve


def by(curve: Curve, method: str) -> dict[str, float]:
    return {p.setting: p.error for p in curve.points if p.method == f"dartsweep {method}".strip()}


def falls(errors: dict[str, float], slack: float = 0.0) -> bool:
    """Whether the error of the last setting is at most that of the first, and the first is not exact."""
    values = list(errors.values())
    return values[0] > 0 and values[-1] <= values[0] + slack


# What holds at any seed: which end of a dial is the better one, and what is exactly 0.
BARS: dict[str, Callable[[Curve], bool]] = {
    "response": lambda c: all(by(c, "adaptive slide")[s] <= by(c, "stop")[s] for s in ("0.25", "0.5", "1", "2")),
    "min_part": lambda c: by(c, "adaptive, one")["0.01"] < by(c, "adaptive, one")["0.5"],
    "min_length": lambda c: by(c, "adaptive, one")["0"] < by(c, "adaptive, one")["0.4"],
    "passes": lambda c: by(c, "stop")["16"] <= by(c, "stop")["1"] <= by(c, "stop")["0"],
    "max_volumes": lambda c: falls(by(c, "limited")) and by(c, "limited")["1024"] == by(c, "exact")["none"],
    "query_limit": lambda c: by(c, "limited")["1"] > 0 and by(c, "exact")["none"] == 0 and by(c, "sweep exact")["none"] == 0,
    "noise_share": lambda c: by(c, "")["1e-09"] <= 1e-6 and by(c, "")["0.1"] >= by(c, "")["1e-09"],
    "keep_walls": lambda c: by(c, "KEEP_WALLS")["8"] < by(c, "KEEP_WALLS")["1"],
    "back_edges": lambda c: all(p.error == 0 for p in c.points if "none" in p.method or "6.1" in p.method),
    "faces_of_cells": lambda c: all(p.error <= 3 * int(p.setting) for p in c.points) and by(c, "")["66"] <= 66,
    "together_stop": lambda c: by(c, "FEATURE")["64"] < by(c, "FEATURE")["1"] < c.points[1].error <= c.points[0].error,
    "together_response": lambda c: by(c, "SLIDE")["64"] < by(c, "STOP")["64"],
    "rigid": lambda c: by(c, "straight steps")["256"] < 0.02 < by(c, "straight steps")["1"] and by(c, "arcs (exact)")[""] == 0,
    "rigid_slide": lambda c: by(c, "SLIDE_WHOLE")["64"] <= by(c, "SLIDE_WHOLE")["1"] <= by(c, "stop")["0"],
    "wall_response": lambda c: by(c, "PUSH")["0.1"] <= by(c, "HOLD")["0.1"] < by(c, "STOP")["0.1"],
    "wall_min_part": lambda c: max(by(c, "INSERT").values()) < 0.05,
    "most_halvings": lambda c: falls(by(c, "SWEPT")),
    "max_holds": lambda c: by(c, "SWEPT")["16384"] < by(c, "SWEPT")["1"],
    "invalid_response": lambda c: by(c, "HOLD")["0.5"] < by(c, "REFUSE")["0.5"],
    "remesh": lambda c: falls(by(c, "max_faces")) and by(c, "radius")["8"] <= by(c, "radius")["1"],
    "snap": lambda c: by(c, "cut")["1e-06"] < 1e-12 and by(c, "cut")["0.01"] <= by(c, "cut")["0.25"] and max(by(c, "carve").values()) < 0.05,
    "tie_snap": lambda c: by(c, "")["1e-06"] < 1e-12 and by(c, "")["0.25"] > by(c, "")["0.01"],
    "crack_width": lambda c: by(c, "")["0.001"] == 0 and by(c, "")["0.4"] > 0,
    "coarsen": lambda c: falls(by(c, "max_faces")) and falls(by(c, "max_trials")),
    "detach": lambda c: all(math.isclose(error, float(gap), rel_tol=1e-3) for gap, error in by(c, "gap").items()),
    "near_margin": lambda c: by(c, "")["4"] == 0 and by(c, "")["0"] > by(c, "")["0.5"],
}


@pytest.mark.parametrize("name", CURVES)
def test_a_curve_is_made_and_its_bar_holds(name: str, tmp_path: Path) -> None:
    curve = make(name, quick=True)
    assert curve.name == name and len(curve.points) >= 5 and curve.advice
    assert all(math.isfinite(p.error) and p.error >= 0 and p.seconds > 0 and p.count > 0 for p in curve.points)
    curve.write(tmp_path)
    with open(tmp_path / f"{name}.csv", newline="", encoding="utf-8") as file:
        assert list(next(csv.reader(file))) == COLUMNS
    assert BARS[name](curve), "\n".join(f"{p.method} {p.setting}: {p.error:.4g}" for p in curve.points)


def test_every_curve_has_a_bar() -> None:
    assert BARS.keys() == CURVES.keys()
