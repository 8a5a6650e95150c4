"""Cells of VTK's types as cells that Environment takes: pixels, voxels and prisms are renumbered, quadratic cells lose or use their nodes."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from . import quadratics
from .mesh import Indices
from .ragged import offsets_of, positions, take

POLYHEDRON = 42
"""VTK's number, and that of CellType."""

DIMENSION = np.full(256, -1, np.int8)
"""The dimension of cells of each of VTK's types; -1 for those that no reader gives."""
for _dimension, _types in enumerate(
    (
        (1, 2),
        (3, 4, 21, 35, 68, 75),
        (5, 6, 7, 8, 9, 22, 23, 28, 30, 34, 36, 69, 70, 76, 77),
        (10, 11, 12, 13, 14, 15, 16, 24, 25, 26, 27, 29, 31, 32, 33, 37, 42, 71, 72, 73, 74, 78, 79, 80, 81),
    )
):
    DIMENSION[list(_types)] = _dimension

_CORNERS = {  # of higher order: the linear type, and how many corners come first
    **{21: (3, 2), 35: (3, 2), 68: (3, 2), 75: (3, 2)},
    **{22: (5, 3), 34: (5, 3), 69: (5, 3), 76: (5, 3), 23: (9, 4), 28: (9, 4), 30: (9, 4), 70: (9, 4), 77: (9, 4)},
    **{24: (10, 4), 71: (10, 4), 78: (10, 4), 25: (12, 8), 29: (12, 8), 33: (12, 8), 72: (12, 8), 79: (12, 8)},
    **{26: (13, 6), 31: (13, 6), 32: (13, 6), 73: (13, 6), 80: (13, 6), 27: (14, 5), 37: (14, 5), 74: (14, 5), 81: (14, 5)},
}
_KEPT = np.zeros(256, np.bool_)
_KEPT[[1, 2, 3, 4, 5, 7, 9, 10, 12, 14, 42]] = True
_ORDER = {8: (9, [0, 1, 3, 2]), 11: (12, [0, 1, 3, 2, 4, 5, 7, 6]), 13: (13, [0, 2, 1, 3, 5, 4])}  # type, and the order of ours
_PRISM_SIDES = {15: 5, 16: 6}


def corner_type(kind: int) -> int:
    """The linear type of one of VTK's types."""
    return _CORNERS.get(kind, (kind, 0))[0]


@dataclasses.dataclass
class Cells:
    """Cells one after the other: cell i has type types[i] and the points, or the face stream, flat[offsets[i] : offsets[i + 1]]."""

    types: NDArray[np.uint8]
    offsets: Indices
    flat: Indices

    def some(self, rows: Indices) -> Cells:
        """Some cells, in a given order."""
        sizes, flat = take(self.offsets, self.flat, rows)
        return Cells(self.types[rows], offsets_of(sizes), flat)


def uniform(kind: int, rows: Any) -> Cells:
    """Cells of one type and size, one in each row."""
    rows = np.asarray(rows, np.int64)
    count, width = rows.shape
    return Cells(np.full(count, kind, np.uint8), np.arange(0, count * width + 1, width), rows.ravel())


def joined(parts: list[Cells]) -> Cells:
    """Cells of several arrays, one array after the other."""
    if len(parts) == 1:
        return parts[0]
    if not parts:
        return Cells(np.empty(0, np.uint8), np.zeros(1, np.int64), np.empty(0, np.int64))
    sizes = np.concatenate([np.diff(part.offsets) for part in parts])
    return Cells(np.concatenate([part.types for part in parts]), offsets_of(sizes), np.concatenate([part.flat for part in parts]))


@dataclasses.dataclass
class Made:
    """What the making of linear cells needs and changes."""

    points: NDArray[np.float64]
    source: str
    quadratic: str
    notes: list[str]
    middles: dict[tuple[int, ...], int] = dataclasses.field(default_factory=dict)
    """Points that were made in the middle of faces, by the nodes of the sides."""
    cornered: int = 0
    """How many cells of higher order were taken by their corners."""
    farthest: float | None = None
    """How far one of their nodes lies from the middle of a straight side."""


def supported(made: Made, cells: Cells) -> tuple[Cells, Indices | None]:
    """Cells of types that Environment takes, and of which cell each is made; None: all cells are kept, in their order."""
    if len(cells.flat) and not 0 <= int(cells.flat.min()):
        raise MeshError(made.source, "a cell names a point with a negative index", "the file is damaged")
    cells = _without_small_polygons(cells)
    present = np.flatnonzero(np.bincount(cells.types, minlength=256))
    if bool(np.all(_KEPT[present])):
        return cells, None
    parts: list[Cells] = []
    parents: list[Indices] = []
    for kind in present:
        rows = np.flatnonzero(cells.types == kind)
        for children, of in _converted(made, int(kind), cells.some(rows)):
            parts.append(children)
            parents.append(rows[of])
    quadratics.note_corners(made)
    everything, parent = joined(parts), np.concatenate([np.empty(0, np.int64), *parents])
    order = np.argsort(parent, kind="stable")
    return everything.some(order), parent[order]


