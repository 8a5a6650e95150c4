"""Model parts of Kratos (.mdpa): sub-model parts are groups of elements and of conditions, properties are regions."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from . import linear
from .error import MeshError
from .mesh import Indices
from .quadratics import sides_upwards_first
from .raw import Raw

_TYPES = {  # of the dimension of cells and their number of nodes: VTK's type
    **{(1, 2): 3, (1, 3): 21, (2, 3): 5, (2, 4): 9, (2, 6): 22, (2, 8): 23, (2, 9): 28},
    **{(3, 4): 10, (3, 5): 14, (3, 6): 13, (3, 8): 12, (3, 10): 24, (3, 13): 27, (3, 15): 26, (3, 20): 25, (3, 27): 29, (0, 1): 1},
}
_ORDER = sides_upwards_first(24, 22, 21, 23, 20, 25, 26)
_THIN = re.compile(r"Shell|Membrane|Isogeometric|Surface|Plate", re.IGNORECASE)
_LINES = re.compile(r"Truss|Beam|Cable|Line|Spring|Edge|Wall|Damper", re.IGNORECASE)
_WAY_ON = "Kratos can write it for GiD or as VTK's"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file."""
    with open(path, encoding="latin-1") as file:
        lines = [line for line in (line.partition("//")[0].strip() for line in file) if line]
    try:
        return _Reading(lines, source).raw()
    except (ValueError, IndexError, KeyError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as Kratos writes it ({error})", _WAY_ON) from error


class _Reading:
    """Nodes, elements and conditions of a file, and the sub-model parts with what they name."""

    def __init__(self, lines: list[str], source: str) -> None:
        self.source = source
        self.nodes: list[list[str]] = []
        self.blocks: list[tuple[str, str, Any]] = []  # "Elements" or "Conditions", the name of the type; number, property and nodes of each
        self.parts: dict[str, dict[str, list[int]]] = {}
        open_blocks: list[tuple[str, str]] = []
        rows: list[list[str]] = []
        for line in lines:
            words = line.split()
            if words[0] == "Begin":
                open_blocks.append((words[1], words[2] if len(words) > 2 else ""))
                rows = []
            elif words[0] == "End":
                self._close(open_blocks, rows)
                open_blocks.pop()
                rows = []
            else:
                rows.append(words)

    def _close(self, open_blocks: list[tuple[str, str]], rows: list[list[str]]) -> None:
        kind, name = open_blocks[-1]
        if kind == "Nodes":
            self.nodes += [row[:4] for row in rows]
        elif kind in ("Elements", "Conditions") and rows:
            self.blocks.append((kind, name, np.array(rows, np.int64)))
        elif kind in ("SubModelPartElements", "SubModelPartConditions"):
            path = ".".join(part for block, part in open_blocks if block == "SubModelPart")
            own = self.parts.setdefault(path, {})
            own.setdefault(kind[len("SubModelPart") :], []).extend(int(word) for row in rows for word in row)

    def raw(self) -> Raw:
        table = np.array(self.nodes, np.float64).reshape(-1, 4)
        index = _index_of(table[:, 0].astype(np.int64))
        space = 3 if any("3D" in name for _, name, _ in self.blocks) else 2
        parts, labels = [], []
        place: dict[str, list[tuple[Indices, int]]] = {"Elements": [], "Conditions": []}
        count = 0
        for kind, name, rows in self.blocks:
            parts.append(self._cells(kind, name, index[rows[:, 2:]], space))
            labels.append(rows[:, 1] if kind == "Elements" else np.zeros(len(rows), np.int64))
            place[kind].append((rows[:, 0], count))
            count += len(rows)
        raw = Raw(table[:, 1:], linear.joined(parts), source=self.source, reader="NumPy")
        raw.regions = np.concatenate([np.empty(0, np.int64), *labels])
        for name, members in self.parts.items():
            found = np.concatenate([_found(place[kind], numbers) for kind, numbers in members.items()])
            if len(found):
                raw.groups[name] = np.unique(found)
        return raw

    def _cells(self, kind: str, name: str, rows: Indices, space: int) -> linear.Cells:
        """A name ends in the dimension of space and the number of nodes, such as 3D4N."""
        width = rows.shape[1]
        own = next((int(known) for known in "23" if f"{known}D" in name), space)
        dimension = own - (kind == "Conditions")
        if kind == "Elements" and own == 3 and (_THIN.search(name) or width == 3):
            dimension = 2
        if width < 3 or (_LINES.search(name) and width == 3):
            dimension = width - 1 if width < 3 else 1
        known = _TYPES.get((dimension, width))
        if known is None:
            raise MeshError(self.source, f"{len(rows)} cells of type '{name}' have {width} nodes", _WAY_ON)
        return linear.uniform(known, rows[:, _ORDER[known]] if known in _ORDER else rows)


def _index_of(ids: Indices) -> Indices:
    index = np.full(int(ids.max(initial=0)) + 1, -1, np.int64)
    index[ids] = np.arange(len(ids))
    return index


def _found(blocks: list[tuple[Indices, int]], numbers: list[int]) -> Indices:
    """Where cells of given numbers are."""
    wanted = np.array(numbers, np.int64)
    return np.concatenate([np.empty(0, np.int64), *(start + np.flatnonzero(np.isin(own, wanted)) for own, start in blocks)])
