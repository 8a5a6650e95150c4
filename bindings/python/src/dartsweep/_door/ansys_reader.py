"""Archives of Ansys (.cdb, and the input files of Workbench): blocks of nodes, elements and components."""

from __future__ import annotations

import collections
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import degenerate, linear
from .error import CutShort, MeshError
from .mesh import Indices
from .raw import Raw

_BRICKS = {5, 30, 45, 46, 62, 64, 65, 69, 70, 73, 80, 96, 97, 107, 164, 185, 190, 215, 225, 278}
_BRICKS |= {89, 90, 95, 117, 120, 122, 128, 147, 186, 191, 216, 220, 226, 231, 236, 239, 279}
_TETRAHEDRA = {72, 87, 92, 98, 119, 123, 127, 148, 168, 187, 217, 221, 227, 232, 237, 240, 285, 291}
_FACES = {28, 41, 43, 63, 91, 93, 99, 131, 132, 150, 157, 163, 181, 281}
_FACES |= {2, 13, 25, 35, 42, 53, 55, 67, 75, 77, 78, 82, 83, 121, 145, 146, 162, 182, 183, 212, 213, 222, 223, 230, 233, 238, 292, 293}
_LEFT_OUT = {1, 3, 4, 8, 9, 10, 11, 14, 16, 17, 18, 21, 23, 24, 27, 31, 32, 33, 34, 37, 39, 40, 44, 47, 50, 54, 59, 60, 68, 71, 110, 111}
_LEFT_OUT |= {*range(151, 157), *range(169, 181), 184, 188, 189, 201, 250, 251, 257, 263, 264, 265, 280, 288, 289, 290}
_KINDS = {name: kind for kind, names in enumerate((_LEFT_OUT, _FACES, _TETRAHEDRA, _BRICKS)) for name in names}
_MESHING_ONLY = {**dict.fromkeys(range(4), 0), **dict.fromkeys(range(4, 8), 1), 8: 2, 9: 2, 10: 3, 11: 3}
"""The kind of an element MESH200 by its first key option."""
_SHAPES = {1: (3, 4, 6, 8), 2: (4, 10), 3: (8, 20)}
"""Numbers of nodes that elements of each kind have."""
_FORMAT = re.compile(r"\(\s*(\d*)i(\d+)(?:\.\d+)?\s*(?:,\s*\d*[edfg](\d+))?", re.IGNORECASE)
_WAY_ON = "CDWRITE,DB writes such a file, in blocks"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Numbers of materials are regions, components of elements are groups."""
    made = _Reading(source)
    try:
        with open(path, encoding="latin-1") as file:
            made.run(iter(file))
        return made.raw()
    except (ValueError, IndexError, KeyError, AttributeError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as Ansys writes it ({error})", _WAY_ON) from error


class _Reading:
    """What has been read of a file up to some line."""

    def __init__(self, source: str) -> None:
        self.source = source
        self.nodes: list[list[float]] = []
        self.elements: list[list[int]] = []  # material, type, real constant, section, number, and nodes
        self.routines: dict[int, int] = {}  # by type
        self.options: dict[int, int] = {}  # the first key option, by type
        self.components: list[tuple[str, list[int]]] = []
        self.compact = 0
        self.cornered = 0

    def run(self, lines: Iterator[str]) -> None:
        for line in lines:
            words = [word.strip() for word in line.partition("!")[0].split(",")]
            command = words[0].upper()
            if command == "NBLOCK":
                self._add_nodes(lines)
            elif command == "EBLOCK":
                self._add_elements(lines, len(words) > 2 and words[2].upper().startswith("SOLID"))
            elif command == "CMBLOCK":
                self._add_component(words, lines)
            elif command == "ETBLOCK":
                self._add_types(lines)
            elif command == "ET" and len(words) > 2:
                self._add_type(words[1], words[2], words[3] if len(words) > 3 else "")
            elif command.startswith("KEYOP") and len(words) > 3 and words[2] == "1" and words[1].isdigit():
                self.options[int(words[1])] = _option(words[3])

    def _add_type(self, number: str, name: str, option: str) -> None:
        """What was said of the type before does not hold for it."""
        routine = re.search(r"\d+$", name)
        if number.isdigit() and routine:  # not a parameter
            self.routines[int(number)] = int(routine.group())
            self.options[int(number)] = _option(option)

    def _add_types(self, lines: Iterator[str]) -> None:
        _next(lines, self.source)
        for line in _until_end(lines, self.source):
            words = line.split()
            self._add_type(words[0], words[1], words[2] if len(words) > 2 else "")

    def _add_nodes(self, lines: Iterator[str]) -> None:
        count, width, real = _widths(_next(lines, self.source))
        start = count * width
        for line in _until_end(lines, self.source):
            row = line.rstrip()
            words = [row[start + real * i : start + real * (i + 1)].strip().upper().replace("D", "E") for i in range(3)]
            self.nodes.append([float(row[:width]), *(float(word or "0") for word in words)])

    def _add_elements(self, lines: Iterator[str], is_solid: bool) -> None:
        _, width, _ = _widths(_next(lines, self.source))
        rows = _until_end(lines, self.source)
        for line in rows:
            if not is_solid:
                self.compact += 1
                continue
            row = _integers(line, width)
            count, nodes = row[8], row[11:]
            while len(nodes) < count:
                nodes += _integers(_next(rows, self.source), width)
            self.elements.append([*row[:4], row[10], *nodes[:count]])

    def _add_component(self, words: list[str], lines: Iterator[str]) -> None:
        per_row, width, _ = _widths(_next(lines, self.source))
        count = int(words[3])
        numbers: list[int] = []
        for _ in range(-(-count // per_row)):
            numbers += _integers(_next(lines, self.source), width)
        if words[2].upper().startswith("ELEM"):
            self.components.append((words[1], numbers[:count]))

    def raw(self) -> Raw:
        if not self.nodes or not self.elements:
            raise MeshError(self.source, "it has no NBLOCK with nodes, or no EBLOCK of the kind SOLID with elements", _WAY_ON)
        least = min(min(row[0] for row in self.nodes), min(row[4] for row in self.elements))
        if least < 1:
            raise MeshError(self.source, f"a node or an element has the number {int(least)}", "their numbers begin with 1")
        nodes = np.array(self.nodes, np.float64)
        index = np.full(int(nodes[:, 0].max()) + 1, -1, np.int64)
        index[nodes[:, 0].astype(np.int64)] = np.arange(len(nodes))
        groups: dict[tuple[int, int], list[int]] = {}
        left_out: collections.Counter[int] = collections.Counter()
        for place, element in enumerate(self.elements):
            kind = self._kind_of(element[1])
            if kind == 0:
                left_out[self.routines[element[1]]] += 1
            else:
                groups.setdefault((kind, len(element) - 5), []).append(place)
        parts = [self._cells(kind, np.array([self.elements[i][5:] for i in own]), index) for (kind, _), own in groups.items()]
        places = np.concatenate([np.empty(0, np.int64), *(np.array(own, np.int64) for own in groups.values())])
        raw = Raw(nodes[:, 1:], linear.joined(parts).some(np.argsort(places, kind="stable")), source=self.source, reader="NumPy")
        self._add_labels(raw, np.sort(places))
        self._note(raw, left_out)
        return raw

    def _kind_of(self, number: int) -> int:
        """0: no part of the mesh; otherwise a key of _SHAPES."""
        if number not in self.routines:
            raise MeshError(self.source, f"its elements have a type {number} that no ET names", _WAY_ON)
        routine = self.routines[number]
        kind = _MESHING_ONLY.get(self.options.get(number, 0)) if routine == 200 else _KINDS.get(routine)
        if kind is None:
            raise MeshError(self.source, f"its elements have the type {routine} of Ansys", "they have to be solids or shells, such as SOLID185 or SHELL181")
        return kind

    def _cells(self, kind: int, rows: Any, index: Indices) -> linear.Cells:
        width = rows.shape[1]
        if width not in _SHAPES[kind]:
            raise MeshError(self.source, f"{len(rows)} elements have {width} nodes, which their type has not", _WAY_ON)
        corners = next(count for count in ((3, 4) if kind == 1 else _SHAPES[kind]) if 2 * count >= width or kind > 1)
        if np.any(rows[:, :corners] < 1) or rows.max() >= len(index) or np.any((rows > 0) & (index[rows] < 0)):
            raise MeshError(self.source, "an element names a node that is not there", "the file is damaged")
        if np.any(rows == 0):  # sides without a node in the middle
            whole = np.all(rows > 0, axis=1)
            self.cornered += int(np.count_nonzero(np.any(rows[~whole][:, corners:] > 0, axis=1)))
            parts = [self._cells(kind, own, index) for own in (rows[whole], rows[~whole][:, :corners]) if len(own)]
            order = np.concatenate([np.flatnonzero(whole), np.flatnonzero(~whole)])
            return linear.joined(parts).some(np.argsort(order, kind="stable"))
        places = index[rows]
        if kind == 3:
            return degenerate.bricks(places)
        if kind == 1 and width in (4, 8):
            return degenerate.quads(places)
        return linear.uniform({(2, 4): 10, (2, 10): 24, (1, 3): 5, (1, 6): 22}[kind, width], places)

    def _add_labels(self, raw: Raw, places: Indices) -> None:
        table = np.array([self.elements[i][:5] for i in places.tolist()], np.int64).reshape(-1, 5)
        raw.regions = table[:, 0]
        raw.data = {name: table[:, i] for i, name in enumerate(("material", "type", "real", "section"))}
        of_element = np.full(int(table[:, 4].max(initial=0)) + 1, -1, np.int64)
        of_element[table[:, 4]] = np.arange(len(table))
        for name, numbers in self.components:
            members = of_element[np.array(list(_spread(numbers, len(of_element))), np.int64)]
            if np.any(members >= 0):
                raw.groups[name] = np.unique(members[members >= 0])

    def _note(self, raw: Raw, left_out: collections.Counter[int]) -> None:
        if left_out:
            names = ", ".join(str(routine) for routine in sorted(left_out))
            raw.notes.append(f"{sum(left_out.values())} elements of Ansys's types {names} (contacts, lines, points) were left out")
        if self.compact:
            raw.notes.append(f"{self.compact} elements of blocks without SOLID, as contacts and loads have, were left out")
        if self.cornered:
            raw.notes.append(f"{self.cornered} elements with nodes in the middle of some sides were taken by their corners")


def _next(lines: Iterator[str], source: str) -> str:
    line = next(lines, None)
    if line is None:
        raise CutShort(source, "it ends within a block", "the file is damaged")
    return line


def _option(word: str) -> int:
    """A key option; -1: a parameter."""
    try:
        return int(float(word or "0"))
    except ValueError:
        return -1


def _until_end(lines: Iterator[str], source: str) -> Iterator[str]:
    """The rows of a block."""
    for line in lines:
        if line.lstrip().startswith("-1") or line[:2].upper() == "N,":
            return
        yield line
    raise CutShort(source, "it ends within a block", "the file is damaged")


def _widths(line: str) -> tuple[int, int, int]:
    """How many integers a row begins with, their width, and that of the reals behind them."""
    found = _FORMAT.match(line.strip())
    if found is None:
        raise ValueError(f"the format {line.strip()!r}")
    return int(found.group(1) or "1"), int(found.group(2)), int(found.group(3) or "0")


def _integers(line: str, width: int) -> list[int]:
    row = line.rstrip()
    return [int(row[i : i + width]) for i in range(0, len(row), width)]


def _spread(numbers: list[int], end: int) -> Iterator[int]:
    """Numbers of a component below an end: one that is negative ends a range which the number before it begins."""
    before = 0
    for number in numbers:
        yield from range(number if number > 0 else abs(before) + 1, min(abs(number) + 1, end))
        before = number