def _without_small_polygons(cells: Cells) -> Cells:
    """Polygons of two points, as files of VTK have them, are lines, and those of one are points."""
    polygons = np.flatnonzero(cells.types == 7)
    sizes = cells.offsets[polygons + 1] - cells.offsets[polygons]
    small, sizes = polygons[sizes < 3], sizes[sizes < 3]
    if len(small) == 0:
        return cells
    types = cells.types.copy()
    types[small] = np.array([0, 1, 3], np.uint8)[sizes]
    return Cells(types, cells.offsets, cells.flat)


def _converted(made: Made, kind: int, cells: Cells) -> list[tuple[Cells, Indices]]:
    """What cells of one type become, and for each of these which of the cells it comes from."""
    count = len(cells.types)
    own = np.arange(count)
    if _KEPT[kind]:
        return [(cells, own)]
    if kind in _ORDER:
        new, order = _ORDER[kind]
        return [(uniform(new, _rows_of(made, cells, len(order))[:, order]), own)]
    if kind in _PRISM_SIDES:
        return [(_prisms(_rows_of(made, cells, 2 * _PRISM_SIDES[kind])), own)]
    if kind == 0:
        made.notes.append(f"{count} empty cells were left out")
        return []
    if kind == 6:
        return _strips(cells)
    if kind == 36:
        return [(_quadratic_polygons(made, cells), own)]
    if kind in _CORNERS:
        return _of_higher_order(made, kind, cells)
    raise MeshError(made.source, f"{count} cells have type {kind} of VTK", "its cells have to be divided into linear ones first")


def _rows_of(made: Made, cells: Cells, least: int) -> Indices:
    """Cells of one type and size as rows."""
    sizes = np.diff(cells.offsets)
    if np.any(sizes < least) or np.any(sizes != sizes[0]):
        raise MeshError(made.source, f"cells of type {cells.types[0]} of VTK have {sizes.min()} to {sizes.max()} points", f"they have {least}")
    return cells.flat.reshape(len(sizes), -1)


def _prisms(rows: Indices) -> Cells:
    """Polyhedra of prisms over polygons: the lower one counter-clockwise seen from the upper one."""
    n = rows.shape[1] // 2
    sides = [column for i in range(n) for column in (4, i, (i + 1) % n, n + (i + 1) % n, n + i)]
    is_point = np.ones(len(sides), np.bool_)
    is_point[::5] = False
    stream = np.empty((len(rows), 3 + 2 * n + 5 * n), np.int64)
    stream[:, 0], stream[:, 1], stream[:, 2 + n] = n + 2, n, n
    stream[:, 2 : 2 + n] = rows[:, :n][:, ::-1]
    stream[:, 3 + n : 3 + 2 * n] = rows[:, n:]
    stream[:, 3 + 2 * n :] = np.where(is_point, rows[:, np.where(is_point, sides, 0)], 4)
    return uniform(POLYHEDRON, stream)


def _strips(cells: Cells) -> list[tuple[Cells, Indices]]:
    """The triangles of strips."""
    counts = np.diff(cells.offsets) - 2
    first = positions(cells.offsets[:-1], counts)
    is_odd = (first - np.repeat(cells.offsets[:-1], counts)) % 2
    triangles = np.stack([cells.flat[first], cells.flat[first + 1 + is_odd], cells.flat[first + 2 - is_odd]], axis=1)
    return [(uniform(5, triangles), np.repeat(np.arange(len(counts)), counts))]


def _quadratic_polygons(made: Made, cells: Cells) -> Cells:
    """Corners are followed by the nodes of the sides: "split" takes both."""
    sizes = np.diff(cells.offsets) // 2
    corners = positions(cells.offsets[:-1], sizes)
    types = np.full(len(sizes), 7, np.uint8)
    if made.quadratic != "split":
        return Cells(types, offsets_of(sizes), cells.flat[corners])
    both = np.stack([cells.flat[corners], cells.flat[corners + np.repeat(sizes, sizes)]], axis=1)
    return Cells(types, offsets_of(2 * sizes), both.ravel())


def _of_higher_order(made: Made, kind: int, cells: Cells) -> list[tuple[Cells, Indices]]:
    linear, corners = _CORNERS[kind]
    sizes = np.diff(cells.offsets)
    found: list[tuple[Cells, Indices]] = []
    for size in np.unique(sizes):  # Lagrange's have any size
        chosen = np.flatnonzero(sizes == size)
        rows = _rows_of(made, cells.some(chosen), corners)
        if size == corners:
            found.append((_linear(made, linear, rows), chosen))
        elif made.quadratic == "split":
            found += [(_linear(made, new, nodes), chosen[of]) for new, nodes, of in quadratics.split(made, kind, rows)]
        else:
            quadratics.measure_corners(made, kind, rows)
            found.append((_linear(made, linear, rows[:, :corners]), chosen))
    return found


def _linear(made: Made, kind: int, rows: Indices) -> Cells:
    return _converted(made, kind, uniform(kind, rows))[0][0]


def triangles(offsets: Indices, flat: Indices) -> Indices:
    """Polygons as fans from their first points."""
    counts = np.diff(offsets) - 2
    second = positions(offsets[:-1] + 1, counts)
    return np.stack([flat[np.repeat(offsets[:-1], counts)], flat[second], flat[second + 1]], axis=1)
