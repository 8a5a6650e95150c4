#!/usr/bin/env python3
"""Steps of solvers: dsw_scene_step_fraction beside ipctk's compute_collision_free_stepsize, on the same meshes and in one process.

usage: beside_ipctk.py [--steps 200] [--planted 10000] [--out keys.json]

Expected, written before the first run: nothing crosses; no step is shorter than ipctk's, which is a lower bound that its tolerance of 1e-6
and its rescaling make smaller; ipctk takes at least ten times as long in the median, since it builds its tree anew and subdivides each pair
that comes near, and a hundred times in one of a hundred steps, where a touch comes late on the way of a pair that moves side by side.

Times are of the processor, of all threads (ipctk has some, dsw_scene_step_fraction has one). Where a step is not free as a whole, both go on
from 0.8 of what is free, as solvers with a barrier do: beside gaps of some roundings, where we end just before a touch, one question to
ipctk did not end within 200 s.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterator

import ipctk
import numpy as np

import dartsweep as ds

Mesh = tuple[np.ndarray, np.ndarray, np.ndarray]  # vertices, edges, faces
HALF = 4.0  # of the room that all is in


def edges_of(faces: np.ndarray) -> np.ndarray:
    sides = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return np.unique(sides, axis=0)


def grid_faces(rows: int, columns: int, closed: bool = False) -> np.ndarray:
    faces = []
    for i in range(rows - 1):
        for k in range(columns if closed else columns - 1):
            a, b = i * columns + k, i * columns + (k + 1) % columns
            faces += [(a, b, a + columns), (b, b + columns, a + columns)]
    return np.array(faces, np.int32)


def cloth(n: int) -> Mesh:
    x = np.linspace(-1, 1, n)
    points = np.array([(a, b, 0.0) for a in x for b in x])
    faces = grid_faces(n, n)
    return points, edges_of(faces), faces


def sphere(n: int, radius: float) -> Mesh:
    """A ball without poles: rings that are closed by fans."""
    heights = np.linspace(-0.97, 0.97, n)
    points = [(np.sqrt(1 - z * z) * np.cos(a), np.sqrt(1 - z * z) * np.sin(a), z) for z in heights for a in np.linspace(0, 2 * np.pi, 2 * n, False)]
    points += [(0, 0, -1), (0, 0, 1)]
    faces = grid_faces(n, 2 * n, True).tolist()
    low, high, last = len(points) - 2, len(points) - 1, (n - 1) * 2 * n
    for k in range(2 * n):
        faces += [(low, (k + 1) % (2 * n), k), (high, last + k, last + (k + 1) % (2 * n))]
    made = np.array(faces, np.int32)
    return radius * np.array(points), edges_of(made), made


def strand(n: int, side: float) -> Mesh:
    t = np.linspace(-2, 2, n)
    points = np.stack([side * np.cos(2 * t), side * np.sin(2 * t), t], axis=1)
    return points, np.array([(i, i + 1) for i in range(n - 1)], np.int32), np.empty((0, 3), np.int32)


def tube(rings: int, around: int) -> Mesh:
    angles = np.linspace(0, 2 * np.pi, around, False)
    points = np.array([(0.5 * np.cos(a), 0.5 * np.sin(a), z) for z in np.linspace(-2, 2, rings) for a in angles])
    faces = grid_faces(rings, around, True)
    return points, edges_of(faces), faces


class Case:
    """Bodies of a scene, and one mesh of them all for ipctk."""

    def __init__(self, meshes: list[Mesh]) -> None:
        corners = [(x, y, z) for x, y, z in np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]) * HALF]
        self.scene = ds.Scene(ds.Environment(corners, [range(8)]), features=ds.Feature.BODY_CONTACTS)
        self.bodies = [
            self.scene.create_body(p, edges, triangles=faces if len(faces) else None, level=ds.Level.FACES if len(faces) else ds.Level.EDGES,
                                   flags=ds.BodyFlag.SELF_CONTACTS)
            for p, edges, faces in meshes
        ]
        self.ids = [each.id for each in self.bodies]
        first = np.cumsum([0] + [len(each[0]) for each in meshes])
        self.points = np.vstack([each[0] for each in meshes])
        self.edges = np.vstack([each[1] + k for each, k in zip(meshes, first)]).astype(np.int32)
        self.faces = np.vstack([each[2] + k for each, k in zip(meshes, first)]).astype(np.int32)
        self.mesh = ipctk.CollisionMesh(self.points, self.edges, self.faces)

    def ours(self, steps: np.ndarray) -> tuple[float, np.ndarray, float]:
        start = time.process_time()
        found = self.scene.step_fraction(self.ids, steps)
        return found.fraction, found.places, time.process_time() - start

    def theirs(self, steps: np.ndarray) -> tuple[float, float]:
        first, last = np.asfortranarray(self.points), np.asfortranarray(self.points + steps)
        start = time.process_time()
        fraction = ipctk.compute_collision_free_stepsize(self.mesh, first, last)
        return fraction, time.process_time() - start

    def crosses(self, end: np.ndarray) -> bool:
        """Whether anything touches on the way, exactly. Pairs that may are those of ipctk's broad phase."""
        candidates = ipctk.Candidates()
        candidates.build(self.mesh, self.points, end)
        pairs = [(ds.PairKind.EDGE_EDGE, *self.edges[c.edge0_id], *self.edges[c.edge1_id]) for c in candidates.ee_candidates]
        pairs += [(ds.PairKind.VERTEX_FACE, c.vertex_id, *self.faces[c.face_id]) for c in candidates.fv_candidates]
        if not pairs:
            return False
        rows = np.array(pairs)
        touches = ds.sweep_pairs(self.points[rows[:, 1:]], end[rows[:, 1:]], rows[:, 0])
        return bool((touches["touches"] != 0).any())

    def go(self, end: np.ndarray) -> None:
        made = self.scene.move_together(self.ids, end)
        assert (made["fraction"] == 1).all()
        self.points = end


