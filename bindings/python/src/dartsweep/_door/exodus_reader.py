"""Exodus II files, as Cubit, SEACAS, MOOSE and libMesh write them. Wedges are numbered as in Gmsh."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

from . import linear
from .error import MeshError
from .linear import Cells
from .mesh import Indices
from .netcdf import Variables
from .quadratics import sides_upwards_first
from .ragged import offsets_of
from .raw import Raw

_TYPES = {  # of the first three letters: for each number of nodes VTK's type
    "SPH": {1: 1},
    "CIR": {1: 1},
    **{name: {2: 3, 3: 21, 4: 35} for name in ("TRU", "BEA", "BAR", "EDG", "LIN")},
    "TRI": {3: 5, 4: 5, 6: 22, 7: 34},
    "QUA": {4: 9, 5: 9, 8: 23, 9: 28},
    "TET": {4: 10, 5: 10, 8: 10, 10: 24, 11: 24, 14: 24, 15: 24},
    "PYR": {5: 14, 13: 27, 14: 37, 18: 37, 19: 37},
    "WED": {6: 13, 12: 31, 15: 26, 16: 26, 18: 32, 20: 32, 21: 32},
    "HEX": {8: 12, 9: 12, 20: 25, 21: 25, 27: 29},
}
_TYPES["SHE"] = {**_TYPES["TRI"], **_TYPES["QUA"]}
_USED = {5: 3, 22: 6, 34: 7, 9: 4, 23: 8, 28: 9, 10: 4, 24: 10, 14: 5, 27: 13, 37: 14, 13: 6, 31: 12, 26: 15, 32: 18, 12: 8, 25: 20, 29: 27}
_ORDER = sides_upwards_first(23, 24, 25, 26, 21, 22, 20)
_SIDES: dict[int, list[tuple[int, ...]]] = {  # of the linear type: corners of the sides 1, 2, ...
    5: [(0, 1), (1, 2), (2, 0)],
    9: [(0, 1), (1, 2), (2, 3), (3, 0)],
    10: [(0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 2, 1)],
    12: [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (0, 3, 2, 1), (4, 5, 6, 7)],
    13: [(0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2), (0, 2, 1), (3, 4, 5)],
    14: [(0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 4, 3), (0, 3, 2, 1)],
}
_COUNTS = {"eb": "num_el_blk", "ss": "num_side_sets", "els": "num_elem_sets"}
_WAY_ON = "Cubit, meshio or SEACAS' ejoin can write it anew"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Blocks are regions by their ids; side sets and sets of elements are groups; all with their names."""
    try:
        return _Reading(Variables(path), source).raw
    except ImportError as error:
        raise MeshError(source, "it is a netCDF-4 file, and h5py is not installed", "pip install h5py") from error
    except (KeyError, ValueError, IndexError, OSError, struct.error) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as Exodus II is written ({error})", _WAY_ON) from error


