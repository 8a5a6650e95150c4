"""Keyword files of LS-DYNA: nodes, solids, thick shells and shells, with parts, sets and segments."""

from __future__ import annotations

import dataclasses
import itertools
import os
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import degenerate, linear
from .error import MeshError
from .mesh import Indices
from .ragged import groups_by_number, offsets_of
from .raw import Raw, free_name

_KEYWORD = re.compile(r"\*([A-Z0-9_]+)[ \t]*([-+%]?)")
_ROWS_BEHIND = {"ORTHO": 2, "DOF": 1, "THICKNESS": 1, "BETA": 1, "MCID": 1, "OFFSET": 1}
"""Rows of an element behind that of its nodes, by options; THICKNESS, BETA and MCID share one."""
_WITHOUT_ROWS = ("TET4TOTET10", "H8TOH20", "H8TOH27", "H8TOH64", "FORMAT2")
"""Options by which the solver adds nodes, and one that says that nodes are in a row of their own."""
_HIGHER = {"H20": (20, 8), "H27": (27, 8), "T15": (15, 4), "T20": (20, 4)}
"""Numbers of nodes and corners."""
_MOVING = ("NODE_TRANSFORM", "NODE_MERGE", "ELEMENT_SOLID_NURBS", "ELEMENT_SHELL_NURBS", "ELEMENT_GENERALIZED", "ELEMENT_INTERPOLATION")
_WAY_ON = "LS-PrePost can write it as one file, in the standard format"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file and of those that it includes. Parts are regions, sets are groups."""
    try:
        with open(path, encoding="latin-1") as file:
            made = _Reading(source, "created by Gmsh" in file.readline())
        for block in _blocks(path, source, [os.path.dirname(path)], (), ("", "")):
            made.take(block)
        return made.raw()
    except (ValueError, IndexError, OverflowError, OSError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as LS-DYNA reads it ({error})", _WAY_ON) from error


@dataclasses.dataclass
class _Block:
    """A keyword and its rows."""

    name: str
    is_long: bool
    """Whether all fields have 20 columns."""
    has_ten: bool
    """Whether numbers of nodes and elements have 10 columns."""
    rows: list[str]

    def fields(self, row: str, widths: tuple[int, ...]) -> list[str]:
        """The fields of a row, as many as there are widths; they are divided by commas, or by columns."""
        if "," in row:
            words = row.split(",")
            return [word.strip() for word in words[: len(widths)]] + [""] * (len(widths) - len(words))
        ends = list(itertools.accumulate([20] * len(widths) if self.is_long else widths))
        return [row[start:end].strip() for start, end in zip([0, *ends], ends)]

    def integers(self, row: str, count: int) -> list[int]:
        """Numbers of nodes, elements and parts; 0 where there are none."""
        return [int(word or "0") for word in self.fields(row, (10 if self.has_ten else 8,) * count)]

    def of_set(self, row: str, count: int = 8) -> list[int]:
        """Numbers in a set, which always have at least 10 columns."""
        return [int(word or "0") for word in self.fields(row, (10,) * count)]

    def filled(self) -> list[str]:
        return [row for row in self.rows if row.strip()]

    def whole(self, step: int, with_blank: bool = True) -> list[str]:
        """Rows of elements that have as many rows each. Blank ones may count, as they are zeros, but those behind the last element do not."""
        rows = self.rows if with_blank else self.filled()
        filled = [i for i, row in enumerate(rows, 1) if row.strip()]
        end = -(-filled[-1] // step) * step if filled else 0
        if end > len(rows):
            raise ValueError(f"*{self.name} has {step} rows for each element, but the last one has fewer")
        return rows[:end]


class _Reading:
    """What has been read of a file up to some block."""

    def __init__(self, source: str, is_of_gmsh: bool) -> None:
        self.source, self.is_of_gmsh = source, is_of_gmsh
        self.nodes: list[Any] = []
        self.cells: list[tuple[str, int, Any]] = []  # SOLID, TSHELL or SHELL, the type of VTK or 0 for bricks and quads; number, part and nodes
        self.titles: dict[int, str] = {}  # of parts
        self.sets: list[tuple[str, str, list[tuple[int, int]]]] = []  # SOLID, TSHELL, SHELL or PART; name; first and last of each range of numbers
        self.segments: list[tuple[str, list[list[int]]]] = []
        self.notes: list[str] = []

    def take(self, block: _Block) -> None:
        name = block.name
        if name.startswith(_MOVING):
            raise MeshError(self.source, f"*{name} makes or moves what it has", _WAY_ON)
        if name == "NODE":
            self._add_nodes(block)
        elif re.match(r"ELEMENT_T?SHELL(_|$)|ELEMENT_SOLID(_|$)", name):
            self._add_elements(block, name.split("_")[1], name.split("_")[2:])
        elif re.match("PART(_|$)", name) and not re.match("PART_(MOVE|MODES|DUPLICATE|ANNEAL|ADAPT|SENSOR|STACKED|COMPOSITE)", name):
            self._add_titles(block)
        elif re.match("SET_(SOLID|SHELL|TSHELL|PART|SEGMENT)(_|$)", name):
            self._add_set(block, name.split("_")[1], name.split("_")[2:])

    def _add_nodes(self, block: _Block) -> None:
        widths = (10 if block.has_ten else 8, 16, 16, 16)
        rows = [block.fields(row, widths) for row in block.filled()]
        self.nodes.append(np.array([[_real(word) for word in row] for row in rows], np.float64).reshape(-1, 4))

    def _add_elements(self, block: _Block, kind: str, options: list[str]) -> None:
        higher = [option for option in options if option in _HIGHER]
        for option in options:
            if option not in _ROWS_BEHIND and option not in _WITHOUT_ROWS and option not in _HIGHER:
                raise MeshError(self.source, f"its elements have the option {option} of *{block.name}", "they have to be plain solids or shells")
        behind = sum(_ROWS_BEHIND.get(option, 0) for option in {"THICKNESS" if option in ("BETA", "MCID") else option for option in options})
        rows = _continued(block.filled()) if self.is_of_gmsh else block.filled()
        if self.is_of_gmsh and kind == "SOLID":
            self._add_of_gmsh([[int(word) for word in row.split(",")] for row in rows])
        elif higher:
            self._add_higher(block, kind, behind, *_HIGHER[higher[0]])
        elif rows and not any(block.integers(rows[0], 10)[2:]):  # nodes are in a row of their own
            rows = block.whole(2 + behind, behind > 0)
            first = [block.integers(row, 2) for row in rows[:: 2 + behind]]
            self._add_solids(kind, [own + block.integers(row, 10) for own, row in zip(first, rows[1 :: 2 + behind])])
        else:
            rows = block.whole(1 + behind) if behind else rows
            made = [block.integers(row, 10) for row in rows[:: 1 + behind]]
            if kind == "SHELL":
                self._add_shells(made)
            else:
                self._add_solids(kind, [row + [0, 0] for row in made])

    def _add_of_gmsh(self, rows: list[list[int]]) -> None:
        """Wedges are written as a b c d e e f f, where a b c and d e f are the triangles. Ten nodes follow the number and the part in one row."""
        for row in rows:
            if len(row) == 10 and row[6] == row[7] != row[8] == row[9]:
                row[2:] = [*row[2:5], row[4], row[5], row[6], row[8], row[8]]
        if any(len(row) not in (10, 12) for row in rows):
            raise MeshError(self.source, "it has solids of more than ten nodes, which Gmsh writes as LS-DYNA does not read them", "Gmsh can write it as .msh")
        self._add_solids("SOLID", [row + [0] * (12 - len(row)) for row in rows])

    def _add_higher(self, block: _Block, kind: str, behind: int, nodes: int, corners: int) -> None:
        """Corners only: they come first."""
        step = 1 + -(-nodes // 10) + behind
        rows = block.whole(step, behind > 0)
        made = [block.integers(head, 2) + block.integers(row, corners) for head, row in zip(rows[::step], rows[1::step])]
        self.notes.append(f"{len(made)} solids of {nodes} nodes were taken by their corners")
        self._add_solids(kind, [row + ([row[-1]] * 4 if corners == 4 else []) + [0, 0] for row in made])

    def _add_solids(self, kind: str, rows: list[list[int]]) -> None:
        """Rows of number, part and ten nodes; bricks have 0 as the last two."""
        table = np.array(rows, np.int64).reshape(-1, 12)
        has_four = np.all((table[:, 6:10] == 0) | (table[:, 6:10] == table[:, 5:6]), axis=1)
        table[has_four, 6:10] = table[has_four, 5:6]
        has_ten = table[:, 11] != 0
        self.cells += [(kind, 24, table[has_ten]), (kind, 0, table[~has_ten, :10])]

    def _add_shells(self, rows: list[list[int]]) -> None:
        """Rows of number, part and eight nodes, of which the last four are in the middle of sides, or 0."""
        table = np.array(rows, np.int64).reshape(-1, 10)
        table[:, 5] = np.where(table[:, 5] == 0, table[:, 4], table[:, 5])
        has_eight = np.all(table[:, 6:] != 0, axis=1) & (table[:, 4] != table[:, 5])
        if cornered := np.count_nonzero(np.any(table[~has_eight, 6:] != 0, axis=1)):
            self.notes.append(f"{cornered} shells with nodes in the middle of some sides were taken by their corners")
        self.cells += [("SHELL", 0, table[has_eight]), ("SHELL", 0, table[~has_eight, :6])]

    def _add_titles(self, block: _Block) -> None:
        """A title and a row of numbers of each part; with options there are more rows of one part."""
        rows = block.rows if block.name == "PART" else block.rows[:2]
        for title, row in zip(rows[::2], rows[1::2]):
            number = block.of_set(row, 1)[0] if row.strip() else 0
            if number and title.strip():
                self.titles[number] = title.strip()

    def _add_set(self, block: _Block, kind: str, options: list[str]) -> None:
        rows = block.rows[1:] if "TITLE" in options else block.filled()
        if not rows or set(options) - {"LIST", "TITLE", "GENERATE"}:
            self.notes.append(f"a set of the kind *{block.name} was left out")
            return
        number = block.of_set(rows[0], 1)[0]
        name = block.rows[0].strip() if "TITLE" in options and block.rows[0].strip() else f"{kind.lower()} set {number}"
        if kind == "SEGMENT":
            self.segments.append((name, [block.of_set(row, 4) for row in rows[1:] if row.strip()]))
            return
        numbers = [number for row in rows[1:] for number in block.of_set(row)]
        ranges = zip(numbers[::2], numbers[1::2]) if "GENERATE" in options else zip(numbers, numbers)
        self.sets.append((kind, name, [(first, last) for first, last in ranges if first]))

    def raw(self) -> Raw:
        table = np.concatenate([np.empty((0, 4)), *self.nodes])
        index = self._index_of(table)
        parts = [self._cells(kind, own, rows, index) for own, kind, rows in self.cells if len(rows)]
        kinds = [own for own, _, rows in self.cells for _ in rows]
        heads = np.concatenate([np.empty((0, 2), np.int64), *(rows[:, :2] for _, _, rows in self.cells)])
        raw = Raw(table[:, 1:], linear.joined(parts), source=self.source, reader="NumPy", notes=self.notes)
        raw.regions = heads[:, 1]
        names = self._names_of_parts(np.unique(raw.regions).tolist())
        raw.region_names = {names[number]: number for number in self.titles}
        self._name_sheets(raw, names)
        self._add_groups(raw, np.array(kinds, str), heads)
        self._add_segments(raw, index)
        return raw

    def _index_of(self, table: Any) -> Indices:
        """The row of the node of each number, or -1."""
        numbers = table[:, 0].astype(np.int64)
        if numbers.min(initial=1) < 1:
            raise MeshError(self.source, f"a node has the number {numbers.min()}", "numbers of nodes begin with 1")
        index = np.full(int(numbers.max(initial=0)) + 1, -1, np.int64)
        index[numbers] = np.arange(len(table))
        again = np.flatnonzero(index[numbers] != np.arange(len(table)))
        moved = again[np.any(table[again] != table[index[numbers[again]]], axis=1)]
        if len(moved):
            raise MeshError(self.source, f"node {numbers[moved[0]]} is there twice, with other coordinates", "one of the two has to be left out")
        return index

    def _cells(self, kind: int, own: str, rows: Any, index: Indices) -> linear.Cells:
        places = self._places(rows[:, 2:], index)
        return linear.uniform(kind, places) if kind else degenerate.quads(places) if own == "SHELL" else degenerate.bricks(places)

    def _places(self, nodes: Any, index: Indices) -> Indices:
        if nodes.max(initial=0) >= len(index) or nodes.min(initial=0) < 0 or np.any(index[nodes] < 0):
            raise MeshError(self.source, "an element or a segment names a node that is not there", "the file is damaged, or a part of it is not included")
        made: Indices = index[nodes]
        return made

    def _names_of_parts(self, numbers: list[int]) -> dict[int, str]:
        """Titles, or numbers where there are none. Of parts with one title all but the first have their numbers behind it."""
        names: dict[int, str] = {}
        taken = set[str]()
        for number in dict.fromkeys([*self.titles, *numbers]):
            title = self.titles.get(number, str(number))
            names[number] = title if title not in taken else free_name(f"{title} (part {number})", "PART", taken)
            taken.add(names[number])
        return names

    def _name_sheets(self, raw: Raw, names: dict[int, str]) -> None:
        """Parts of shells beside solids are groups of faces."""
        dimensions = linear.DIMENSION[raw.cells.types]
        rows = np.flatnonzero(dimensions < dimensions.max(initial=0))
        for number, members in groups_by_number(raw.regions[rows]).items():
            raw.groups[names[number]] = rows[members]
            raw.numbers[names[number]] = number

    def _add_groups(self, raw: Raw, kinds: Any, heads: Indices) -> None:
        for kind, name, ranges in self.sets:
            members = np.flatnonzero(_is_within(heads[:, 1], ranges) if kind == "PART" else _is_within(heads[:, 0], ranges) & (kinds == kind))
            if len(members):
                raw.groups[free_name(name, kind, {*raw.groups, *raw.region_names})] = members

    def _add_segments(self, raw: Raw, index: Indices) -> None:
        taken = dict.fromkeys(raw.groups)
        for name, rows in self.segments:
            faces = [list(dict.fromkeys(row)) for row in rows]  # a triangle has a node twice
            nodes = np.array([node for face in faces for node in face if node], np.int64)
            name = free_name(name, "SEGMENT", taken)
            taken[name] = None
            raw.sides.append((name, offsets_of([sum(node > 0 for node in face) for face in faces]), self._places(nodes, index)))


def _continued(rows: list[str]) -> list[str]:
    """Rows with those behind them, where a comma ends a row."""
    made, goes_on = list[str](), False
    for row in rows:
        made[len(made) - goes_on :] = [made[-1] + row] if goes_on else [row]
        goes_on = row.rstrip().endswith(",")
    return made


def _is_within(numbers: Indices, ranges: list[tuple[int, int]]) -> Any:
    """Whether each number is in a range, whose first and last belong to it."""
    if not ranges:
        return np.zeros(len(numbers), np.bool_)
    first, last = np.array(sorted(ranges), np.int64).T
    before = np.searchsorted(first, numbers, side="right")  # how many ranges begin at a number or below it
    return (before > 0) & (np.maximum.accumulate(last)[before - 1] >= numbers)


def _real(word: str) -> float:
    """A number, also with an exponent that has no letter, as in 1.5-3."""
    try:
        return float(word or "0")
    except ValueError:
        return float(re.sub(r"(?<=[\d.])([-+]\d+)$", r"e\1", word.upper().replace("D", "E")))


def _blocks(path: str, source: str, folders: list[str], above: tuple[str, ...], widths: tuple[str, str]) -> Iterator[_Block]:
    """The blocks of a file and of those that it includes. widths: how *KEYWORD says that all fields are long, or numbers are."""
    if os.path.realpath(path) in above:
        raise MeshError(source, f"it includes '{os.path.basename(path)}' within itself", "the file has to be mended")
    above = (*above, os.path.realpath(path))
    for keyword, rows in _own_blocks(path, source):
        found = _KEYWORD.match(keyword)
        name, mark = (found.group(1), found.group(2)) if found else ("", "")
        if name == "KEYWORD":
            options = dict(re.findall(r"\b(LONG|I10)\s*=\s*([A-Z])", keyword))
            widths = options.get("LONG", widths[0]), options.get("I10", widths[1])
        elif name in ("INCLUDE_PATH", "INCLUDE_PATH_RELATIVE"):
            folders += [os.path.join(folders[0], row) for row in _names(rows)]
        elif name == "INCLUDE":
            for row in _names(rows):
                yield from _blocks(_found(row, [os.path.dirname(path), *folders]), source, folders, above, widths)
        elif name.startswith("INCLUDE"):
            raise MeshError(source, f"it has *{name}, which moves or numbers what it includes anew", _WAY_ON)
        else:
            is_long = mark == "+" or (mark != "-" and widths[0] in ("Y", "K"))
            yield _Block(name, is_long, mark == "%" or widths[1] == "Y", rows)


def _own_blocks(path: str, source: str) -> Iterator[tuple[str, list[str]]]:
    """Keywords of a file in capitals, and their rows without remarks."""
    keyword, rows = "", list[str]()
    with open(path, encoding="latin-1") as file:
        for line in file:
            if line.startswith("-----BEGIN PGP"):
                raise MeshError(source, "a part of it is encrypted", "whoever made it can give it in plain text")
            if line.startswith("*"):
                yield keyword, rows
                keyword, rows = line.strip().upper(), []
                if keyword == "*END":
                    return
            elif not line.startswith("$"):
                rows.append(line.rstrip().expandtabs(8))
    yield keyword, rows


def _names(rows: list[str]) -> list[str]:
    """Names of files; one goes on in the next row if it ends in a plus sign after a space."""
    text = "\n".join(row.strip() for row in rows if row.strip())
    return text.replace(" +\n", "").split("\n") if text else []


def _found(name: str, folders: list[str]) -> str:
    for folder in folders:
        for path in (os.path.join(folder, name), os.path.join(folder, name.replace("\\", "/"))):
            if os.path.isfile(path):
                return path
    raise ValueError(f"it includes '{name}', which is not there")
