"""A cord of Newton stays in the vessel. The first run compiles kernels for minutes."""

from __future__ import annotations

import pathlib
import sys

import numpy as np
import pytest

pytest.importorskip("newton")
sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))

from newton_cord import SPEED, TIME_STEP, insert


def test_the_proxy_of_a_cord_is_free() -> None:
    steps = 1000
    free, depth, proxy = insert(links=20, steps=steps)
    assert free == steps
    assert depth >= 0.8 * SPEED * TIME_STEP * steps
    assert np.isfinite(proxy.before).all() and proxy.least_gap < 1e-4
