"""A cord of Newton is pushed through a vessel that winds in space, on the processor: newton_cord.py [--links 20] [--steps 1000]

The cord is a rod of SolverVBD. The coupling is that of mujoco_cable.py: after each step of the solver the proxy follows, and its forces go to
State.body_f for the next step. Newton itself needs no collision pipeline.
"""

from __future__ import annotations

import argparse

import newton
import numpy as np
import warp as wp
from numpy.typing import NDArray

import dartsweep as ds
from proxy import Law, Points, Proxy, wrenches
from vessel import LAYER, tube, winding_axis

LINK, RADIUS, START = 5e-3, 0.5e-3, np.array([2e-4, 3e-4, 1e-3])  # metres, kilograms, seconds
TIME_STEP, SPEED = 1e-3, 0.03
MARGIN = 0.1e-3


def cord(links: int) -> newton.Model:
    """A straight rod along z, whose first link moves as it is told."""
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    builder.default_shape_cfg.density = 6000.0
    builder.inertia_absolute_tolerance = 1e-20  # Newton would raise moments below 1e-10 kg m2 to 1e-6
    rod = newton.Rod(START + LINK * np.arange(links + 1)[:, None] * [0.0, 0.0, 1.0], radius=RADIUS)
    bodies, _ = builder.add_rod(rod=rod, stretch_stiffness=1e3, bend_stiffness=3e-5, bend_damping=3e-6)
    builder.body_mass[bodies[0]] = builder.body_inv_mass[bodies[0]] = 0.0
    builder.body_inertia[bodies[0]] = builder.body_inv_inertia[bodies[0]] = wp.mat33(0.0)
    builder.color()
    return builder.finalize(device="cpu")


def cord_points(places: NDArray[np.float32]) -> Points:
    """The starts of the links and the tip: half a link from the centres, along the links' own z."""
    centre, (x, y, z, w) = places[:, :3].astype(float), places[:, 3:].astype(float).T
    half = LINK / 2 * np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)
    return np.vstack([centre - half, centre[-1] + half[-1]])


def insert(links: int, steps: int) -> tuple[int, float, Proxy]:
    """Steps after which the proxy was free, how far the tip has come along the part that winds, and the proxy."""
    straight = links * LINK + LAYER
    frames = winding_axis(straight, SPEED * TIME_STEP * steps + 4 * LAYER)
    with ds.Environment(*tube(*frames)) as environment, ds.Scene(environment) as scene:
        model = cord(links)
        solver, state, after = newton.solvers.SolverVBD(model, iterations=10), model.state(), model.state()
        control, base, free = model.control(), float(state.body_q.numpy()[0, 2]), 0
        proxy = Proxy(scene, cord_points(state.body_q.numpy()), Law(RADIUS, float(model.body_mass.numpy()[1]), TIME_STEP, MARGIN))
        for step in range(1, steps + 1):
            for each in (state, after):
                each.body_q.numpy()[0, 2] = base + SPEED * TIME_STEP * step  # on the processor numpy() is no copy
            solver.step(state, after, control, None, TIME_STEP)
            state, after = after, state
            places = state.body_q.numpy()
            points = cord_points(places)
            state.body_f.assign(wrenches(points, places[:, :3], proxy.follow(points)))
            free += proxy.is_free()
        tip = proxy.body.positions()[-1]
        return free, LAYER * float(((frames[0] - tip) ** 2).sum(axis=1).argmin()) - straight, proxy


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--links", type=int, default=20)
    parser.add_argument("--steps", type=int, default=1000)
    chosen = parser.parse_args()
    free_steps, depth, proxy = insert(chosen.links, chosen.steps)
    print(f"free steps {free_steps} of {chosen.steps}, depth {depth:.3g}, least gap {proxy.least_gap:.3g}, behind {proxy.behind:.3g}")
