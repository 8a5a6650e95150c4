"""Coordinate systems of Nastran's points (CORD1, CORD2): Gmsh and meshio read numbers of points as if all were rectangular and global."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from .mapped import mapped
from .mesh import Indices

_Points = NDArray[np.float64]
_CARD = re.compile(r"(GRID|GRDSET|CORD[123]\w)\b(\*?)", re.IGNORECASE)
_NAMES_A_SYSTEM = rb"\*?[ \t]*,[^,\n]*,[ \t]*0*[1-9]| {4}[^\n,\t]{8}[ 0]{0,7}[1-9]|\* {3}[^\n,\t]{16}[ 0]{0,15}[1-9]|[^\n,]*\t"
_MAY_BE_LOCAL = re.compile(rb"(?im)^[ \t]*(?:CORD[123]\w|GRDSET\b|GRID(?:" + _NAMES_A_SYSTEM + rb"))")
_NUMBER = re.compile(r"([+-]?[\d.]+)[eEdD]?([+-]?\d+)?$")
WAY_ON = "a preprocessor can write its points in the global system"
_MEND = "the file has to be mended"


def has_any(path: str, source: str) -> bool:
    """Whether points of a file are in another system than the global one."""
    return _may_have_any(path) and any(_File(path, source).system_of.values())


def _may_have_any(path: str) -> bool:
    """Whether a file has cards of systems, or points that name one. Points in fields that tabs divide are taken as such."""
    with mapped(path) as text:
        return _MAY_BE_LOCAL.search(text) is not None


def placed(path: str, source: str, numbers: Indices, points: _Points) -> _Points:
    """Points, of GRID cards with ascending numbers, in the global system."""
    if not _may_have_any(path):
        return points
    file = _File(path, source)
    made = points.copy()
    systems = np.array([file.system_of.get(number, 0) for number in numbers.tolist()], np.int64)
    for system in np.unique(systems[systems != 0]).tolist():
        rows = systems == system
        made[rows] = file.to_global(system, points[rows], ())
    return made


class _File:
    """Systems of a file, and the system of each of its points."""

    def __init__(self, path: str, source: str) -> None:
        self.source = source
        self.system_of: dict[int, int] = {}
        self.grids: dict[int, list[str]] = {}  # words of the coordinates
        self.systems: dict[int, tuple[str, int, list[str]]] = {}  # kind, system of its points, and these
        usual = 0
        for name, fields in _cards(path):
            if name == "GRDSET":
                usual = _integer(fields[1])
            elif name == "GRID":
                self.system_of[_integer(fields[0])] = _integer(fields[1]) if fields[1] else -1
                self.grids[_integer(fields[0])] = fields[2:5]
            elif name.startswith("CORD2"):
                self.systems[_integer(fields[0])] = name, _integer(fields[1]), fields[2:11]
            elif name.startswith("CORD1"):
                for first in (0, 4):
                    if fields[first]:
                        self.systems[_integer(fields[first])] = name, 0, fields[first + 1 : first + 4]
            else:
                raise MeshError(source, f"it has a system {name}", WAY_ON)
        self.system_of = {number: usual if own < 0 else own for number, own in self.system_of.items()}

    def to_global(self, system: int, points: _Points, above: tuple[int, ...]) -> _Points:
        """Points that are given in a system."""
        if system == 0:
            return points
        if system in above or system not in self.systems:
            raise MeshError(self.source, f"its coordinate system {system} is not there, or is given by itself", _MEND)
        places = self._places(system, above)
        up = places[1] - places[0]
        across = np.cross(up, places[2] - places[0])
        axes = np.array([np.cross(across, up), across, up])
        lengths = np.linalg.norm(axes, axis=1)[:, None]
        if not np.all(lengths > 0.0):
            raise MeshError(self.source, f"the points of its coordinate system {system} are on a line, or are not numbers", _MEND)
        made: _Points = places[0] + _rectangular(self.systems[system][0][-1], points) @ (axes / lengths)
        return made

    def _places(self, system: int, above: tuple[int, ...]) -> list[_Points]:
        """The origin of a system, a point on its third axis, and one in the plane of the first and third."""
        name, given_in, words = self.systems[system]
        if not (all(words) if name.startswith("CORD1") else any(words[6:])):
            raise MeshError(self.source, f"its {name} of coordinate system {system} does not have three points", _MEND)
        if name.startswith("CORD2"):
            return list(self.to_global(given_in, _reals(words).reshape(3, 3), (*above, system)))
        numbers = [_integer(word) for word in words]
        lost = [number for number in numbers if number not in self.grids]
        if lost:
            raise MeshError(self.source, f"its {name} of coordinate system {system} names point {lost[0]}, which is not there", _MEND)
        return [self.to_global(self.system_of[number], _reals(self.grids[number])[None], (*above, system))[0] for number in numbers]


def _rectangular(kind: str, points: _Points) -> _Points:
    """Rectangular coordinates of R; of C, distance from the axis, degrees and height; of S, distance, degrees from the axis and round it."""
    if kind == "R":
        return points
    radius, second, third = points.T
    if kind == "C":
        angle, height = np.radians(second), third
    else:
        angle, height = np.radians(third), radius * np.cos(np.radians(second))
        radius = radius * np.sin(np.radians(second))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1)


def _cards(path: str) -> Iterator[tuple[str, list[str]]]:
    """Names and fields of the cards of points and systems, at least eleven fields each."""
    name, fields = "", list[str]()
    with open(path, encoding="latin-1") as file:
        for line in file:
            row = line.partition("$")[0].rstrip()
            first = (row.partition(",")[0] if "," in row else row.expandtabs()[:8]).strip()
            if first[:1] in ("", "+", "*"):
                if name and row:
                    fields += _fields(row, first.startswith("*"))
                continue
            if name:
                yield name, fields + [""] * (11 - len(fields))
            found = _CARD.match(row.strip())
            name, fields = (found.group(1).upper(), _fields(row.strip(), found.group(2) == "*")) if found else ("", [])
    if name:
        yield name, fields + [""] * (11 - len(fields))


def _fields(row: str, is_wide: bool) -> list[str]:
    """Fields behind the first, without the one that names the row which goes on."""
    count, width = (4, 16) if is_wide else (8, 8)
    words = row.split(",")[1 : 1 + count] if "," in row else [row.expandtabs()[8 + width * i :][:width] for i in range(count)]
    return [word.strip() for word in words] + [""] * (count - len(words))


def _integer(word: str) -> int:
    return int(word or "0")


def _reals(words: list[str]) -> Any:
    """Numbers, also with an exponent that has no letter, as in 1.5-3."""
    found = [_NUMBER.match(word or "0.") for word in words]
    return np.array([float(f"{own.group(1)}e{own.group(2) or 0}") if own else np.nan for own in found], np.float64)
