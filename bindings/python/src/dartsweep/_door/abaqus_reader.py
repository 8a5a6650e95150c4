"""Input files of Abaqus and CalculiX: nodes, elements, sets of elements and surfaces, of parts where an assembly places them."""

from __future__ import annotations

import dataclasses
import os
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from .error import MeshError
from . import linear
from .mesh import Indices
from .ragged import offsets_of
from .raw import Raw

_SOLID = {4: 10, 5: 14, 6: 13, 8: 12, 10: 24, 13: 27, 15: 26, 18: 32, 20: 25, 27: 29}  # by the number of nodes: VTK's type
_SHELL = {3: 5, 4: 9, 6: 22, 7: 34, 8: 23, 9: 28}
_LINE = {2: 3, 3: 21}
_ORDER = {29: [*range(20), 26, 24, 23, 25, 21, 22, 20]}  # the middle of a hexahedron of 27 nodes comes before those of its sides
_ORDER_OF_GMSH = {32: [*range(6), 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16]}  # of what it calls C3D6
_SIDES: dict[int, list[tuple[int, ...]]] = {  # of VTK's types: corners of the sides S1, S2, ...
    10: [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)],
    12: [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)],
    13: [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
    14: [(0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)],
    5: [(0, 1), (1, 2), (2, 0)],
    9: [(0, 1), (1, 2), (2, 3), (3, 0)],
}
_SOLIDS, _SHELLS = re.compile(r"(?:C|DC|AC|F|Q|EC|EMC|UC)3D(\d+)|(SC)(\d)"), re.compile(r"(?:CP[ES]|CPEG|CAX|S|STRI|M3D|SFM3D|DS|R3D|DC2D|AC2D|ACAX|DCAX)(\d)")
_LINES, _POINTS = re.compile(r"(?:D$|T[23]D|B[23]|R2D|CONN?3D|F[23]D|GAP|PIPE|DASHPOT|SPRING)"), re.compile(r"(?:MASS|ROTARY)")
_OF_FILES = ("NODE", "ELEMENT", "ELSET", "SURFACE")
"""Keywords whose rows may be in a file of their own."""
_GENERATING = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY")
_WAY_ON = "the program that made it can write a flat file, or Exodus or VTK"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Sets of elements and surfaces are groups."""
    made = _Reading(path, source)
    try:
        made.run()
        return made.raw()
    except (ValueError, IndexError, KeyError, OSError, RecursionError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as Abaqus writes it ({error})", _WAY_ON) from error


@dataclasses.dataclass
class _Scope:
    """What a part says, or a file without parts, or the assembly."""

    nodes: list[Any] = dataclasses.field(default_factory=list)
    """Tables of numbers and coordinates."""
    elements: list[tuple[int, Any]] = dataclasses.field(default_factory=list)
    """Type of VTK; numbers and nodes."""
    sets: dict[str, list[Any]] = dataclasses.field(default_factory=dict)
    """Numbers, names of other sets, and numbers with the name of an instance."""
    surfaces: dict[str, list[list[str]]] = dataclasses.field(default_factory=dict)
    system: Any = None
    """Origin and axes of the system that *SYSTEM gives nodes."""


class _Reading(_Scope):
    """What has been read of a file up to some line: what is in no part is its own."""

    def __init__(self, path: str, source: str) -> None:
        super().__init__()
        self.path, self.source = path, source
        self.parts: dict[str, _Scope] = {}
        self.instances: list[tuple[str, str, list[str]]] = []  # name, part, how it is placed
        self.highest = (0, 0)  # numbers of nodes and elements that are placed
        self.more: dict[str, int] = {}  # what is added to the numbers of an instance's elements, by its name in capitals
        self.titles: dict[str, str] = {}  # names of sets, by these in capitals

    def run(self) -> None:
        now: _Scope = self
        for keyword, options, rows in _blocks(self.path):
            if keyword == "PART":
                now = self.parts.setdefault(options.get("NAME", "").upper(), _Scope())
            elif keyword in ("END PART", "ASSEMBLY"):
                now = self
            elif keyword == "NODE":
                now.nodes.append(self._nodes(now, options, rows))
            elif keyword == "SYSTEM":
                now.system = _system(rows)
            elif keyword in _GENERATING:
                raise MeshError(self.source, f"it makes nodes or elements by *{keyword}", _WAY_ON)
            elif keyword == "ELEMENT":
                self._add_elements(now, options, rows)
            elif keyword == "ELSET":
                self._add_set(now, options, rows)
            elif keyword == "SURFACE" and options.get("TYPE", "ELEMENT").upper() == "ELEMENT":
                now.surfaces[options.get("NAME", "")] = [[word.strip() for word in row.split(",")] for row in rows]
            elif keyword == "INSTANCE":
                self.instances.append((options.get("NAME", ""), options.get("PART", "").upper(), rows))
        if not self.instances:  # parts that no assembly places stand where they are
            self.instances = [(name, name, []) for name in self.parts]
        self.highest = _highest(self)
        for name, part, rows in self.instances:
            self._place(name, part, rows)
        for members in self.sets.values():  # those of the assembly name elements of an instance
            members[:] = [each[1] + self.more[each[0].upper()] if isinstance(each, tuple) and each[0].upper() in self.more else each for each in members]

    def _place(self, name: str, part: str, rows: list[str]) -> None:
        """Adds the nodes and elements of an instance, with numbers that no other has, so its sets and surfaces are called INSTANCE.SET; those of
        the only instance keep their names."""
        if part not in self.parts:
            raise MeshError(self.source, f"it places a part '{part}' that it does not have", _WAY_ON)
        of, before = self.parts[part], "" if len(self.instances) == 1 else f"{name}."
        more_nodes, more = self.highest
        self.more.setdefault(name.upper(), more)
        own = _joined(of.nodes)
        own[:, 1:] = placed(own[:, 1:], [[float(word) for word in row.split(",") if word.strip()] for row in rows])
        own[:, 0] += more_nodes
        self.nodes.append(own)
        for kind, numbers in of.elements:
            self.elements.append((kind, numbers + np.array([more] + [more_nodes] * (numbers.shape[1] - 1))))
        nodes, elements = _highest(of)
        self.highest = more_nodes + nodes, more + elements
        for title, members in of.sets.items():
            self.sets.setdefault(before + title, []).extend(before + each if isinstance(each, str) else each + more for each in members)
        for title, faces in of.surfaces.items():
            self.surfaces[before + title] = [[str(int(row[0]) + more) if row[0].isdigit() else before + row[0], *row[1:]] for row in faces]
        if before:
            self.sets[name] = [numbers[:, 0] + more for _, numbers in of.elements]

    def _nodes(self, now: _Scope, options: dict[str, str], rows: list[str]) -> Any:
        """Numbers of nodes, and their coordinates in the whole."""
        system = options.get("SYSTEM", "R").upper()[:1]
        if system not in ("R", "C"):
            raise MeshError(self.source, f"nodes are in a system '{options['SYSTEM']}', which is not rectangular or cylindrical", _WAY_ON)
        table = np.array([_four(row) for row in rows], np.float64).reshape(-1, 4)
        if system == "C":  # distance from the axis, degrees, height
            radius, angle = table[:, 1].copy(), np.radians(table[:, 2])
            table[:, 1], table[:, 2] = radius * np.cos(angle), radius * np.sin(angle)
        if now.system is not None:
            table[:, 1:] = now.system[0] + table[:, 1:] @ now.system[1]
        return table

    def _add_elements(self, now: _Scope, options: dict[str, str], rows: list[str]) -> None:
        name = options.get("TYPE", "").upper()
        kind, width = self._type_of(name)
        numbers = np.array(" ".join(rows).replace(",", " ").split(), np.int64)
        count = sum(not before.endswith(",") for before in ["", *rows[:-1]]) if rows else 0
        if count and len(numbers) not in (count * (width + 1), len(rows) * (width + 1)):
            width = len(numbers) // count - 1
            of_width = _SOLID if linear.DIMENSION[kind] == 3 else _SHELL
            if len(numbers) % count or width not in of_width:
                raise MeshError(self.source, f"elements of type {name} have {width} nodes", _WAY_ON)
            kind = of_width[width]  # Gmsh calls wedges of 18 nodes C3D6
        numbers = numbers.reshape(-1, width + 1)
        order = (_ORDER_OF_GMSH if name == "C3D6" else _ORDER).get(kind)
        if order is not None:
            numbers[:, 1:] = numbers[:, 1 + np.array(order)]
        now.elements.append((kind, numbers))
        if "ELSET" in options:
            now.sets.setdefault(options["ELSET"], []).append(numbers[:, 0])

    def _type_of(self, name: str) -> tuple[int, int]:
        solid, shell = _SOLIDS.match(name), _SHELLS.match(name)
        if solid:
            width = int(solid.group(1) or solid.group(3))
            if width in _SOLID:
                return _SOLID[width], width
        elif shell and int(shell.group(1)) in _SHELL:
            return _SHELL[int(shell.group(1))], int(shell.group(1))
        elif _POINTS.match(name):
            return 1, 1
        elif _LINES.match(name):
            width = 3 if name.startswith(("B32", "B22", "T3D3", "T2D3")) else 2
            return _LINE[width], width
        raise MeshError(self.source, f"elements have the type '{name}'", "its elements have to be exported as solids or shells")

    def _add_set(self, now: _Scope, options: dict[str, str], rows: list[str]) -> None:
        own: list[Any] = now.sets.setdefault(options.get("ELSET", ""), [])
        instance = options.get("INSTANCE")
        words = [[word.strip() for word in row.split(",") if word.strip()] for row in rows]
        if "GENERATE" in options:
            for row in words:
                first, last = int(row[0]), int(row[1])
                numbers = np.arange(first, last + 1, int(row[2]) if len(row) > 2 else 1)
                own.append(numbers if instance is None else (instance, numbers))
        else:
            for word in (word for row in words for word in row):
                if not word.lstrip("-").isdigit():
                    own.append(word if instance is None or len(self.parts) == 1 else f"{instance}.{word}")
                else:
                    own.append(np.array([int(word)]) if instance is None else (instance, np.array([int(word)])))

    def raw(self) -> Raw:
        table = _joined(self.nodes)
        ids = table[:, 0].astype(np.int64)
        index = _index_of(ids)
        parts = [linear.uniform(kind, index[rows[:, 1:]]) for kind, rows in self.elements]
        raw = Raw(table[:, 1:], linear.joined(parts), source=self.source, reader="NumPy")
        if len(raw.cells.flat) and raw.cells.flat.min() < 0:
            raise MeshError(self.source, "an element names a node that is not there", "the file is damaged")
        of_element = _index_of(np.concatenate([np.empty(0, np.int64), *(rows[:, 0] for _, rows in self.elements)]))
        for name in self.sets:
            self.titles.setdefault(name.upper(), name)
        for name in self.sets:
            members = self._members(name, of_element, ())
            if len(members) and not name.rpartition(".")[2].startswith("_"):  # those are Abaqus's own, of surfaces
                raw.groups[name] = members
        for name, rows in self.surfaces.items():
            self._add_surface(raw, name, rows, of_element)
        return raw

    def _members(self, name: str, of_element: Indices, above: tuple[str, ...]) -> Indices:
        found = [np.empty(0, np.int64)]
        key = self.titles.get(name.upper())
        for part in self.sets[key] if key is not None and key not in above else ():
            if isinstance(part, tuple):
                raise MeshError(self.source, f"the set '{name}' names an instance '{part[0]}' that it does not have", _WAY_ON)
            if isinstance(part, str):
                found.append(self._members(part, of_element, (*above, name)))
            else:
                known = part[(part >= 0) & (part < len(of_element))]
                found.append(of_element[known][of_element[known] >= 0])
        return np.unique(np.concatenate(found))

    def _add_surface(self, raw: Raw, name: str, rows: list[list[str]], of_element: Indices) -> None:
        """Rows name an element or a set, and a side."""
        faces: list[Indices] = []
        for row in rows:
            side = re.fullmatch(r"S(\d)", row[1].upper()) if len(row) > 1 else None
            members = np.array([of_element[int(row[0])]]) if row[0].isdigit() else self._members(row[0], of_element, ())
            if side is None:
                if len(members) and np.all(linear.DIMENSION[raw.cells.types[members]] == 2):
                    raw.groups[name] = np.union1d(raw.groups.get(name, members), members)
                continue
            for cell in members.tolist():
                kind = int(raw.cells.types[cell])
                sides = _SIDES.get(linear.corner_type(kind), [])
                if int(side.group(1)) <= len(sides):
                    faces.append(raw.cells.flat[raw.cells.offsets[cell] + np.array(sides[int(side.group(1)) - 1])])
        if faces:
            raw.sides.append((name, offsets_of([len(face) for face in faces]), np.concatenate(faces)))


def placed(points: Any, rows: list[list[float]]) -> Any:
    """Points where an instance is: moved by the first row, then turned by degrees about the axis between two points of the second."""
    points = points + np.array(rows[0][:3]) if rows else points
    if len(rows) < 2:
        return points
    a, b, angle = np.array(rows[1][:3]), np.array(rows[1][3:6]), np.radians(rows[1][6])
    axis = (b - a) / np.linalg.norm(b - a)
    away = points - a
    along = np.outer(away @ axis, axis)
    return a + along + np.cos(angle) * (away - along) + np.sin(angle) * np.cross(axis, away)


def _system(rows: list[str]) -> Any:
    """Origin, and the axes as rows, of *SYSTEM: the origin, a point on the first axis, and one in the plane of the first two; None: the whole's."""
    words = [float(word) for row in rows for word in row.split(",") if word.strip()]
    if not words:
        return None
    places = np.array(words, np.float64).reshape(-1, 3)
    if len(places) == 1:
        return places[0], np.eye(3)
    along = places[1] - places[0]
    up = np.cross(along, places[2] - places[0] if len(places) > 2 else np.cross((0.0, 0.0, 1.0), along))
    axes = np.array([along, np.cross(up, along), up])
    return places[0], axes / np.linalg.norm(axes, axis=1)[:, None]


