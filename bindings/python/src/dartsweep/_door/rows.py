"""Cells and faces that a text gives one by one, by the numbers that it has for points."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from . import linear
from .mesh import Indices
from .ragged import offsets_of


class Numbers:
    """Which point, or which cell, has each number of a file."""

    def __init__(self, numbers: Iterable[int], what: str) -> None:
        self.what = what
        self.place = {number: i for i, number in enumerate(numbers)}

    def of(self, numbers: Iterable[int]) -> list[int]:
        """The places of numbers; a ValueError names one that the file does not have."""
        try:
            return [self.place[number] for number in numbers]
        except KeyError as error:
            raise ValueError(f"{self.what} {error} is not there") from error


def cells_of(kinds: list[int], rows: list[list[int]]) -> linear.Cells:
    """Cells of VTK's types, in their order."""
    return linear.Cells(np.array(kinds, np.uint8), *ragged(rows))


def ragged(rows: list[list[int]]) -> tuple[Indices, Indices]:
    """Offsets of rows, and all that they hold."""
    flat: Any = [number for row in rows for number in row]
    return offsets_of([len(row) for row in rows]), np.array(flat, np.int64)
