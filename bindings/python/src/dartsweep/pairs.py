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
    dimension = start.shape[2]
    touches = np.empty(start.shape[0], dtypes.PAIR_TOUCH) if out is None else out
    _core.sweep_pairs(dimension, _kinds(kinds, start), _rows(start), _rows(end), touches, *_how(ranks, threads))
    return touches


def sweep_rigid_pairs(
    starts: ArrayLike,
    ends: ArrayLike | None,
    motions: ArrayLike,
    indices: ArrayLike,
    kinds: ArrayLike | None = None,
    ranks: bool = False,
    threads: int = 0,
    out: Records | None = None,
) -> Records:
    """When each of n pairs of features first touches, where features may turn (dtypes.PAIR_TOUCH): sweep_pairs with rigid motions.

    ends: None if features without a motion stand. motions: of shape (m, 17): the quaternions x, y, z, w at times 0 and 1, the centre, and its
    places at both times. indices: of shape (n, 2): the motion of each feature, -1 for none. All else is as in sweep_pairs.
    """
    start = _points(starts)
    end = np.empty((0, 0, start.shape[2])) if ends is None else _points(ends)
    ways = np.ascontiguousarray(motions, np.float64)
    of_pairs = np.asarray(indices, np.int64)
    if ways.ndim != 2 or ways.shape[1] != 17:
        raise ValueError("motions are an array of shape (m, 17)")
    if of_pairs.shape != (start.shape[0], 2) or (of_pairs < -1).any() or (of_pairs >= len(ways)).any():
        raise ValueError("indices are an array of shape (n, 2), of -1 or indices of motions")
    touches = np.empty(start.shape[0], dtypes.PAIR_TOUCH) if out is None else out
    _core.sweep_rigid_pairs(
        start.shape[2],
        _kinds(kinds, start),
        _rows(start),
        _rows(end),
        ways.reshape(-1),
        of_pairs.astype(np.uint32).reshape(-1),
        touches,
        *_how(ranks, threads),
    )
    return touches


def _kinds(kinds: ArrayLike | None, start: NDArray[np.float64]) -> Any:
    if kinds is None:
        if start.shape[2] == 3:
            raise TypeError("kinds are needed in space: PairKind.VERTEX_FACE or PairKind.EDGE_EDGE")
        kinds = PairKind.VERTEX_EDGE
    return np.full(start.shape[0], kinds) if np.ndim(kinds) == 0 else kinds


def _how(ranks: bool, threads: int) -> tuple[int, _core.Context | None]:
    return PairFlag.RANK if ranks else 0, None if threads == 0 else _core.Context(threads, None)


def _rows(points: NDArray[np.float64]) -> NDArray[np.float64]:
    return points.reshape(-1, points.shape[2])


def _points(points: ArrayLike) -> NDArray[np.float64]:
    made = np.ascontiguousarray(points, np.float64)
    if made.ndim != 3 or made.shape[1:] not in ((4, 3), (3, 2)):
        raise ValueError("points of pairs are an array of shape (n, 4, 3), or (n, 3, 2) in the plane")
    return made
