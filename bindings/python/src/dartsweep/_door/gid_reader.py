"""Meshes of GiD as text (.msh, .post.msh), as GiD and Kratos write them: one or more lists of elements, whose coordinates count together."""

from __future__ import annotations

import re

import numpy as np

from . import linear, rows
from .error import MeshError
from .quadratics import sides_upwards_first
from .raw import Raw

_TYPES = {  # of the name in small letters and the number of nodes
    **{("point", 1): 1, ("linear", 2): 3, ("linear", 3): 21, ("triangle", 3): 5, ("triangle", 6): 22},
    **{("quadrilateral", 4): 9, ("quadrilateral", 8): 23, ("quadrilateral", 9): 28, ("tetrahedra", 4): 10, ("tetrahedra", 10): 24},
    **{("hexahedra", 8): 12, ("hexahedra", 20): 25, ("hexahedra", 27): 29, ("prism", 6): 13, ("prism", 15): 26, ("pyramid", 5): 14, ("pyramid", 13): 27},
}
_ORDER = sides_upwards_first(24, 22, 21, 23, 20, 25, 26)
_HEAD = re.compile(r"""(?i)MESH\s*(?:"([^"]*)"|(\S+)(?=\s+DIMENSION))?.*?DIMENSION\s*=?\s*(\d).*?ELEMTYPE\s*=?\s*(\w+)\s+NNODE\s*=?\s*(\d+)""")
_COMMENT = re.compile(r'("[^"]*")|#.*')  # or a name in quotes, which is kept
_WAY_ON = "GiD can export the mesh, such as for Abaqus or Nastran"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Meshes with names are groups; where elements have materials, these are regions."""
    with open(path, encoding="latin-1") as file:
        lines = [line for line in (_COMMENT.sub(r"\1", line).strip() for line in file) if line]
    try:
        return _Reading(lines, source).raw()
    except (ValueError, IndexError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as GiD writes it ({error})", _WAY_ON) from error


class _Reading:
    """Coordinates, and elements with what they belong to."""

    def __init__(self, lines: list[str], source: str) -> None:
        self.source = source
        self.places: dict[int, list[float]] = {}
        self.kinds: list[int] = []
        self.cells: list[list[int]] = []
        self.materials: list[int] = []
        self.meshes: dict[str, list[int]] = {}
        self.dimension = 2
        section, name, kind, width = "", "", 0, 0
        for line in lines:
            low = line.lower()
            if low.startswith("mesh"):
                name, kind, width = self._begin(line)
            elif low.startswith(("coordinates", "elements")):
                section = low[0]
            elif low.startswith("end"):
                section = ""
            elif section == "c":
                words = line.split()
                self.places[int(words[0])] = [float(word) for word in words[1:4]]
            elif section == "e":
                self._add([int(word) for word in line.split()], name, kind, width)
        if section:
            raise ValueError("it ends early")

    def _begin(self, line: str) -> tuple[str, int, int]:
        head = _HEAD.match(line)
        if head is None:
            raise ValueError(f"'{line}' begins no mesh")
        self.dimension = max(self.dimension, int(head[3]))
        kind, width = head[4].lower(), int(head[5])
        if (kind, width) not in _TYPES:
            raise MeshError(self.source, f"elements have the type '{head[4]}', with {width} nodes", _WAY_ON)
        return head[1] or head[2] or "", _TYPES[kind, width], width

    def _add(self, numbers: list[int], name: str, kind: int, width: int) -> None:
        if len(numbers) < 1 + width:
            raise ValueError(f"element {numbers[0]} has {len(numbers) - 1} of {width} nodes")
        if name:
            self.meshes.setdefault(name, []).append(len(self.cells))
        self.cells.append([numbers[1 + i] for i in _ORDER.get(kind, range(width))])
        self.kinds.append(kind)
        self.materials.append(numbers[1 + width] if len(numbers) > 1 + width else 0)

    def raw(self) -> Raw:
        index = rows.Numbers(self.places, "node")
        cells = rows.cells_of(self.kinds, [index.of(cell) for cell in self.cells])
        points = np.zeros((len(self.places), 3))
        for i, place in enumerate(self.places.values()):
            points[i, : len(place)] = place
        raw = Raw(points[:, : self.dimension], cells, source=self.source, reader="NumPy")
        raw.regions = np.array(self.materials, np.int64)
        highest = linear.DIMENSION[cells.types] == linear.DIMENSION[cells.types].max(initial=0)
        raw.groups = {name: np.array(members, np.int64) for name, members in self.meshes.items()}
        own = [name for name, members in raw.groups.items() if np.any(highest[members])]
        if not np.any(raw.regions[highest]) and len(own) > 1:
            raw.region_names = {name: label for label, name in enumerate(own, 1)}
            for name, label in raw.region_names.items():
                raw.regions[raw.groups[name]] = label
        return raw
