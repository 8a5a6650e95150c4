"""Meshes of SU2 (.su2), also of several zones; markers keep their names. Wedges are numbered as in VTK before 9.7."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from . import blocks, linear
from .error import MeshError
from .ragged import offsets_of
from .raw import Raw

_WIDTHS = {3: 2, 5: 3, 9: 4, 10: 4, 12: 8, 13: 6, 14: 5}  # VTK's types
_WEDGE = [0, 2, 1, 3, 5, 4]
_WAY_ON = "SU2_DEF can write the mesh anew"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Markers are groups of faces; several zones are regions."""
    try:
        with open(path, encoding="latin-1") as file:
            zones = list(_zones(_lines(file), source))
    except (ValueError, IndexError, KeyError, StopIteration, RuntimeError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as SU2 writes it ({error})", _WAY_ON) from error
    if not zones:
        raise MeshError(source, "it has no NDIME", _WAY_ON)
    return blocks.joined([(f"zone {i}", zone) for i, zone in enumerate(zones, 1)]) if len(zones) > 1 else zones[0]


def _lines(file: Iterator[str]) -> Iterator[str]:
    """Lines without comments."""
    return (line for line in (line.partition("%")[0].strip() for line in file) if line)


def _zones(lines: Iterator[str], source: str) -> Iterator[Raw]:
    zone: _Zone | None = None
    for line in lines:
        key, _, value = (word.strip() for word in line.partition("="))
        if key == "NDIME":
            if zone is not None:
                yield zone.raw(source)
            zone = _Zone(int(value))
        elif zone is not None:
            zone.take(key, value, lines)
    if zone is not None:
        yield zone.raw(source)


class _Zone:
    """What has been read of a zone."""

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension
        self.points = np.empty((0, dimension))
        self.elements: list[list[int]] = []
        self.markers: list[tuple[str, list[list[int]]]] = []

    def take(self, key: str, value: str, lines: Iterator[str]) -> None:
        """A keyword, and the lines that belong to it."""
        if key == "NPOIN":
            rows = [next(lines).split()[: self.dimension] for _ in range(int(value.split()[0]))]
            self.points = np.array(rows, np.float64)
        elif key == "NELEM":
            self.elements = [[int(word) for word in re.split(r"[\s,]+", next(lines))] for _ in range(int(value))]
        elif key == "MARKER_TAG":
            self.markers.append((value, []))
        elif key == "MARKER_ELEMS":
            self.markers[-1][1].extend([int(word) for word in next(lines).split()] for _ in range(int(value)))

    def raw(self, source: str) -> Raw:
        raw = Raw(self.points, _cells(self.elements), source=source, reader="NumPy")
        for name, rows in self.markers:
            faces = [np.array(row[1 : 1 + _WIDTHS[row[0]]], np.int64) for row in rows if row[0] != 1]
            if faces:
                raw.sides.append((name, offsets_of([len(face) for face in faces]), np.concatenate(faces)))
        return raw


def _cells(rows: list[list[int]]) -> linear.Cells:
    """In the order of the file; behind the points of a row its number may follow."""
    kinds = np.array([row[0] for row in rows], np.int64)
    parts, places = [], [np.empty(0, np.int64)]
    for kind in np.unique(kinds):
        own = np.flatnonzero(kinds == kind)
        table = np.array([rows[i][1 : 1 + _WIDTHS[int(kind)]] for i in own.tolist()], np.int64)
        parts.append(linear.uniform(int(kind), table[:, _WEDGE] if kind == 13 else table))
        places.append(own)
    return linear.joined(parts).some(np.argsort(np.concatenate(places), kind="stable"))
