"""Rows of different lengths: row i is flat[offsets[i] : offsets[i + 1]]."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.int64]


def offsets_of(sizes: Any) -> Indices:
    """Where rows of given sizes start, and where the last ends."""
    made = np.zeros(len(sizes) + 1, np.int64)
    np.cumsum(sizes, out=made[1:])
    return made


def positions(starts: Indices, sizes: Indices) -> Indices:
    """starts[0], starts[0] + 1, ... sizes[0] of them, then those of the next row."""
    ends = np.cumsum(sizes)
    total = int(ends[-1]) if len(ends) else 0
    made: Indices = np.arange(total) + np.repeat(starts - (ends - sizes), sizes)
    return made


def take(offsets: Indices, flat: Indices, rows: Indices) -> tuple[Indices, Indices]:
    """Some rows, in a given order: their sizes and integers."""
    starts = offsets[rows]
    sizes = offsets[np.asarray(rows) + 1] - starts
    return sizes, flat[positions(starts, sizes)]


def groups_by_number(numbers: NDArray[Any]) -> dict[int, Indices]:
    """The rows of each number, by ascending number."""
    values, inverse = np.unique(numbers, return_inverse=True)
    order = np.argsort(inverse, kind="stable")
    bounds = np.searchsorted(inverse[order], np.arange(len(values) + 1))
    return {int(value): order[bounds[i] : bounds[i + 1]] for i, value in enumerate(values)}
