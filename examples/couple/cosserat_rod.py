"""Dartsweep's rod as a solver of cosseratbench (PyPI), which compares simulations of ropes and rods with known answers:

    python examples/couple/cosserat_rod.py [SCENE ...] [--solver dartsweep pyelastica]

Walls are cells that are left out of a mesh of the space; rods keep off them, off each other and off themselves by rows of near things.
"""

from __future__ import annotations

import argparse
import math
import time
from typing import Any

import numpy as np
from cosseratbench import experiment as bench
from cosseratbench import registry
from cosseratbench.scenario import Cylinder, End, EndCondition, Plane, Rod, Scenario
from cosseratbench.solver import Capability
from cosseratbench.trajectory import Trajectory
from numpy.typing import NDArray

import dartsweep as ds
from dartsweep import rod

Array = NDArray[np.float64]

GHOST = 1e-3  # of an edge: a clamp is an edge more, so short that the rod bends from its first node on
SIDES, LAYERS = 96, 4  # of a cylinder
STEPS = {"free": 2e-3, "settles": 1e-2, "touches": 5e-3, "heaps": 1e-3}  # s
CUBE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)


def room(scenario: Scenario) -> ds.Environment:
    """The space round the rods, without its obstacles: a floor is the bottom of a box, and a cylinder a hole in it."""
    points = np.concatenate([np.asarray(each.centerline) for each in scenario.rods])
    size = 2 * max(each.length for each in scenario.rods) + float(np.ptp(points, axis=0).max())
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    if not scenario.obstacles:
        return ds.Environment(middle + 4 * size * (CUBE - 0.5), [range(8)])
    if len(scenario.obstacles) > 1:
        raise NotImplementedError("more than one obstacle")
    wall = scenario.obstacles[0]
    if isinstance(wall, Plane):
        normal = wall.unit_normal
        across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
        across /= np.linalg.norm(across)
        frame = np.stack([across, np.cross(normal, across), normal])
        foot = middle - ((middle - wall.point) @ normal) * normal
        return ds.Environment(foot + 4 * size * (CUBE - [0.5, 0.5, 0]) @ frame, [range(8)])
    assert isinstance(wall, Cylinder)
    return ds.Environment(*round_cylinder(wall, size), flags=ds.EnvironmentFlag.REORIENT)


