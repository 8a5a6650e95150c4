"""Errors, and what all modules of this package do with arrays of points and triangles."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Indices = NDArray[np.int64]


class Refused(Exception):
    """The surface can't be filled; the text says why."""


class Mendable(Refused):
    """A repair may help."""


def at(place: Points) -> str:
    return "({:g}, {:g}, {:g})".format(*place)


def merged(place: Points, rows: NDArray[Any]) -> tuple[Points, Indices]:
    """The arrays, checked: of points at the same place the first, and triangles that have three points."""
    if rows.size == 0:
        raise Refused("it has no triangles")
    if place.ndim != 2 or place.shape[1] != 3:
        raise Refused(f"points have shape (n, 3), not {place.shape}")
    if rows.ndim != 2 or rows.shape[1] != 3 or rows.dtype.kind not in "iu":
        raise Refused(f"triangles are integers of shape (m, 3), not {rows.dtype} of shape {rows.shape}")
    wrong = np.flatnonzero(((rows < 0) | (rows >= len(place))).any(axis=1))
    if len(wrong) > 0:
        raise Refused(f"triangle {wrong[0]} has points {rows[wrong[0]].tolist()}, there are 0 .. {len(place) - 1}")
    wrong = np.flatnonzero(~np.isfinite(place).all(axis=1))
    if len(wrong) > 0:
        raise Refused(f"point {wrong[0]} is not finite: {at(place[wrong[0]])}")
    place, index = distinct(place)
    merged = index[rows]
    merged = merged[(merged != np.roll(merged, 1, axis=1)).all(axis=1)]
    if len(merged) == 0:
        raise Refused("it has no triangles with three different points")
    return used(place, merged)


def distinct(points: Points) -> tuple[Points, Indices]:
    """Points without repetitions, in the order in which they come first, and for each point its index there."""
    order = np.lexsort(points.T)
    is_new = np.concatenate([[True], (points[order[1:]] != points[order[:-1]]).any(axis=1)])
    first = order[is_new]
    rank = np.argsort(np.argsort(first))
    index = np.empty(len(points), np.int64)
    index[order] = rank[np.cumsum(is_new) - 1]
    return points[np.sort(first)], index


def used(points: Points, triangles: Indices) -> tuple[Points, Indices]:
    """Without points that no triangle has."""
    used, index = np.unique(triangles, return_inverse=True)
    return points[used], index.reshape(-1, 3)


def components(count: int, a: Indices, b: Indices) -> Indices:
    """For each of `count` nodes the lowest node that edges (a[i], b[i]) connect with it."""
    label = np.arange(count)
    while True:
        low, high = np.minimum(label[a], label[b]), np.maximum(label[a], label[b])
        if np.array_equal(low, high):
            return label
        np.minimum.at(label, high, low)
        while not np.array_equal(label, label[label]):
            label = label[label]


def numbers(rows: Indices, point_count: int) -> Indices:
    """A number for each row of three points, the same for rows with the same points."""
    low, middle, high = np.sort(rows, axis=1).T
    _, pair = np.unique(low * point_count + middle, return_inverse=True)
    _, number = np.unique(pair.ravel() * point_count + high, return_inverse=True)
    return np.asarray(number.ravel())


def areas(points: Points, triangles: Indices) -> Points:
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)


def volumes(points: Points, cells: Indices) -> Points:
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    return np.asarray(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6)


def inside_volumes(points: Points, triangles: Indices) -> Points:
    """What each triangle adds to the volume inside, with normals that point out."""
    middle = points.mean(axis=0)
    cells = np.insert(triangles, 0, len(points), axis=1)
    return volumes(np.vstack([points, middle]), cells)
