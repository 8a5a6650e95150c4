"""A cable of MuJoCo stays in a vessel with the coupling, and not without it."""

from __future__ import annotations

import pathlib
import sys

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco")
sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))

import dartsweep as ds
from mujoco_cable import LINK, RADIUS, SPEED, TIME_STEP, cable, cable_points, insert
from mujoco_sdf import run
from vessel import BORE, LAYER, tube, winding_axis


def test_8000_steps_are_free() -> None:
    outcome = insert(links=40, steps=8000)
    assert outcome.free_steps == outcome.steps == 8000
    assert outcome.depth >= 0.9 * SPEED * TIME_STEP * outcome.steps
    assert -1e-4 < outcome.least_gap < 1e-4 and outcome.behind == 0  # the forces keep the cable off the wall


@pytest.mark.parametrize("steps, speed", [(200, 0.6), (60, 2.0)])
def test_a_cable_that_breaks_through_comes_back(steps: int, speed: float) -> None:
    outcome = insert(40, steps, speed)
    assert outcome.free_steps == steps
    assert outcome.behind > RADIUS / 2 and outcome.least_gap == pytest.approx(-RADIUS, abs=1e-6)
    assert outcome.depth >= 0.75 * speed * TIME_STEP * steps


def test_mujoco_alone_does_not_hold_it() -> None:
    """A geom of type mesh is the convex hull of its mesh, so the cable starts inside of the wall and is pushed out."""
    links = 40
    straight = links * LINK + LAYER
    points, cells = tube(*winding_axis(straight, 0.14))
    text = " ".join(map(repr, points.ravel().tolist()))
    wall = '<geom type="mesh" mesh="vessel" contype="1" conaffinity="1"/>'
    model = cable(links, f'<asset><mesh name="vessel" vertex="{text}"/></asset>', wall)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.ncon > 0
    mujoco.mj_step(model, data, nstep=1000)
    with ds.Environment(points, cells) as environment:
        _, locations = environment.locate_points(cable_points(data))
    outside = np.count_nonzero(locations == ds.Location.OUTSIDE)
    assert outside > 0.9 * links


def test_a_signed_distance_field_is_hollow() -> None:
    assert [inside for _, inside, _ in run(links=40, marks=[0, 20])] == [41, 41]
