"""Continuous collision detection of single pairs, without an environment."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, dtypes
from .enums import PairFlag, PairKind
from ._shapes import Records


def sweep_pairs(
    starts: ArrayLike,
    ends: ArrayLike,
    kinds: ArrayLike | None = None,
    ranks: bool = False,
    threads: int = 0,
    out: Records | None = None,
) -> Records:
    """When each of n pairs of moving features first touches (dtypes.PAIR_TOUCH), written to `out` where it is given.

    starts, ends: of shape (n, 4, 3), or (n, 3, 2) in the plane. kinds: the PairKind of each pair, or of all; in the plane it may be left out.
    ranks: finds the order as well. threads: 0 for one per processor.
    """
    start, end = _points(starts), _points(ends)
    count, dimension = start.shape[0], start.shape[2]
    if kinds is None:
        if dimension == 3:
            raise TypeError("kinds are needed in space: PairKind.VERTEX_FACE or PairKind.EDGE_EDGE")
        kinds = PairKind.VERTEX_EDGE
    all_kinds: Any = np.full(count, kinds) if np.ndim(kinds) == 0 else kinds
    touches = np.empty(count, dtypes.PAIR_TOUCH) if out is None else out
    context = None if threads == 0 else _core.Context(threads, None)
    flags = PairFlag.RANK if ranks else 0
    _core.sweep_pairs(dimension, all_kinds, start.reshape(-1, dimension), end.reshape(-1, end.shape[2]), touches, flags, context)
    return touches


def _points(points: ArrayLike) -> NDArray[np.float64]:
    made = np.ascontiguousarray(points, np.float64)
    if made.ndim != 3 or made.shape[1:] not in ((4, 3), (3, 2)):
        raise ValueError("points of pairs are an array of shape (n, 4, 3), or (n, 3, 2) in the plane")
    return made
