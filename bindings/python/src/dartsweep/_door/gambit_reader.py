"""Neutral files of Gambit (.neu): groups of elements are regions, boundary conditions of faces are groups, all with their names."""

from __future__ import annotations

import collections
import re
from typing import Any

import numpy as np

from . import linear
from .error import MeshError
from .mesh import Indices
from .ragged import offsets_of
from .raw import Raw

_TYPES = {  # of Gambit's type and number of nodes: VTK's type, and the order of VTK
    (2, 4): (9, [0, 1, 2, 3]),
    (3, 3): (5, [0, 1, 2]),
    (4, 8): (12, [0, 1, 3, 2, 4, 5, 7, 6]),  # line by line
    (5, 6): (13, [0, 1, 2, 3, 4, 5]),
    (6, 4): (10, [0, 1, 2, 3]),
    (7, 5): (14, [0, 1, 3, 2, 4]),
}
_SIDES: dict[int, list[tuple[int, ...]]] = {  # of Gambit's type: its own corners of the sides 1, 2, ...
    2: [(0, 1), (1, 2), (2, 3), (3, 0)],
    3: [(0, 1), (1, 2), (2, 0)],
    4: [(0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6), (1, 0, 2, 3), (4, 5, 7, 6)],
    5: [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5), (0, 2, 1), (3, 4, 5)],
    6: [(1, 0, 2), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    7: [(0, 2, 3, 1), (0, 1, 4), (1, 3, 4), (3, 2, 4), (2, 0, 4)],
}
_OF_ELEMENTS = 1
_WAY_ON = "Gambit can write the mesh for Fluent"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file."""
    with open(path, encoding="latin-1") as file:
        sections = _sections(file.read())
    try:
        return _raw_of(sections, source)
    except (ValueError, IndexError, KeyError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as Gambit writes it ({error})", _WAY_ON) from error


def _sections(text: str) -> list[tuple[str, list[str]]]:
    """Titles, without the version behind them, and the lines below."""
    made = []
    for part in re.split(r"(?m)^ *ENDOFSECTION *$\n?", text):
        lines = [line for line in part.splitlines() if line.strip()]
        if lines:
            made.append((lines[0].strip().rpartition(" ")[0].strip(), lines[1:]))
    return made


def _raw_of(sections: list[tuple[str, list[str]]], source: str) -> Raw:
    table = np.array([line.split() for title, lines in sections if title == "NODAL COORDINATES" for line in lines], np.float64)
    index = {number: i for i, number in enumerate(table[:, 0].astype(np.int64).tolist())}
    words = [word for title, lines in sections if title == "ELEMENTS/CELLS" for line in lines for word in line.split()]
    numbers, kinds, nodes = _elements(list(map(int, words)), index)
    raw = Raw(table[:, 1:], _cells(kinds, nodes, source), source=source, reader="NumPy")
    place = {number: i for i, number in enumerate(numbers)}
    for title, lines in sections:
        if title == "ELEMENT GROUP":
            _add_group(raw, lines, place)
        elif title == "BOUNDARY CONDITIONS":
            _add_condition(raw, lines, place, kinds, nodes)
    return raw


def _elements(words: list[int], index: dict[int, int]) -> tuple[list[int], list[int], list[Indices]]:
    """Numbers, Gambit's types and nodes of all elements."""
    numbers, kinds, nodes, at = [], [], [], 0
    while at < len(words):
        number, kind, width = words[at : at + 3]
        numbers.append(number)
        kinds.append(kind)
        nodes.append(np.array([index[node] for node in words[at + 3 : at + 3 + width]], np.int64))
        at += 3 + width
    return numbers, kinds, nodes


def _cells(kinds: list[int], nodes: list[Indices], source: str) -> linear.Cells:
    known = [(3, [0, 1]) if kind == 1 else _TYPES.get((kind, len(own)), (0, [])) for kind, own in zip(kinds, nodes)]
    unknown = collections.Counter(len(own) for (kind, _), own in zip(known, nodes) if kind == 0)
    if unknown:
        width, count = unknown.most_common(1)[0]
        raise MeshError(source, f"{count} cells of {width} nodes have a type of higher order", _WAY_ON)
    rows = [own[order] for (_, order), own in zip(known, nodes)]
    types = np.array([kind for kind, _ in known], np.uint8)
    return linear.Cells(types, offsets_of([len(row) for row in rows]), np.concatenate([np.empty(0, np.int64), *rows]))


def _add_group(raw: Raw, lines: list[str], place: dict[int, int]) -> None:
    words = lines[0].split()
    number, flags, name = int(words[1]), int(words[-1]), lines[1].strip()
    below = [int(word) for line in lines[2:] for word in line.split()]  # flags of a solver, then the elements
    members = np.array([place[word] for word in below[flags:]], np.int64)
    if raw.regions is None:
        raw.regions = np.zeros(len(raw.cells.types), np.int64)
    raw.regions[members] = number
    raw.groups[name], raw.region_names[name] = members, number


def _add_condition(raw: Raw, lines: list[str], place: dict[int, int], kinds: list[int], nodes: list[Indices]) -> None:
    words: list[Any] = lines[0].split()
    if int(words[-4]) != _OF_ELEMENTS:  # of nodes
        return
    name = " ".join(words[:-4])
    faces = []
    for line in lines[1 : 1 + int(words[-3])]:
        number, _, side = (int(word) for word in line.split()[:3])
        cell = place[number]
        faces.append(nodes[cell][list(_SIDES[kinds[cell]][side - 1])])
    raw.sides.append((name, offsets_of([len(face) for face in faces]), np.concatenate([np.empty(0, np.int64), *faces])))
