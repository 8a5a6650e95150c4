"""The instrument finds a way, and goes there."""

from __future__ import annotations

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))

import steer
from vessel import winding_tube

import dartsweep as ds


def test_an_instrument_finds_its_way() -> None:
    with winding_tube() as environment:
        plan = steer.steer(environment, 3.0, 60.0, 1)
    assert plan is not None and plan.asked > len(plan.poses) > 1
    assert plan.kept[0] == 0 and plan.kept[-1] == len(plan.poses) - 1 and plan.kept == sorted(plan.kept)


def test_answers_are_those_of_moves() -> None:
    with winding_tube() as environment, ds.Scene(environment) as scene:
        instrument = steer.Instrument(scene, 3.0)
        rng = np.random.default_rng(3)
        at = np.append((0, 0, 0, 1), instrument.middle)
        others = at + rng.uniform(-1.5, 1.5, (40, 7)) * ((0.1,) * 3 + (0,) + (1,) * 3)
        poses = np.vstack([at, others])
        found = instrument.fractions(poses, [(0, i) for i in range(1, 41)])
        assert 0 < np.count_nonzero(found["fraction"] == 1) < 40
        before = instrument.body.positions()
        for pose, fraction in zip(others, found["fraction"]):
            assert abs(instrument.body.move_rigid(pose[4:] - instrument.middle, pose[:4], instrument.middle).fraction - fraction) < 1e-9
            instrument.body.move(before)
            assert np.array_equal(instrument.body.positions(), before)