def _joined(tables: list[Any]) -> Any:
    """Numbers and coordinates of nodes, in one table."""
    return np.concatenate([np.empty((0, 4)), *tables])


def _highest(scope: _Scope) -> tuple[int, int]:
    """The highest numbers of nodes and of elements."""
    nodes = max((int(table[:, 0].max(initial=0)) for table in scope.nodes), default=0)
    return nodes, max((int(numbers[:, 0].max(initial=0)) for _, numbers in scope.elements), default=0)


def _four(row: str) -> list[str]:
    """Number and coordinates of a node; those that are left out are 0."""
    words = [word.strip() or "0" for word in row.split(",")[:4]]
    return words + ["0"] * (4 - len(words))


def _index_of(ids: Indices) -> Indices:
    index = np.full(int(ids.max(initial=0)) + 1, -1, np.int64)
    index[ids] = np.arange(len(ids))
    return index


def _blocks(path: str) -> Iterator[tuple[str, dict[str, str], list[str]]]:
    """Keywords with their options and rows."""
    keyword, options, rows = "", dict[str, str](), list[str]()
    for line in _lines(path):
        if not line.startswith("*"):
            rows.append(line.strip())
            continue
        yield keyword, options, rows
        keyword, options = _keyword(line)
        rows = []
        if keyword in _OF_FILES and "INPUT" in options:
            rows = [row.strip() for row in _lines(_beside(path, options["INPUT"]))]
    yield keyword, options, rows


def _lines(path: str) -> Iterator[str]:
    """Lines without remarks; those of an included file stand where it is included, so its rows go on with those before."""
    with open(path, encoding="latin-1") as file:
        for line in file:
            if line.startswith("**") or not line.strip():
                continue
            if line.startswith("*") and _keyword(line)[0] == "INCLUDE":
                yield from _lines(_beside(path, _keyword(line)[1].get("INPUT", "")))
            else:
                yield line


def _beside(path: str, name: str) -> str:
    """A file that another one names."""
    named = os.path.join(os.path.dirname(path), name)
    if not os.path.isfile(named):
        raise ValueError(f"it includes '{name}', which is not there")
    return named


def _keyword(line: str) -> tuple[str, dict[str, str]]:
    words = [word.strip() for word in line.strip()[1:].split(",")]
    pairs = [word.partition("=") for word in words[1:]]
    return words[0].upper(), {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}
