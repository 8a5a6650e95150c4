"""Bricks that name nodes twice, as Ansys and LS-DYNA write tetrahedra, pyramids and wedges."""

from __future__ import annotations

import numpy as np

from . import linear
from .mesh import Indices

_SHAPES: tuple[tuple[tuple[tuple[int, ...], ...], int, list[int], int, list[int]], ...] = (
    # places that have the same node; VTK's type and its nodes among 8; the type of second order and its nodes among 20
    (((3, 4, 5, 6, 7),), 10, [0, 1, 2, 3], 0, []),
    (((2, 3), (4, 5, 6, 7)), 10, [0, 1, 2, 4], 24, [0, 1, 2, 4, 8, 9, 11, 16, 17, 18]),
    (((4, 5, 6, 7),), 14, [0, 1, 2, 3, 4], 27, [0, 1, 2, 3, 4, 8, 9, 10, 11, 16, 17, 18, 19]),
    (((2, 3), (6, 7)), 13, [0, 1, 2, 4, 5, 6], 26, [0, 1, 2, 4, 5, 6, 8, 9, 11, 12, 13, 15, 16, 17, 18]),
    (((1, 2), (5, 6)), 13, [0, 1, 3, 4, 5, 7], 26, [0, 1, 3, 4, 5, 7, 8, 10, 11, 12, 14, 15, 16, 17, 19]),
    (((4, 5), (6, 7)), 13, [0, 4, 1, 3, 6, 2], 0, []),
)


def bricks(rows: Indices) -> linear.Cells:
    """Cells of bricks of 8 or 20 nodes, in their order."""
    is_linear = rows.shape[1] == 8
    is_left = np.ones(len(rows), np.bool_)
    parts, places = [], [np.empty(0, np.int64)]
    for same, kind, nodes, quadratic, more in _SHAPES:
        if not is_linear:
            kind, nodes = quadratic, more
        is_own = is_left & np.all([rows[:, group[0]] == rows[:, other] for group in same for other in group[1:]], axis=0)
        if kind and np.any(is_own):
            parts.append(linear.uniform(kind, rows[is_own][:, nodes]))
            places.append(np.flatnonzero(is_own))
            is_left &= ~is_own
    parts.append(linear.uniform(12 if is_linear else 25, rows[is_left]))
    places.append(np.flatnonzero(is_left))
    return linear.joined(parts).some(np.argsort(np.concatenate(places), kind="stable"))


def quads(rows: Indices) -> linear.Cells:
    """Cells of quads of 4 or 8 nodes, in their order; those whose third and fourth node are one are triangles."""
    is_triangle = rows[:, 2] == rows[:, 3]
    triangle, quad, nodes = (5, 9, [0, 1, 2]) if rows.shape[1] == 4 else (22, 23, [0, 1, 2, 4, 5, 7])
    parts = [linear.uniform(triangle, rows[is_triangle][:, nodes]), linear.uniform(quad, rows[~is_triangle])]
    places = np.concatenate([np.flatnonzero(is_triangle), np.flatnonzero(~is_triangle)])
    return linear.joined(parts).some(np.argsort(places, kind="stable"))
