"""A cord of Newton stays in the vessel. The first run compiles kernels for minutes."""

from __future__ import annotations

import pathlib
import sys

import numpy as np
import pytest

pytest.importorskip("newton")
sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))

from newton_cord import LINK, RADIUS, SPEED, TIME_STEP, cord, insert


def test_links_have_the_moments_of_inertia_of_their_shapes() -> None:
    across, _, along = cord(3).body_inertia.numpy()[1].diagonal()
    mass = 6000 * np.pi * RADIUS**2 * LINK
    assert along == pytest.approx(mass * RADIUS**2 / 2, rel=0.2) and across == pytest.approx(mass * LINK**2 / 12, rel=0.5)


def test_the_proxy_of_a_cord_is_free() -> None:
    steps = 1000
    free, depth, proxy = insert(links=20, steps=steps)
    assert free == steps
    assert depth >= 0.8 * SPEED * TIME_STEP * steps
    assert np.isfinite(proxy.before).all() and proxy.least_gap < 1e-4 and 1e-3 < proxy.behind < 5e-3
