"""One insertion: a catheter is fed in at the inlet, bends, and slides along what it touches.

Quasi-static: in each step the base advances, lengths of links are restored and bends relaxed in NumPy, and the library moves the vertices there
as far as walls let them. Friction takes a share of the way of vertices that touched something in the step before.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

import dartsweep as ds

LINK = 0.8
FEED = 0.1  # of the base in one step
RELAXATIONS = 8


class Plan(NamedTuple):
    """What is varied."""

    angle_deg: float  # between the direction of feeding and the vessel's axis at the inlet
    stiffness: float  # share of a bend that is taken back in one relaxation, 0 to 0.5
    friction: float  # share of its way that a touching vertex loses, 0 to 1


class Outcome(NamedTuple):
    """What came of a plan."""

    angle_deg: float
    stiffness: float
    friction: float
    depth: float  # height that the tip has reached
    contacts: int
    steps: int
    success: bool


def relaxed(chain: np.ndarray, clamp: np.ndarray, stiffness: float) -> np.ndarray:
    """A chain, tip first, with bends relaxed and links of their length again. `clamp` is a point behind the base."""
    chain = np.vstack([chain, clamp])
    for _ in range(RELAXATIONS):
        bend = (chain[:-2] + chain[2:]) / 2 - chain[1:-1]
        chain[:-2] -= 0.5 * stiffness * bend
        chain[1:-2] += stiffness * bend[:-1]
        chain[2:-2] -= 0.5 * stiffness * bend[:-2]
    for upper in range(len(chain) - 3, -1, -1):  # from the base, which is where it is, to the tip
        link = chain[upper] - chain[upper + 1]
        chain[upper] = chain[upper + 1] + link * (LINK / np.sqrt(link @ link))
    return chain[:-1]


def insert(environment: ds.Environment, plan: Plan, depth: float, length: float) -> Outcome:
    """Feeds `length` of a catheter; success is a tip at height `depth`."""
    angle = np.radians(plan.angle_deg)
    direction = np.array([np.sin(angle), 0.0, np.cos(angle)])
    inlet = np.array([0.0, 0.0, 0.5])
    slide = ds.options(ds.MoveOptions, vertex_response=ds.Response.SLIDE, edge_response=ds.Response.SLIDE)
    contacts = steps = 0
    with ds.Scene(environment) as scene:
        body = scene.create_body([inlet + LINK * direction, inlet], [(0, 1)])
        fed = 0.0
        for steps in range(1, int(length / FEED) + 1):
            fed += FEED
            chain = body.positions()
            target = chain.copy()
            target[-1] = inlet + fed * direction
            target = relaxed(target, target[-1] - LINK * direction, plan.stiffness)
            touching = np.zeros(len(chain))
            touching[body.contacts()["vertex"]["index"]] = plan.friction
            body.move(chain + (target - chain) * (1 - touching)[:, None], slide)
            contacts += len(body.contacts())
            chain = body.positions()
            if chain[0, 2] >= depth:
                break
            if fed >= LINK:  # the next link comes in
                base = body.vertex_ids()[-1]
                body.add_edge(base, body.add_vertex(inlet))
                fed = 0.0
        tip = float(body.positions()[0, 2])
    return Outcome(*plan, tip, contacts, steps, tip >= depth)