class _Reading:
    """The blocks of a file, then its sets."""

    def __init__(self, file: Variables, source: str) -> None:
        self.file, self.source = file, source
        self.points = _points_of(file)
        self.parts: list[Cells] = []
        self.labels: list[Indices] = []
        self.shells: list[Any] = []  # whether each cell of a block is a shell, whose first two sides are itself, seen from either side
        self.blocks: list[tuple[str, int, int]] = []  # name, id and number of cells
        for i, (name, number) in enumerate(self._named("eb"), 1):
            if f"connect{i}" in file:
                self._add_block(i, name, number)
            elif f"ebconn{i}" in file or f"fbconn{i}" in file:
                raise MeshError(source, f"the block '{name}' has polyhedra by their faces", "VTK may read it")
        self.raw = Raw(self.points, linear.joined(self.parts), source=source, reader="NumPy")
        self._add_regions()
        self._add_sets()

    def _named(self, kind: str) -> list[tuple[str, int]]:
        """Names and ids of the blocks or sets of a kind; a name is the id where there is none."""
        count = self.file.dimensions.get(_COUNTS[kind], 0)
        ids = self.file.array(f"{kind}_prop1").tolist() if f"{kind}_prop1" in self.file else list(range(1, count + 1))
        names = self.file.texts(f"{kind}_names") + [""] * len(ids)
        return [(name or str(number), int(number)) for name, number in zip(names, ids)]

    def _add_block(self, i: int, name: str, number: int) -> None:
        rows = np.asarray(self.file.array(f"connect{i}"), np.int64) - 1
        title = self.file.attribute(f"connect{i}", "elem_type")
        kind = _TYPES.get(title[:3].upper(), {}).get(rows.shape[1])
        if kind is None and title[:3].upper() in ("SPH", "CIR", "TRU", "BEA", "BAR", "EDG"):
            kind = 1 if title[:1].upper() in "SC" else 3
            rows = rows[:, : 1 if kind == 1 else 2]
        if kind is None:
            bezier = ": Bezier cells have control points in place of corners" if title[:3].upper() == "BEX" else ""
            raise MeshError(self.source, f"{len(rows)} cells have the type '{title}'{bezier}", "its cells have to be divided into linear ones first")
        rows = rows[:, : _USED.get(kind, rows.shape[1])]
        self.parts.append(linear.uniform(kind, rows[:, _ORDER[kind]] if kind in _ORDER else rows))
        is_shell = "SHELL" in title.upper() or (title[:3].upper() == "TRI" and self.points.shape[1] == 3)
        self.shells.append(np.full(len(rows), is_shell))
        self.labels.append(np.full(len(rows), number, np.int64))
        self.blocks.append((name, number, len(rows)))

    def _add_regions(self) -> None:
        start = 0
        highest = int(linear.DIMENSION[self.raw.cells.types].max(initial=0))
        for name, number, count in self.blocks:
            self.raw.groups[name] = np.concatenate([self.raw.groups.get(name, np.empty(0, np.int64)), np.arange(start, start + count)])
            if count and linear.DIMENSION[self.raw.cells.types[start]] == highest:
                self.raw.region_names[name] = number
            start += count
        if self.labels:
            self.raw.regions = np.concatenate(self.labels)

    def _add_sets(self) -> None:
        for i, (name, number) in enumerate(self._named("ss"), 1):
            if f"elem_ss{i}" in self.file:
                elements, sides = (np.asarray(self.file.array(f"{what}_ss{i}"), np.int64) - 1 for what in ("elem", "side"))
                self._add_side_set(name, number, elements, sides)
        for i, (name, _) in enumerate(self._named("els"), 1):
            if f"elem_els{i}" in self.file:
                self.raw.groups[name] = np.unique(np.asarray(self.file.array(f"elem_els{i}"), np.int64) - 1)

    def _add_side_set(self, name: str, number: int, elements: Indices, sides: Indices) -> None:
        cells = self.raw.cells
        is_shell = np.concatenate([np.empty(0, np.bool_), *self.shells])
        faces: list[Indices] = []
        for cell, side in zip(elements.tolist(), sides.tolist()):
            kind = linear.corner_type(int(cells.types[cell]))
            corners: list[tuple[int, ...]] = _SIDES.get(kind, [])
            if is_shell[cell] and corners:
                corners = [tuple(range(len(corners))), tuple(range(len(corners))), *corners]
            if not corners:
                continue
            if not 0 <= side < len(corners):
                raise MeshError(self.source, f"the side set '{name}' names side {side + 1} of cell {cell}", _WAY_ON)
            faces.append(cells.flat[cells.offsets[cell] + np.array(corners[side])])
        if faces:
            self.raw.sides.append((name, offsets_of([len(face) for face in faces]), np.concatenate(faces)))
            self.raw.numbers[name] = number


def _points_of(file: Variables) -> Any:
    if "coord" in file:
        return np.asarray(file.array("coord"), np.float64).T
    columns = [np.asarray(file.array(f"coord{axis}"), np.float64) for axis in "xyz" if f"coord{axis}" in file]
    if len(columns) == 1:
        columns.append(np.zeros(len(columns[0])))
    return np.stack(columns, axis=1)