def springs(points: np.ndarray, rest: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """What pulls edges to their lengths."""
    way = points[edges[:, 1]] - points[edges[:, 0]]
    length = np.linalg.norm(way, axis=1, keepdims=True)
    pull = 0.2 * way * (1 - rest[:, None] / length)
    step = np.zeros_like(points)
    np.add.at(step, edges[:, 0], pull)
    np.add.at(step, edges[:, 1], -pull)
    return step


def lengths(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    return np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1)


def cloth_on_a_sphere(rng: np.random.Generator, steps: int) -> Iterator[tuple[Case, np.ndarray]]:
    """Falls, rests, and is begun again every 50 steps: gaps near rounding take all memory in ipctk."""
    for k in range(steps):
        if k % 50 == 0:
            sheet, ball = cloth(41), sphere(15, 0.8)
            sheet[0][:, 2] = 0.805 + 0.01 * rng.random(len(sheet[0]))
            case, count, rest = Case([sheet, ball]), len(sheet[0]), lengths(sheet[0], sheet[1])
        step = np.zeros_like(case.points)
        points = case.points[:count]
        step[:count] = springs(points, rest, sheet[1]) + 0.002 * rng.standard_normal((count, 3)) - [0, 0, 0.02]
        away = np.linalg.norm(points, axis=1)
        near = away < 0.83
        step[:count][near] += points[near] * (0.83 - away[near])[:, None] * 1.1 / 0.8
        yield case, step


def two_strands(rng: np.random.Generator, steps: int) -> Iterator[tuple[Case, np.ndarray]]:
    meshes = [strand(200, 0.3), strand(200, -0.3)]
    case = Case(meshes)
    for k in range(steps):
        to_axis = -case.points * [1, 1, 0]
        turn = np.stack([-case.points[:, 1], case.points[:, 0], 0 * case.points[:, 2]], axis=1)
        step = (0.05 if k % 20 < 12 else -0.02) * to_axis + 0.1 * turn + 0.002 * rng.standard_normal(case.points.shape)
        yield case, step


def squeezed_tube(rng: np.random.Generator, steps: int) -> Iterator[tuple[Case, np.ndarray]]:
    """Pressed flat from two sides, and begun again every 20 steps."""
    for k in range(steps):
        if k % 20 == 0:
            mesh = tube(60, 32)
            case, rest = Case([mesh]), lengths(mesh[0], mesh[1])
        flat = np.zeros_like(case.points)
        share = np.exp(-4 * case.points[:, 2] ** 2)
        flat[:, 1] = -0.05 * share * np.sign(case.points[:, 1])
        yield case, flat + 0.5 * springs(case.points, rest, mesh[1]) + 0.001 * rng.standard_normal(case.points.shape)


def planted(rng: np.random.Generator, steps: int) -> Iterator[tuple[Case, np.ndarray]]:
    """Two strips side by side that go a long way together, and touch late."""
    meshes = []
    for z in (0.0, 0.3):
        points, edges, faces = cloth(5)
        meshes.append((0.5 * points + [0, 0, z] + 0.02 * rng.standard_normal(points.shape), edges, faces))
    case = Case(meshes)
    count = len(meshes[0][0])
    for _ in range(steps):
        way = rng.standard_normal(3)
        step = np.tile(way / np.linalg.norm(way), (2 * count, 1)) + 0.01 * rng.standard_normal((2 * count, 3))
        v = rng.integers(count)
        low, high = case.points[:count], case.points[count:]
        # One vertex passes what is above it just before the end.
        late = 1 - 10 ** rng.uniform(-9, -1)
        face = meshes[1][2][rng.integers(len(meshes[1][2]))]
        shares = rng.dirichlet((1, 1, 1))
        step[v] = (shares @ (high[face] + step[count:][face] * late) - low[v]) / late
        yield case, step


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--planted", type=int, default=10000)
    parser.add_argument("--out")
    options = parser.parse_args()
    keys: dict[str, float] = {"step.crossed": 0, "step.shorter_than_ipctk": 0}
    all_ratios: list[float] = []
    for name, make, steps in (
        ("cloth_on_a_sphere", cloth_on_a_sphere, options.steps),
        ("two_strands", two_strands, options.steps),
        ("squeezed_tube", squeezed_tube, options.steps),
        ("planted", planted, options.planted),
    ):
        ratios, times, stopped = [], [], 0
        rng = np.random.default_rng(5)
        for k, (case, step) in enumerate(make(rng, steps)):
            fraction, places, seconds = case.ours(step)
            theirs, their_seconds = case.theirs(step)
            ratios.append(their_seconds / seconds)
            times.append((seconds, their_seconds))
            stopped += fraction < 1
            keys["step.shorter_than_ipctk"] += fraction < theirs - 1e-9
            if name != "planted" or k % 10 == 0:
                keys["step.crossed"] += case.crosses(places)
            assert fraction == 1 or name != "planted" or case.crosses(case.points + np.nextafter(fraction, 1) * step) or k % 10
            if name != "planted":
                case.go(places if fraction == 1 else case.points + 0.8 * fraction * step)
        seconds = np.array(times)
        all_ratios += ratios
        keys[f"step.vs_ipctk.{name}.median"] = float(np.median(ratios))
        keys[f"step.vs_ipctk.{name}.p99"] = float(np.percentile(ratios, 99))
        print(f"{name}: {steps} steps, {stopped} stop; ours {1e3 * np.median(seconds[:, 0]):.3f} ms, ipctk {1e3 * np.median(seconds[:, 1]):.3f} ms in the "
              f"median; ipctk takes {np.median(ratios):.1f} times as long, 99th percentile {np.percentile(ratios, 99):.1f}", flush=True)
    keys["step.vs_ipctk.median"], keys["step.vs_ipctk.p99"] = float(np.median(all_ratios)), float(np.percentile(all_ratios, 99))
    for key, value in keys.items():
        print(f"{key} {value:g}")
    if options.out:
        with open(options.out, "w") as file:
            json.dump(keys, file, indent=1)


if __name__ == "__main__":
    main()
