"""Traces: geometry for viewers, with a label on every part."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import Flight
from ._shapes import Ids
from .environment import Environment

Part = tuple[NDArray[np.uint32], NDArray[np.uint32]]


class Trace:
    """Points, and dots, segments and triangles of them. The arrays are copies."""

    __slots__ = ("_core",)

    def __init__(self) -> None:
        self._core: Any = _core.Trace()

    def clear(self) -> None:
        """Empties it."""
        self._core.clear()

    def add_volumes(self, environment: Environment, volumes: Ids, label: int = 0) -> None:
        """Boundary triangles of volumes, or in the plane their sides as segments."""
        self._core.add_volumes(environment._core, volumes, label)

    def add_impassable(self, environment: Environment, with_boundary: bool = True, label: int = 0) -> None:
        """All walls that border passable volumes: triangles, or in the plane segments."""
        self._core.add_impassable(environment._core, with_boundary, label)

    def add_walk(self, environment: Environment, start: ArrayLike, end: ArrayLike, normal_length: float, label: int = 0) -> None:
        """The volumes that a segment enters, and its contact."""
        self._core.add_walk(environment._core, start, end, normal_length, label)

    def add_contact(self, flight: Flight | np.void, normal_length: float, label: int = 0) -> None:
        """The contact of a flight, and a segment along its normal."""
        self._core.add_contact(flight, normal_length, label)

    @property
    def points(self) -> NDArray[np.float64]:
        """All points; the third coordinate is 0 in the plane."""
        return self._core.get_points().reshape(-1, 3)  # type: ignore[no-any-return]

    @property
    def dots(self) -> Part:
        """Indices of points, and labels."""
        return self._core.get_vertices(), self._core.get_vertex_labels()

    @property
    def segments(self) -> Part:
        """Pairs of indices, and labels."""
        return self._core.get_segments().reshape(-1, 2), self._core.get_segment_labels()

    @property
    def triangles(self) -> Part:
        """Triples of indices, and labels."""
        return self._core.get_triangles().reshape(-1, 3), self._core.get_triangle_labels()
