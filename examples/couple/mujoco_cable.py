"""A MuJoCo cable is pushed through a vessel that winds in space: mujoco_cable.py [--links 40 100 200] [--steps 8000] [--speed 0.015]

The points of the cable are the vertices of a Dartsweep body, the proxy. After each mj_step the proxy moves to these points. A vertex that meets a
wall slides along it, so the proxy is free after every step. Near rows of the proxy become contact forces with friction. Where the proxy is left
behind, a spring pulls the cable back to it.
"""

from __future__ import annotations

import argparse
import time
from typing import NamedTuple

import mujoco
import numpy as np

import dartsweep as ds
from proxy import Law, Points, Proxy, wrenches
from vessel import LAYER, tube, winding_axis

LINK, RADIUS, START = 5e-3, 0.5e-3, "2e-4 3e-4 1e-3"  # of the cable; metres, kilograms, seconds
TIME_STEP, SPEED = 1e-3, 15e-3
MARGIN = 0.1e-3

MODEL = """<mujoco>
  <option timestep="{step}" gravity="0 0 0" integrator="implicitfast"/>
  <default><default class="link"><geom type="capsule" fromto="0 0 0 0 0 {link}" size="{radius}" density="6000" contype="0"/>
    <joint stiffness="3e-5" damping="3e-6"/></default></default>
  {asset}
  <worldbody>{wall}<body childclass="link"><joint name="feed" type="slide" axis="0 0 1" stiffness="0" damping="0" armature="1e-3"/>
    <inertial pos="0 0 0" mass="1e-3" diaginertia="1e-9 1e-9 1e-9"/>{links}</body></worldbody>
  <actuator><velocity joint="feed" kv="10"/></actuator>
</mujoco>"""


class Outcome(NamedTuple):
    """What came of an insertion."""

    links: int
    steps: int
    free_steps: int  # after which all edges of the proxy were cast again, and met nothing
    depth: float  # of the tip, along the part of the vessel that winds
    least_gap: float  # of the proxy
    behind: float  # the farthest that a point of the cable was from its proxy
    step_seconds: float  # of the processor, in mj_step
    coupling_seconds: float


def cable(links: int, asset: str = "", wall: str = "") -> mujoco.MjModel:
    """Capsules on ball joints that resist bending; the first one is fed in along z."""
    nested = "".join(f'<body pos="{f"0 0 {LINK}" if i else START}"><joint type="ball"/><geom/>' for i in range(links))
    values = {"step": TIME_STEP, "link": LINK, "radius": RADIUS, "asset": asset, "wall": wall}
    return mujoco.MjModel.from_xml_string(MODEL.format(links=nested + "</body>" * links, **values))


def cable_points(data: mujoco.MjData) -> Points:
    """The joints and the tip. Body 0 is the world, and body 1 is fed in."""
    starts = data.xpos[2:]
    return np.vstack([starts, 2 * data.xipos[-1] - starts[-1]])


def insert(links: int, steps: int, speed: float = SPEED) -> Outcome:
    straight = links * LINK + LAYER
    frames = winding_axis(straight, speed * TIME_STEP * steps + 4 * LAYER)
    with ds.Environment(*tube(*frames)) as environment, ds.Scene(environment) as scene:
        environment.check()
        model = cable(links)
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        data.ctrl[0] = speed
        proxy = Proxy(scene, cable_points(data), Law(RADIUS, float(model.body_mass[-1]), TIME_STEP, MARGIN))
        free = stepping = coupled = 0
        for _ in range(steps):
            begin = time.thread_time_ns()
            mujoco.mj_step(model, data)
            stepped = time.thread_time_ns()
            points = cable_points(data)
            data.xfrc_applied[2:] = wrenches(points, data.xipos[2:], proxy.follow(points))
            coupled += time.thread_time_ns() - stepped
            stepping += stepped - begin
            free += proxy.is_free()
        tip = proxy.body.positions()[-1]
        depth = LAYER * float(((frames[0] - tip) ** 2).sum(axis=1).argmin()) - straight
    return Outcome(links, steps, free, depth, proxy.least_gap, proxy.behind, 1e-9 * stepping, 1e-9 * coupled)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--links", type=int, nargs="+", default=[40, 100, 200])
    parser.add_argument("--steps", type=int, default=8000)
    parser.add_argument("--speed", type=float, default=SPEED)
    chosen = parser.parse_args()
    for outcome in (insert(count, chosen.steps, chosen.speed) for count in chosen.links):
        ratio = outcome.coupling_seconds / outcome.step_seconds
        print(*(f"{name} {value:.6g}" for name, value in outcome._asdict().items()), f"ratio {ratio:.2f}", sep=", ", flush=True)