def round_cylinder(wall: Cylinder, size: float) -> tuple[Array, NDArray[np.int64]]:
    """Tetrahedra between a cylinder and a box. The cylinder ends at the box."""
    axis = wall.unit_axis
    across = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    across /= np.linalg.norm(across)
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    out = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * np.cross(axis, across)
    along = np.linspace(-wall.length / 2, wall.length / 2, LAYERS + 1)
    points = np.asarray(wall.center) + along[:, None, None, None] * axis + np.array([wall.radius, 2 * wall.radius, 2 * size])[:, None, None] * out
    index = np.arange(points.size // 3).reshape(points.shape[:3])
    cells = []
    for tall in (index[:-1], index[1:]), :
        low, high = tall
        for ring in range(2):
            a, b = (low[:, ring], low[:, ring + 1]), (high[:, ring], high[:, ring + 1])
            turned = [np.roll(each, -1, axis=1) for each in (*a, *b)]
            for bottom, top in (((a[0], turned[0], turned[1]), (b[0], turned[2], turned[3])), ((a[0], turned[1], a[1]), (b[0], turned[3], b[1]))):
                wedge = np.stack([np.stack(bottom, axis=-1).reshape(-1, 3), np.stack(top, axis=-1).reshape(-1, 3)], axis=1)
                order = wedge[:, 0].argsort(axis=1)  # of a column of points the lower number first: neighbours are cut alike
                p, q = (np.take_along_axis(wedge[:, k], order, axis=1) for k in range(2))
                cells += [np.stack(each, axis=1) for each in ((p[:, 0], p[:, 1], p[:, 2], q[:, 2]), (p[:, 0], p[:, 1], q[:, 2], q[:, 1]), (p[:, 0], q[:, 0], q[:, 1], q[:, 2]))]
    return points.reshape(-1, 3), np.concatenate(cells)


class Held:
    """A rod of the scene with its ends, as the benchmark wants them."""

    def __init__(self, scene: ds.Scene, spec: Rod, scenario: Scenario, elements: int, damping: float) -> None:
        nodes, segment = spec.nodes(elements), spec.length / elements
        clamps = [spec.condition(end) is EndCondition.CLAMPED for end in End]
        self.spec, self.first, self.last = spec, int(clamps[0]), int(clamps[0]) + elements
        points = np.concatenate([
            [nodes[0] + GHOST * (nodes[0] - nodes[1])] if clamps[0] else np.empty((0, 3)), nodes,
            [nodes[-1] + GHOST * (nodes[-1] - nodes[-2])] if clamps[1] else np.empty((0, 3)),
        ])
        area, bend, material = spec.area, spec.second_moment_of_area, spec.material
        self.rod = wire = rod.Rod(
            scene, points=points, radius=spec.radius, bending=material.youngs_modulus * bend, stretching=material.youngs_modulus * area,
            twisting=2 * material.shear_modulus * bend, density=material.density * area, drag=damping,
            friction=max([spec.friction, *(each.friction for each in scenario.obstacles)]), meets_itself=scenario.self_contact,
        )
        wire.rest_length[self.first : self.last] = segment
        wire.mass[:] = 1e-6 * material.density * area * segment
        wire.mass[self.first : self.last + 1] = material.density * area * segment
        wire.mass[[self.first, self.last]] /= 2
        wire.directors[self.first : self.last] = spec.directors(elements)
        wire.directors[0], wire.directors[-1] = wire.directors[self.first], wire.directors[self.last - 1]
        self.load = wire.mass[:, None] * np.asarray(scenario.gravity)
        for load in spec.loads:
            self.load[self.first if load.at is End.START else self.last] += load.force
        wire.load[:] = self.load
        for end, node, ghost in ((End.START, self.first, 0), (End.END, self.last, -1)):
            if spec.condition(end) is not EndCondition.FREE:
                wire.held[[node, ghost]] = True
            if spec.condition(end) is EndCondition.CLAMPED:
                wire.held_turn[ghost] = True
        self.start = points.copy()
        self.slid = 0.0

    def lead(self, now: float, dt: float) -> None:
        """Velocities of ends that are driven."""
        for end, node, ghost in ((End.START, self.first, 0), (End.END, self.last, -1)):
            motion = self.spec.motion(end)
            if motion is None:
                continue
            moved, turned = motion.pose(now + dt)
            for vertex in (node, ghost):
                target = self.start[node] + moved + turned @ (self.start[vertex] - self.start[node])
                if motion.slides_along is not None:
                    target = target + self.slid_by(motion.axis, dt) * motion.axis
                self.rod.velocity[vertex] = (target - self.rod.positions[vertex]) / dt
            way = self.start[-1] - self.start[-2] if end is End.END else self.start[1] - self.start[0]
            _, rate = motion.rates(now + dt / 2)
            turn = float(rate @ way) / float(np.linalg.norm(way))
            if end is End.END:
                self.rod.turned += turn * dt
            else:
                self.rod.spin[0] = turn

    def slid_by(self, axis: Array, dt: float) -> float:
        """How far an end that slides along an axis has gone: to where the rod pulls as hard as the load. In a step only as much of the rod
        gives way as a sound in it comes along."""
        wire = self.rod
        edge = wire.positions[self.last] - wire.positions[self.last - 1]
        length = float(np.linalg.norm(edge))
        pull = wire.stretching[self.last - 1] * (length / wire.rest_length[self.last - 1] - 1) * float(edge @ axis) / length
        sound = math.sqrt(self.spec.material.youngs_modulus / self.spec.material.density)
        stiffness = wire.stretching[self.last - 1] / min(self.spec.length, max(sound * dt, wire.segment))
        self.slid += 0.25 * (float(self.load[self.last] @ axis) - pull) / stiffness
        return self.slid


class DartsweepSolver:
    """The adapter: an entry point of the group cosseratbench.solvers may name this class."""

    name = "dartsweep"
    backend_version = ds.__version__
    capabilities = frozenset({
        Capability.STRETCH, Capability.ROD_CONTACT, Capability.ROD_FRICTION, Capability.CYLINDER_CONTACT, Capability.PLANE_CONTACT,
    })

    def __init__(self, time_step_scale: float = 1.0) -> None:
        self.scale = time_step_scale

    def _numbers(self, scenario: Scenario, n_frames: int) -> tuple[int, float, float]:
        """Steps of a frame, the time step, and drag."""
        touches = bool(scenario.obstacles) or len(scenario.rods) > 1
        kind = "free" if not scenario.quasi_static else "heaps" if scenario.self_contact and scenario.obstacles else "touches" if touches else "settles"
        frame = scenario.duration / (n_frames - 1)
        steps = math.ceil(frame / (self.scale * STEPS[kind]))
        return steps, frame / steps, 2 * scenario.slowest_frequency() if scenario.quasi_static else 0.0

    def settings(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> dict[str, Any]:
        _, dt, drag = self._numbers(scenario, n_frames)
        return {"integrator": "implicit Euler" if scenario.quasi_static else "implicit midpoint", "time_step": dt, "damping_rate": drag}

    def run(self, scenario: Scenario, *, n_elements: int, n_frames: int) -> Trajectory:
        steps, dt, drag = self._numbers(scenario, n_frames)
        features = ds.Feature.BODY_CONTACTS if scenario.self_contact or len(scenario.rods) > 1 else 0
        with room(scenario) as environment, ds.Scene(environment, features) as scene:
            held = [Held(scene, spec, scenario, n_elements, drag) for spec in scenario.rods]
            frames = [[each.rod.positions[each.first : each.last + 1].copy()] for each in held]
            turned = [[each.rod.directors[each.first : each.last].copy()] for each in held]
            wires, now = [each.rod for each in held], 0.0
            for _ in range(n_frames - 1):
                for _ in range(steps):
                    if scenario.quasi_static:
                        for each in held:
                            each.lead(now, dt)
                        rod.step(wires, dt)
                    else:
                        midpoint(wires, dt)
                    now += dt
                for each, history, directors in zip(held, frames, turned):
                    history.append(each.rod.positions[each.first : each.last + 1].copy())
                    directors.append(each.rod.directors[each.first : each.last].copy())
        times = np.linspace(0, scenario.duration, n_frames)
        return Trajectory(times, tuple(np.stack(each) for each in frames), tuple(np.stack(each) for each in turned))


def midpoint(wires: list[rod.Rod], dt: float) -> None:
    """A step that keeps the energy of small motions: half a step of implicit Euler, and as far again. For rods that meet nothing."""
    before = [(wire.positions.copy(), wire.velocity.copy()) for wire in wires]
    rod.step(wires, dt / 2)
    for wire, (positions, velocity) in zip(wires, before):
        wire.positions[:] = 2 * wire.positions - positions
        wire.velocity[:] = 2 * wire.velocity - velocity


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("scenes", nargs="*", default=[])
    parser.add_argument("--solver", nargs="+", default=["dartsweep"])
    chosen = parser.parse_args()
    for scene_name in chosen.scenes or registry.names(registry.EXPERIMENTS):
        for solver_name in chosen.solver:
            solver = DartsweepSolver() if solver_name == "dartsweep" else registry.load_solver(solver_name)
            begin, result = time.process_time(), bench.run(registry.load_experiment(scene_name), solver)
            told = {**result.metrics, **result.observations}
            print(scene_name, solver_name, result.outcome, result.failure or "", f"{time.process_time() - begin:.1f} s of the processor",
                  *(f"{name} {value:.3g}" for name, value in told.items() if np.isfinite(value)), sep=", ", flush=True)
