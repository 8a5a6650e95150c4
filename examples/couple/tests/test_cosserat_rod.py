"""Dartsweep's rod in scenes of cosseratbench with known answers."""

from __future__ import annotations

import dataclasses
import pathlib
import sys

import numpy as np
import pytest

bench = pytest.importorskip("cosseratbench.experiment")
sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))

from cosserat_rod import DartsweepSolver
from cosseratbench import registry


@pytest.mark.parametrize("scene, bars", [
    ("cantilever", {"tip_deflection_error": 1e-3}),
    ("catenary", {"shape_error": 5e-4}),
    ("pendulum", {"period_error": 2e-4}),
    ("capstan", {"slide": 1e-3, "max_penetration": 0.01}),
])
def test_a_scene(scene: str, bars: dict[str, float]) -> None:
    result = bench.run(registry.load_experiment(scene), DartsweepSolver())
    assert result.outcome == "completed"
    told = {**result.metrics, **result.observations}
    assert {name: told[name] for name, bar in bars.items() if not told[name] <= bar} == {}


def test_an_end_that_slides_along_its_axis_stays_where_the_load_holds_it() -> None:
    scenario = dataclasses.replace(registry.load_experiment("twist").scenario, duration=1.0)
    trajectory = DartsweepSolver().run(scenario, n_elements=50, n_frames=11)
    for rod, positions in zip(scenario.rods, trajectory.positions):
        moved = np.abs(positions - positions[0]).max()
        assert moved < 1e-2 * rod.length, "the rod is pulled to and fro"
