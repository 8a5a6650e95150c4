"""The part of a coupling that is the same for every simulator: a body that follows the points of a cable, and forces for them.

Contact and friction are penalties. Their stiffness follows from the mass of a link and the time step. A solver that takes rows needs none.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import dartsweep as ds

Points = NDArray[np.float64]


class Law(NamedTuple):
    """How gaps become forces."""

    radius: float
    mass: float  # of a link
    time_step: float
    margin: float  # the gap at which a force begins; more than the cable moves in a step
    share: float = 0.2  # of a gap that is missing, or of the way back to the proxy: what the force makes good in a step
    friction: float = 0.1
    slip: float = 2e-3  # the speed from which friction is full

    @property
    def stiffness(self) -> float:
        return self.share * self.mass / self.time_step**2


class Proxy:
    """A chain through the points of a cable, which is free after every step."""

    def __init__(self, scene: ds.Scene, points: Points, law: Law) -> None:
        self.environment, self.law, self.before = scene.environment, law, points
        self.body = scene.create_body(points, [(i, i + 1) for i in range(len(points) - 1)])
        self.slide = ds.options(ds.MoveOptions, vertex_response=ds.Response.SLIDE, edge_response=ds.Response.SLIDE)
        self.least_gap, self.behind = np.inf, 0.0  # of all steps: of the proxy; of a point from its proxy

    def follow(self, points: Points) -> Points:
        """Moves to the points of the cable as far as walls allow. Returns a force for each of them."""
        velocity, self.before = (points - self.before) / self.law.time_step, points
        force = np.zeros_like(points)
        if self.body.move(points, self.slide).vertices_stopped:
            back = self.body.positions() - points
            self.behind = max(self.behind, float(np.sqrt((back**2).sum(axis=1).max())))
            force += self.law.stiffness * back
        rows = self.body.near_rows(self.law.margin, self.law.radius)
        return force + self.contact_forces(rows, velocity) if len(rows) else force

    def contact_forces(self, rows: NDArray[np.void], velocity: Points) -> Points:
        """The forces of near rows and of their friction."""
        law, count = self.law, len(velocity)
        self.least_gap = min(self.least_gap, float(rows["gap"].min()))
        weights = np.zeros((len(rows), count + 1))  # the last column takes what a row leaves unused
        weights[np.arange(len(rows))[:, None], np.minimum(rows["vertices"], count)] = rows["weights"]
        weights, normal = weights[:, :count], rows["normal"]
        moving = weights @ velocity
        rate = (moving * normal).sum(axis=1)
        push = law.stiffness * np.maximum(law.margin - rows["gap"] - law.time_step * rate, 0)
        along = moving - rate[:, None] * normal
        drag = law.friction * push / np.maximum(np.sqrt((along**2).sum(axis=1)), law.slip)
        return weights.T @ (push[:, None] * normal - drag[:, None] * along)

    def is_free(self) -> bool:
        """Casts every edge anew, through the environment alone."""
        at, volumes = self.body.positions(), self.body.volumes()
        flights = self.environment.cast_segments(at[:-1], at[1:], volumes[:-1])
        return bool((flights["outcome"] == ds.Outcome.REACHED).all() and (flights["volume"] == volumes[1:]).all())


def wrenches(points: Points, centres: Points, force: Points) -> Points:
    """Forces on the points of a chain as force and torque at the centre of each link. Two links that meet share the force on their joint."""
    part = force.copy()
    part[1:-1] /= 2
    arm, turn = points[:-1] - centres, part[:-1] - part[1:]  # the arm of the other end of a link is the opposite
    torque = arm[:, [1, 2, 0]] * turn[:, [2, 0, 1]] - arm[:, [2, 0, 1]] * turn[:, [1, 2, 0]]
    return np.hstack([part[:-1] + part[1:], torque])
