#!/usr/bin/env python3
"""A rigid instrument finds its way through the winding vessel: OMPL plans, the library says how far each motion is free.

Poses are checked and motions swept exactly, walls included that are thinner than any step. OMPL's RRT-Connect asks about one motion at a time. Then
all short cuts between two poses of its path are asked about in one batch, and the cheapest way that uses free ones is kept.

usage: steer.py [--length 3] [--seconds 60] [--seed 1]
"""

from __future__ import annotations

import argparse
import itertools
import time
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from ompl import base, geometric, util
from vessel import LENGTH, axis, winding_tube

import dartsweep as ds

BEGIN, END = 4.0, 34.0  # heights of the middle of the instrument


class Plan(NamedTuple):
    """What came of a search."""

    poses: NDArray[np.float64]  # quaternion x, y, z, w and translation, as OMPL found them
    kept: list[int]  # of these, those that are left after short cuts
    asked: int  # motions in the search
    short_cuts: int  # that were asked about in one batch
    seconds: float
    seconds_asked: float


class Instrument:
    """A bar with a foot, and how far it can go."""

    def __init__(self, scene: ds.Scene, length: float) -> None:
        self.middle = axis(np.array([BEGIN]))[0]
        half = length / 2
        shape = np.array([(0, 0, -half), (0, 0, half), (0.5, 0, half), (0, 0.25, half)])
        self.body = scene.create_body(self.middle + shape, triangles=[(1, 2, 3)], edges=[(0, 1)], level=ds.Level.FACES)
        self.asked = 0
        self.seconds = 0.0

    def fractions(self, poses: NDArray[np.float64], paths: Any) -> NDArray[Any]:
        """How far it can go on each path; poses are those of its middle."""
        start = time.perf_counter()
        found: NDArray[Any] = self.body.find_free_fractions(poses - np.append(np.zeros(4), self.middle), paths, self.middle)
        self.seconds += time.perf_counter() - start
        self.asked += len(found)
        return found

    def is_free(self, pose: NDArray[np.float64]) -> bool:
        return bool(self.fractions(pose[None], [(0,)])["starts_free"][0])

    def can_go(self, start: NDArray[np.float64], end: NDArray[np.float64]) -> bool:
        return bool(self.fractions(np.stack([start, end]), [(0, 1)])["fraction"][0] == 1)


def pose_of(state: Any) -> NDArray[np.float64]:
    turn = state.rotation()
    return np.array([turn.x, turn.y, turn.z, turn.w, state.getX(), state.getY(), state.getZ()])


class Motions(base.MotionValidator):
    """Tells OMPL which motions are free."""

    def __init__(self, information: Any, instrument: Instrument) -> None:
        super().__init__(information)
        self.instrument = instrument

    def checkMotion(self, start: Any, end: Any, *last: Any) -> bool:  # noqa: N802: OMPL's name
        return self.instrument.can_go(pose_of(start), pose_of(end))


def setup_of(instrument: Instrument) -> tuple[Any, Motions]:
    """The task as OMPL takes it, and what has to stay alive with it."""
    space = base.SE3StateSpace()
    bounds = base.RealVectorBounds(3)
    way = axis(np.linspace(0, LENGTH, 100))
    for k in range(3):
        bounds.setLow(k, float(way[:, k].min()) - (2 if k < 2 else 0))
        bounds.setHigh(k, float(way[:, k].max()) + (2 if k < 2 else 0))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)
    information = setup.getSpaceInformation()
    setup.setStateValidityChecker(lambda state: instrument.is_free(pose_of(state)))
    motions = Motions(information, instrument)
    information.setMotionValidator(motions)
    states = []
    for height in (BEGIN, END):
        state = space.allocState()
        state.setXYZ(*axis(np.array([height]))[0])
        state.rotation().setIdentity()
        states.append(state)
    setup.setStartAndGoalStates(*states)
    planner = geometric.RRTConnect(information)
    planner.setRange(4.0)
    setup.setPlanner(planner)
    return setup, motions


def short_cuts(instrument: Instrument, poses: NDArray[np.float64]) -> tuple[list[int], int]:
    """The way from the first pose to the last with the fewest motions, and how many motions were asked about."""
    pairs = list(itertools.combinations(range(len(poses)), 2))
    free = instrument.fractions(poses, pairs)["fraction"] == 1
    reached: dict[int, tuple[int, int]] = {0: (0, -1)}  # pose -> motions that lead there, pose before
    for (a, b), goes in sorted(zip(pairs, free)):
        if goes and a in reached and (b not in reached or reached[a][0] + 1 < reached[b][0]):
            reached[b] = reached[a][0] + 1, a
    kept = [len(poses) - 1]
    while kept[-1] != 0:
        kept.append(reached[kept[-1]][1])
    return kept[::-1], len(pairs)


def steer(environment: ds.Environment, length: float, seconds: float, seed: int) -> Plan | None:
    """Plans, and moves the instrument along the way that was found."""
    util.RNG.setSeed(seed)
    util.setLogLevel(util.LogLevel.LOG_WARN)
    with ds.Scene(environment) as scene:
        instrument = Instrument(scene, length)
        start = time.perf_counter()
        setup, _motions = setup_of(instrument)
        if not setup.solve(seconds) or not setup.haveExactSolutionPath():
            return None
        spent, asked, spent_asked = time.perf_counter() - start, instrument.asked, instrument.seconds
        poses = np.array([pose_of(state) for state in setup.getSolutionPath().getStates()])
        kept, pairs = short_cuts(instrument, poses)
        drive(instrument, poses[kept])
        return Plan(poses, kept, asked, pairs, spent, spent_asked)


def drive(instrument: Instrument, poses: NDArray[np.float64]) -> None:
    """Moves the instrument from pose to pose. It comes there, up to rounding."""
    for (ax, ay, az, aw, *a), (bx, by, bz, bw, *b) in itertools.pairwise(poses):
        turn = (
            bw * -ax + bx * aw + by * -az - bz * -ay,
            bw * -ay + by * aw + bz * -ax - bx * -az,
            bw * -az + bz * aw + bx * -ay - by * -ax,
            bw * aw + bx * ax + by * ay + bz * az,
        )
        report = instrument.body.move_rigid(np.subtract(b, a), turn, a)
        assert report.fraction == 1


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--length", type=float, default=3.0, help="of the instrument; the lumen is 4 wide")
    parser.add_argument("--seconds", type=float, default=60.0, help="that the search may take")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    with winding_tube() as environment:
        plan = steer(environment, given.length, given.seconds, given.seed)
    if plan is None:
        raise SystemExit("no way was found")
    print(f"{len(plan.poses)} poses after {plan.seconds:.2f} s, of which {plan.seconds_asked:.2f} s in {plan.asked} questions to the library")
    print(f"{len(plan.kept)} poses are left after {plan.short_cuts} short cuts in one batch; the instrument has gone there")


if __name__ == "__main__":
    main()
