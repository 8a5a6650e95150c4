"""Universal files of I-deas (.unv), as Salome, FreeCAD and Netgen write them: groups of elements are kept, which Gmsh leaves out."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from . import linear
from .error import MeshError
from .ragged import offsets_of
from .raw import Raw

_LINEAR = {  # of the descriptor of a finite element: VTK's type
    **dict.fromkeys((11, 21, 22, 23, 24), 3),
    **dict.fromkeys((41, 51, 61, 74, 81, 91), 5),
    **dict.fromkeys((44, 54, 64, 71, 84, 94), 9),
    **{111: 10, 112: 13, 115: 12, 161: 1, 136: 3},
}
_QUADRATIC = {  # VTK's type, and where its corners, then its middles, are in the way round that the file goes
    **dict.fromkeys((42, 52, 62, 72, 82, 92), (22, [0, 2, 4, 1, 3, 5])),
    **dict.fromkeys((45, 55, 65, 75, 85, 95), (23, [0, 2, 4, 6, 1, 3, 5, 7])),
    300: (28, [0, 2, 4, 6, 1, 3, 5, 7, 8]),
    118: (24, [0, 2, 4, 9, 1, 3, 5, 6, 7, 8]),
    113: (26, [0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8]),
    116: (25, [0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11]),
}
_BEAMS = (11, 21, 22, 23, 24)
_NODES, _OLD_NODES, _ELEMENTS = ("2411", "781"), ("15",), ("2412", "780")
_GROUPS = {"2467": 4, "2477": 4, "2452": 4, "2435": 4, "2432": 4, "2430": 2, "2429": 2, "2420": 0, "752": 4}  # numbers for each member
_OF_ELEMENT = 8
_WAY_ON = "Gmsh or Salome can write the mesh anew"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Groups are kept by name; where there are none, properties are regions."""
    try:
        with open(path, encoding="latin-1") as file:
            return _Reading(file, source).raw()
    except (ValueError, IndexError, KeyError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as I-deas writes it ({error})", _WAY_ON) from error


class _Reading:
    """Nodes, elements and groups of a file."""

    def __init__(self, file: Iterator[str], source: str) -> None:
        self.source = source
        self.numbers: list[int] = []
        self.places: list[list[float]] = []
        self.elements: list[tuple[int, int, int, list[int]]] = []  # number, descriptor, property and nodes
        self.groups: dict[str, list[int]] = {}
        for title, lines in _sets(file):
            if title in _NODES:
                self._add_nodes(lines[::2], lines[1::2])
            elif title in _OLD_NODES:
                self._add_nodes(lines, [line.split(None, 4)[4] for line in lines])
            elif title in _ELEMENTS:
                self._add_elements(lines)
            elif _GROUPS.get(title):
                self._add_groups(lines, _GROUPS[title])

    def _add_nodes(self, heads: list[str], places: list[str]) -> None:
        self.numbers += [int(head.split()[0]) for head in heads]
        self.places += [[float(word.replace("D", "E").replace("d", "e")) for word in place.split()[:3]] for place in places]

    def _add_elements(self, lines: list[str]) -> None:
        rows = iter(lines)
        for line in rows:
            head = [int(word) for word in line.split()]
            if head[1] in _BEAMS:
                next(rows, "")  # how its section is turned
            nodes: list[int] = []
            while len(nodes) < head[-1]:
                nodes += [int(word) for word in next(rows).split()]
            self.elements.append((head[0], head[1], head[2], nodes))

    def _add_groups(self, lines: list[str], width: int) -> None:
        rows = iter(lines)
        for line in rows:
            head = [int(word) for word in line.split()]
            if len(head) < 8:
                continue
            name = next(rows).strip() or str(head[0])
            words: list[int] = []
            while len(words) < head[7] * width:
                words += [int(word) for word in next(rows).split()]
            members = [words[at + 1] for at in range(0, len(words) - 1, width) if words[at] == _OF_ELEMENT]
            self.groups.setdefault(name, []).extend(members)

    def raw(self) -> Raw:
        index = {number: i for i, number in enumerate(self.numbers)}
        rows, kinds = [], []
        for _, descriptor, _, nodes in self.elements:
            kind, order = _QUADRATIC.get(descriptor, (_LINEAR.get(descriptor, 0), None))
            if kind == 0 and len(nodes) <= 3:
                kind, order = (1, [0]) if len(nodes) == 1 else (3, [0, -1])
            if kind == 0:
                raise MeshError(self.source, f"elements have the type {descriptor}, with {len(nodes)} nodes", _WAY_ON)
            rows.append(np.array([index[nodes[i]] for i in (range(len(nodes)) if order is None else order)], np.int64))
            kinds.append(kind)
        flat = np.concatenate([np.empty(0, np.int64), *rows])
        cells = linear.Cells(np.array(kinds, np.uint8), offsets_of([len(row) for row in rows]), flat)
        raw = Raw(np.array(self.places, np.float64).reshape(-1, 3), cells, source=self.source, reader="NumPy")
        self._add_names(raw)
        return raw

    def _add_names(self, raw: Raw) -> None:
        place = {number: i for i, (number, *_) in enumerate(self.elements)}
        for name, members in self.groups.items():
            found = np.unique(np.array([place[number] for number in members if number in place], np.int64))
            if len(found):
                raw.groups[name] = found
        highest = linear.DIMENSION[raw.cells.types] == linear.DIMENSION[raw.cells.types].max(initial=0)
        properties = np.array([element[2] for element in self.elements], np.int64)
        if not any(np.any(highest[members]) for members in raw.groups.values()) and len(np.unique(properties[highest])) > 1:
            raw.regions = properties


def _sets(file: Iterator[str]) -> Iterator[tuple[str, list[str]]]:
    """Numbers of the data sets between two lines of -1, and their lines."""
    title, lines = "", list[str]()
    for line in file:
        word = line.strip()
        if word != "-1":
            if title == "?":
                title = word.split()[0] if word else ""
            elif title:
                lines.append(line)
        elif title in ("", "?"):
            title, lines = "?", []
        else:
            yield title, lines
            title, lines = "", []
