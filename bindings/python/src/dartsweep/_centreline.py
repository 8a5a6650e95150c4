"""The way through a vessel: a shortest path that keeps away from walls (the extra `rod`: SciPy)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .enums import Outcome
from .environment import Environment
from .errors import NotFound

Array = NDArray[np.float64]


def centreline(environment: Environment, start: ArrayLike | None = None, end: ArrayLike | None = None) -> Array:
    """A way through passable volumes, (n, 3), from the volume nearest to `start` to the one nearest to `end`. Without an end it is the volume
    that is farthest away, and without both, the two that are farthest from each other, and the way begins at the wider end.

    Every volume is asked for, one by one: some seconds for 100,000. The way keeps away from walls.
    """
    try:
        from scipy.sparse import csr_matrix
        from scipy.sparse.csgraph import connected_components, dijkstra
    except ImportError as error:
        raise ImportError("a centreline needs SciPy, which is in the extra `rod`: pip install dartsweep[rod]", name="scipy") from error

    ids: list[Any] = []
    numbers: dict[int, int] = {}
    pairs = []
    for index in range(environment.info.volume_index_count):
        try:
            volume = environment.volume_id(index)
        except NotFound:  # removed
            continue
        if not environment.is_impassable(volume):
            numbers[index] = len(ids)
            ids.append(volume)
    for number, volume in enumerate(ids):
        for local in range(environment.volume_counts(volume).faces):
            beside = environment.neighbour(volume, local)
            if not beside.impassable and beside.volume.index in numbers:
                pairs.append((number, numbers[beside.volume.index]))
    if not pairs:
        raise ValueError("a way needs two passable volumes that have a face in common")
    points = np.array([environment.centre(volume) for volume in ids])
    room = environment.find_nearest_to_points(points)["distance"]
    a, b = np.array(pairs).T
    cost = np.linalg.norm(points[a] - points[b], axis=1) / np.minimum(room[a], room[b]) ** 2
    graph = csr_matrix((cost, (a, b)), shape=(len(ids), len(ids)))
    lengths = csr_matrix((np.linalg.norm(points[a] - points[b], axis=1), (a, b)), shape=graph.shape)

    def nearest(to: ArrayLike) -> int:
        return int(np.linalg.norm(points - np.asarray(to, np.float64), axis=1).argmin())

    def farthest(number: int) -> int:
        distance = dijkstra(lengths, indices=number)
        return int(np.where(np.isfinite(distance), distance, -1).argmax())

    _, part = connected_components(graph)
    largest = int(np.flatnonzero(part == np.bincount(part).argmax())[0])
    first = nearest(start) if start is not None else farthest(farthest(largest) if end is None else nearest(end))
    last = nearest(end) if end is not None else farthest(first)
    _, before = dijkstra(graph, indices=first, return_predecessors=True)
    way = [last]
    while way[-1] != first:
        if before[way[-1]] < 0:
            raise ValueError("no way leads through passable volumes from the start to the end")
        way.append(int(before[way[-1]]))
    line = _smooth(environment, points[way[::-1]])
    room = environment.find_nearest_to_points(line)["distance"]
    skipped = 0 if start is not None else _skipped(line, room)
    kept = len(line) - (0 if end is not None else _skipped(line[::-1], room[::-1]))
    line, room = line[skipped:kept], room[skipped:kept]
    tenth = max(1, len(line) // 10)
    is_turned = start is None and end is None and room[-tenth:].mean() > room[:tenth].mean()
    return np.ascontiguousarray(line[::-1] if is_turned else line)


def length_of(way: ArrayLike) -> float:
    """The length of a line of points."""
    return float(_lengths(np.asarray(way, np.float64))[-1])


def place_on(way: ArrayLike, distance: float) -> Array:
    """The place on a line of points that is so far from its begin; its ends where it is not as long."""
    way = np.asarray(way, np.float64)
    lengths = _lengths(way)
    return np.array([np.interp(distance, lengths, way[:, k]) for k in range(way.shape[1])])


def nearest_on(way: Array, point: Array) -> float:
    """The length of a line of points up to its place that is nearest to a point."""
    piece = np.diff(way, axis=0)
    square = np.maximum((piece * piece).sum(axis=1), 1e-300)
    share = np.clip(((point - way[:-1]) * piece).sum(axis=1) / square, 0, 1)
    number = np.linalg.norm(way[:-1] + share[:, None] * piece - point, axis=1).argmin()
    return float(_lengths(way)[number] + share[number] * np.sqrt(square[number]))


def _lengths(way: Array) -> Array:
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))])


def _skipped(line: Array, room: Array) -> int:
    """How many points to leave out so that the way begins as far from the end of the vessel as from its sides."""
    way = _lengths(line)
    skipped = 0
    while skipped < len(line) - 3 and room[skipped + 1] > room[skipped] and way[skipped] < 1.5 * room[skipped + 1]:
        skipped += 1
    return skipped


def _smooth(environment: Environment, line: Array, sweeps: int = 10) -> Array:
    """Draws points to the middle of their neighbours where the pieces beside them stay free: first those of odd numbers, then the others."""
    line = line.copy()
    for sweep in range(2 * sweeps):
        moving = np.arange(1 + sweep % 2, len(line) - 1, 2)
        middle = 0.5 * line[moving] + 0.25 * (line[moving - 1] + line[moving + 1])
        is_free = np.ones(len(moving), bool)
        for beside in (line[moving - 1], line[moving + 1]):
            is_free &= environment.cast_segments(middle, beside)["outcome"] == Outcome.REACHED
        line[moving[is_free]] = middle[is_free]
    return line
