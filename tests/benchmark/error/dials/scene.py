"""Environments, ropes and clocks for the curves of dials, and the format of the curves (../README.md)."""

from __future__ import annotations

import csv
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import dartsweep as ds

Array = NDArray[np.float64]
COLUMNS = "curve,method,setting,setting_unit,seconds_per_item,item,error_name,error,error_unit,count,note".split(",")


class Point(NamedTuple):
    """A row of a curve: one setting of a dial."""

    method: str
    setting: str
    unit: str
    seconds: float
    item: str
    error_name: str
    error: float
    error_unit: str
    count: int
    note: str = ""


class Curve(NamedTuple):
    name: str
    points: list[Point]
    advice: str

    def write(self, folder: Path) -> None:
        with open(folder / f"{self.name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(COLUMNS)
            for p in self.points:
                writer.writerow([self.name, *p[:3], f"{p.seconds:.6g}", p.item, p.error_name, f"{p.error:.6g}", *p[7:]])
        (folder / f"{self.name}.txt").write_text(self.advice + "\n", encoding="utf-8")

    def errors(self, method: str) -> list[float]:
        return [point.error for point in self.points if point.method == method]

    def best(self, method: str = "") -> Point:
        return min((p for p in self.points if p.method.startswith(method)), key=lambda p: (p.error, p.seconds))


def timed(call: Callable[[], Any]) -> tuple[Any, float]:
    """What a call returns, and how long the thread worked for it."""
    start = time.thread_time()
    made = call()
    return made, time.thread_time() - start


def lattice(cubes: Iterable[int], side: float = 1.0) -> tuple[Array, NDArray[np.int64]]:
    """Points and hexahedra of a block of cubes. Point (i, j, k) has the index (i (ny + 1) + j) (nz + 1) + k."""
    nx, ny, nz = cubes
    points = np.stack(np.meshgrid(*(np.arange(n + 1) for n in (nx, ny, nz)), indexing="ij"), -1).reshape(-1, 3) * side
    i, j, k = (each.ravel() for each in np.meshgrid(range(nx), range(ny), range(nz), indexing="ij"))

    def at(a: int, b: int, c: int) -> NDArray[np.int64]:
        return ((i + a) * (ny + 1) + j + b) * (nz + 1) + k + c

    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    return points.astype(np.float64), np.stack([at(*corner) for corner in corners], -1)


def blocks(cubes: int = 8, share: float = 0.1, seed: int = 1) -> ds.Environment:
    """A lattice in which single cubes, a share of them, are impassable."""
    points, cells = lattice((cubes,) * 3)
    environment = ds.Environment(points, cells)
    marked = np.random.default_rng(seed).permutation(len(cells))[: int(share * len(cells))]
    environment.mark_volumes([environment.volume_id(int(index)) for index in marked])
    return environment


class Move(NamedTuple):
    """A rope, and where its vertices should go; each of them can go there for itself."""

    start: Array
    target: Array


def chain(count: int) -> NDArray[np.uint32]:
    return np.stack([np.arange(count - 1), np.arange(1, count)], -1).astype(np.uint32)


def can_go(environment: ds.Environment, start: Array, target: Array) -> NDArray[np.bool_]:
    flights = environment.cast_segments(start, target)
    return np.asarray(flights["outcome"] == ds.Outcome.REACHED)


def ropes(environment: ds.Environment, count: int, seed: int = 2, vertices: int = 9, step: float = 1.0) -> Iterator[Move]:
    """Ropes with edges of 0.4 that are free, and ways of about a step that are free for each vertex alone, though not for the edges."""
    random = np.random.default_rng(seed)
    upper = environment.points().max(axis=0)
    with ds.Scene(environment) as scene:
        while count > 0:
            axis = random.normal(size=3)
            line = random.uniform(0.05, upper - 0.05) + np.arange(vertices)[:, None] * 0.4 * axis / np.linalg.norm(axis)
            line += random.uniform(-0.05, 0.05, line.shape)
            if (line < 0.02).any() or (line > upper - 0.02).any():
                continue
            try:
                scene.create_body(line, chain(vertices)).destroy()
            except ds.Error:
                continue
            aim = line + step * (random.normal(size=3) + 0.4 * random.normal(size=line.shape))
            for _ in range(5):
                free = can_go(environment, line, aim)
                aim = np.where(free[:, None], aim, (line + aim) / 2)
            free = can_go(environment, line, aim)
            if free.all():
                count -= 1
                yield Move(line, aim)


def move_all(scene: ds.Scene, moves: list[Move], options: ds.MoveOptions, level: int = ds.Level.EDGES_SWEPT) -> tuple[float, float, list[Array]]:
    """Seconds for a move, the share of the ways that was not made, and where the ropes came to lie."""
    seconds, way, left, places = 0.0, 0.0, 0.0, []
    for move in moves:
        body = scene.create_body(move.start, chain(len(move.start)), level=level)
        _, took = timed(lambda: body.move(move.target, options))
        at = body.positions()
        seconds += took
        way += float(np.linalg.norm(move.target - move.start, axis=1).sum())
        left += float(np.linalg.norm(move.target - at[: len(move.start)], axis=1).sum())
        places.append(at)
        body.destroy()
    return seconds / len(moves), left / way, places
