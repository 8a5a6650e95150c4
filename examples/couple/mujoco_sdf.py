"""The cable of mujoco_cable.py with MuJoCo's own contacts: mujoco_sdf.py [--links 40] [--steps 1000 5000]

The vessel is a tube with a thick wall, a geom of type sdf, which is hollow. Dartsweep only judges: it tells how many points of the cable are
still inside of the bore. A time step takes as long as 30 with the coupling.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

import dartsweep as ds
from mujoco_cable import LINK, SPEED, TIME_STEP, cable, cable_points
from vessel import BORE, LAYER, SIDES, Points, tube, winding_axis

OUTER = 5 / 3 * BORE  # radius of the outside of the wall


def thick_wall(axis: Points, tangent: Points, normal: Points) -> tuple[Points, NDArray[np.int64]]:
    """The surface of the wall: the bore, the outside, and rings at both ends."""
    angle = (2 * np.pi * np.arange(SIDES) / SIDES)[:, None]
    rings = [
        axis[k] + radius * (np.cos(angle) * normal[k] + np.sin(angle) * np.cross(tangent[k], normal[k]))
        for radius, layers in ((BORE, range(len(axis))), (OUTER, range(len(axis) - 1, -1, -1)))
        for k in layers
    ]
    side, turned = np.arange(SIDES), (np.arange(SIDES) + 1) % SIDES
    faces = []
    for k in range(len(rings)):  # the rings close a circle: in along the bore, and back outside
        a, b = SIDES * k, SIDES * ((k + 1) % len(rings))
        faces += [np.stack([a + side, b + side, b + turned], axis=1), np.stack([a + side, b + turned, a + turned], axis=1)]
    points, triangles = np.concatenate(rings), np.concatenate(faces)
    corners = points[triangles]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    return points, triangles if volume > 0 else triangles[:, ::-1]


def numbers(values: NDArray[np.generic]) -> str:
    return " ".join(map(repr, values.ravel().tolist()))


def run(links: int, marks: list[int]) -> Iterator[tuple[int, int, float]]:
    """After so many steps: their number, the points of the cable that are inside, and milliseconds of the processor for a step."""
    straight = links * LINK + LAYER
    frames = winding_axis(straight, SPEED * TIME_STEP * max(marks) + 4 * LAYER)
    points, triangles = thick_wall(*frames)
    asset = f'<asset><mesh name="vessel" vertex="{numbers(points)}" face="{numbers(triangles)}"/></asset>'
    model = cable(links, asset, '<geom type="sdf" mesh="vessel" contype="1" conaffinity="1"/>')
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    data.ctrl[0] = SPEED
    begin, done = time.process_time(), 0
    with ds.Environment(*tube(*frames)) as environment:
        for mark in sorted(marks):
            mujoco.mj_step(model, data, nstep=mark - done)
            done = mark
            _, locations = environment.locate_points(cable_points(data))
            yield mark, int(np.count_nonzero(locations != ds.Location.OUTSIDE)), 1e3 * (time.process_time() - begin) / max(done, 1)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--links", type=int, default=40)
    parser.add_argument("--steps", type=int, nargs="+", default=[1000, 5000])
    chosen = parser.parse_args()
    for mark, inside, cost in run(chosen.links, chosen.steps):
        print(f"{mark} steps: {inside} of {chosen.links + 1} points inside, {cost:.1f} ms a step", flush=True)
