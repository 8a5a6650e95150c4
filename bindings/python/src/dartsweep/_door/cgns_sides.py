"""Surfaces of unstructured zones of CGNS files. VTK leaves out their boundary conditions, so these are read here."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import cgns_tree
from .cgns_tree import Node
from .mesh import Indices
from .ragged import offsets_of, positions, take

_CORNERS = {3: 2, 4: 2, 24: 2, 40: 2, **dict.fromkeys((5, 6, 25, 26, 41, 42), 3), **dict.fromkeys((7, 8, 9, 27, 28, 43, 44), 4)}
_NODES = {  # of all types that may stand in a section of mixed elements
    **{2: 1, 3: 2, 4: 3, 5: 3, 6: 6, 7: 4, 8: 8, 9: 9, 10: 4, 11: 10, 12: 5, 13: 14, 14: 6, 15: 15, 16: 18, 17: 8, 18: 20, 19: 27, 21: 13},
    **{24: 4, 25: 9, 26: 10, 27: 12, 28: 16, 29: 16, 30: 20, 31: 21, 32: 29, 33: 30, 34: 24, 35: 38, 36: 40, 37: 32, 38: 56, 39: 64},
}
_MIXED, _POLYGONS = 20, 22
Sides = list[tuple[str, Indices, Indices]]


class _Section:
    """Elements of a zone that are sides: corners of each, and their numbers."""

    def __init__(self, name: str, numbers: Indices, offsets: Indices, corners: Indices) -> None:
        self.name, self.numbers, self.offsets, self.corners = name, numbers, offsets, corners


def sides_of(path: str) -> tuple[list[tuple[Node, Sides]], list[str]] | None:
    """For each zone its surfaces: name, offsets and points, from 0 in the zone; and notes. None: not all zones are unstructured. Raises NoTree."""
    found: list[tuple[Node, Sides]] = []
    notes: list[str] = []
    for base, zone in cgns_tree.zones(path):
        dimension = int(base.data()[0])
        kind = zone.child("ZoneType")
        if kind is None or kind.text() != "Unstructured":
            return None
        sections = [section for node in zone.all("Elements_t") if (section := _section(node, dimension)) is not None]
        sides, used = _conditions(base, zone, sections, notes)
        for section in sections:  # the sections of which no condition speaks have names of their own
            if section.name and section.name not in used and section.name not in (name for name, _, _ in sides):
                sides.append((section.name, section.offsets, section.corners))
        found.append((zone, sides))
    return found, notes


def points_of(zone: Node) -> NDArray[np.float64]:
    """The points of a zone, (n, 2) or (n, 3)."""
    grid = next(zone.all("GridCoordinates_t"))
    return np.stack([np.asarray(node.data(), np.float64) for node in sorted(grid.all("DataArray_t"), key=lambda node: node.name)], axis=1)


def _section(node: Node, dimension: int) -> _Section | None:
    """The elements of a section that are sides; None: it has no such."""
    kind = int(node.data()[0])
    first, last = (int(number) for number in _array(node, "ElementRange")[:2])
    numbers, flat = np.arange(first, last + 1), _array(node, "ElementConnectivity")
    if kind == _POLYGONS and dimension == 3:
        if node.child("ElementStartOffset") is None:  # before version 4 each face says itself how many points it has
            starts = _starts(flat, last - first + 1, lambda word: word + 1)
            offsets, flat = offsets_of(flat[starts]), flat[positions(starts + 1, flat[starts])]
        else:
            offsets = _array(node, "ElementStartOffset")
        return _Section("", numbers, offsets, flat - 1)  # all faces of the zone: only conditions name some of them
    if kind == _MIXED:
        starts = _starts(flat, last - first + 1, lambda word: _NODES[word] + 1)
        corners = np.array([_corners(int(word), dimension) for word in flat[starts]], np.int64)
        kept = np.flatnonzero(corners)
        if len(kept) == 0:
            return None
        return _Section(node.name, numbers[kept], offsets_of(corners[kept]), flat[positions(starts[kept] + 1, corners[kept])] - 1)
    corner_count = _corners(kind, dimension)
    if corner_count == 0:
        return None
    rows = flat.reshape(last - first + 1, -1)[:, :corner_count]
    return _Section(node.name, numbers, np.arange(len(rows) + 1) * corner_count, np.ravel(rows) - 1)


def _corners(kind: int, dimension: int) -> int:
    """Corners of elements of a type, 0 if they are no sides."""
    count = _CORNERS.get(kind, 0)
    return count if (count > 2) == (dimension == 3) else 0


def _array(node: Node, name: str) -> Indices:
    child = node.child(name)
    return np.empty(0, np.int64) if child is None else np.asarray(child.data(), np.int64)


def _starts(flat: Indices, count: int, length: Any) -> Indices:
    """Where elements start that say themselves how long they are."""
    starts, at = np.empty(count, np.int64), 0
    words = flat.tolist()
    for i in range(count):
        starts[i] = at
        at += length(words[at])
    return starts


def _some(section: _Section, rows: Indices) -> tuple[Indices, Indices, Indices]:
    sizes, corners = take(section.offsets, section.corners, rows)
    return section.numbers[rows], offsets_of(sizes), corners


def _conditions(base: Node, zone: Node, sections: list[_Section], notes: list[str]) -> tuple[Sides, set[str]]:
    """The boundary conditions, and the names of the sections that they are made of."""
    sides: Sides = []
    used: set[str] = set()
    for conditions in zone.all("ZoneBC_t"):
        for condition in conditions.all("BC_t"):
            offsets, corners = [np.zeros(1, np.int64)], []
            for section in sections:
                rows = _rows_of(condition, section)
                if len(rows) == 0:
                    continue
                if section.name:
                    used.add(section.name)
                _, own, points = _some(section, rows)
                offsets.append(own[1:] + offsets[-1][-1])
                corners.append(points)
            for name in _names_of(base, condition):
                if corners:
                    sides.append((name, np.concatenate(offsets), np.concatenate(corners)))
                else:
                    notes.append(f"the boundary condition '{name}' names no faces that the file has, and was left out")
    return sides, used


def _names_of(base: Node, condition: Node) -> list[str]:
    """The name of a condition, or those that its family has for the names of a model, as Gmsh writes them."""
    family = next((node.text() for node in condition.all("FamilyName_t")), "")
    node = base.child(family)
    others = [] if node is None else [name.text() for name in node.all("FamilyName_t")]
    return others or [condition.name]


def _rows_of(condition: Node, section: _Section) -> Indices:
    """Which elements of a section a condition names: by their numbers, or by all of their points."""
    location = condition.child("GridLocation")
    by_points = location is None or location.text() == "Vertex"
    for name in ("ElementList", "ElementRange", "PointList", "PointRange"):
        child = condition.child(name)
        if child is None:
            continue
        wanted = np.asarray(child.data(), np.int64)
        wanted = np.arange(wanted[0], wanted[1] + 1) if name.endswith("Range") else wanted
        if by_points and name.startswith("Point"):
            is_in = np.isin(section.corners, wanted - 1)
            return np.flatnonzero(np.logical_and.reduceat(is_in, section.offsets[:-1])) if len(section.numbers) else np.empty(0, np.int64)
        return np.flatnonzero(np.isin(section.numbers, wanted))
    return np.empty(0, np.int64)
