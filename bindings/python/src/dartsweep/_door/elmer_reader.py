"""Meshes of Elmer: a folder with mesh.header, mesh.nodes, mesh.elements, mesh.boundary and, if bodies and boundaries have names, mesh.names."""

from __future__ import annotations

import os
import re

import numpy as np

from . import rows
from .error import MeshError
from .quadratics import sides_upwards_first
from .ragged import groups_by_number
from .raw import Raw

_TYPES = {
    **{101: 1, 202: 3, 203: 21, 303: 5, 306: 22, 404: 9, 408: 23, 409: 28, 504: 10, 510: 24},
    **{605: 14, 613: 27, 706: 13, 715: 26, 808: 12, 820: 25, 827: 29},
}
_UPWARDS_FIRST = sides_upwards_first(23, 21, 20, 22, 24, 25, 26)
_ORDER = {kind: _UPWARDS_FIRST[kind] for kind in (25, 29)}
_WAY_ON = "ElmerGrid can write the mesh anew, also as VTK's"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of the folder of a mesh.header. Bodies are regions, and boundaries are groups of faces."""
    folder = os.path.dirname(path)
    try:
        counts = [int(word) for word in _lines(path)[0].split()[:3]]
        nodes, elements, boundary = (_lines(os.path.join(folder, f"mesh.{name}")) for name in ("nodes", "elements", "boundary"))
        if [len(nodes), len(elements), len(boundary)] != counts:
            raise ValueError(f"it has {len(nodes)} nodes, {len(elements)} elements and {len(boundary)} of the boundary, where its header says {counts}")
        table = [line.split() for line in nodes]
        index = rows.Numbers([int(row[0]) for row in table], "node")
        cells = [[int(word) for word in line.split()[1:]] for line in elements]  # body, type, nodes
        faces = [[int(word) for word in line.split()[1:]] for line in boundary]  # boundary, two parents, type, nodes
        kinds, nodes_of = _cells([(cell[1], cell[2:]) for cell in cells] + [(face[3], face[4:]) for face in faces], source)
        raw = Raw(np.array([row[2:5] for row in table], np.float64), rows.cells_of(kinds, [index.of(row) for row in nodes_of]), source=source, reader="NumPy")
    except (ValueError, IndexError, OSError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as Elmer writes it ({error})", _WAY_ON) from error
    _order_wedges(raw)
    raw.regions = np.array([row[0] for row in cells + faces], np.int64)
    _add_names(raw, len(cells), folder)
    return raw


def _lines(path: str) -> list[str]:
    with open(path, encoding="latin-1") as file:
        return [line for line in file if line.strip()]


def _cells(known: list[tuple[int, list[int]]], source: str) -> tuple[list[int], list[list[int]]]:
    kinds, made = [], []
    for kind, nodes in known:
        if kind not in _TYPES or len(nodes) < kind % 100:
            raise MeshError(source, f"elements have the type {kind}, with {len(nodes)} nodes", _WAY_ON)
        kinds.append(_TYPES[kind])
        made.append([nodes[i] for i in _ORDER.get(_TYPES[kind], range(kind % 100))])
    return kinds, made


def _order_wedges(raw: Raw) -> None:
    """Elmer's definition of wedges of 15 nodes has VTK's order. Those that ElmerGrid takes from Gmsh have the nodes of sides upwards first, as
    the places of these nodes show."""
    places = raw.cells.offsets[:-1][raw.cells.types == 26][:, None] + np.arange(15)
    rows = raw.cells.flat[places]
    low, high, next_high, nodes = (raw.points[rows[:, columns]] for columns in ([0, 1, 2], [3, 4, 5], [4, 5, 3], [9, 10, 11]))
    away = [np.linalg.norm(nodes - 0.5 * (high + other), axis=2).sum(axis=1) for other in (low, next_high)]
    raw.cells.flat[places] = np.where((away[0] < away[1])[:, None], rows[:, _UPWARDS_FIRST[26]], rows)


def _add_names(raw: Raw, count: int, folder: str) -> None:
    """Names of bodies and boundaries; a boundary without a name is called by its number."""
    bodies, boundaries = _names(folder, set(raw.regions[:count].tolist()))
    raw.region_names = {name: number for number, name in bodies.items()}
    for number, members in groups_by_number(raw.regions[:count]).items():
        if number in bodies:
            name = bodies[number]
            raw.groups[name] = np.concatenate([raw.groups.get(name, np.empty(0, np.int64)), members])
    for number, members in groups_by_number(raw.regions[count:]).items():
        name = boundaries.get(number, str(number))
        raw.groups[name] = np.concatenate([raw.groups.get(name, np.empty(0, np.int64)), members + count])
        raw.numbers.setdefault(name, number)


def _names(folder: str, bodies: set[int]) -> tuple[dict[int, str], dict[int, str]]:
    """ElmerGrid writes a comment above the names of bodies and one above those of boundaries. Netgen writes none: bodies come first, each once."""
    path = os.path.join(folder, "mesh.names")
    found: tuple[dict[int, str], dict[int, str]] = {}, {}
    at, has_headings = 0, False
    for line in _lines(path) if os.path.exists(path) else []:
        if line.lstrip().startswith("!"):
            if heading := re.search("boundar|bod", line.lower()):
                at, has_headings = int(heading[0] == "boundar"), True
            continue
        row = re.match(r"\s*\$\s*(.+?)\s*=\s*(\d+)\s*$", line)
        if row is not None:
            number = int(row[2])
            at = 1 if not has_headings and (number not in bodies or number in found[0]) else at
            found[at][number] = row[1]
    return found
