"""Models of FEBio (.feb) of the versions 1 to 4: parts are regions; surfaces, sets and lists of parts keep their names."""

from __future__ import annotations

import os
import xml.etree.ElementTree
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import linear, rows
from .error import MeshError
from .raw import Raw, free_name

_TYPES = {
    **{"tet4": 10, "tet5": 10, "tet10": 24, "tet15": 24, "tet20": 10, "hex8": 12, "hex20": 25, "hex27": 29},
    **{"penta6": 13, "penta15": 26, "pyra5": 14, "pyra13": 27},
    **{"tri3": 5, "tri6": 22, "tri7": 34, "tri10": 5, "quad4": 9, "quad8": 23, "quad9": 28, "line2": 3, "line3": 21, "truss2": 3},
    **{"q4": 9, "q4ans": 9, "q4eas": 9, "t3": 5, "t6": 22, "q8": 23},
}  # by the first letters of a type, which may go on in a rule of integration, such as TET10G8
_WIDTHS = {10: 4, 24: 10, 12: 8, 25: 20, 29: 27, 13: 6, 26: 15, 14: 5, 27: 13, 5: 3, 22: 6, 34: 7, 9: 4, 23: 8, 28: 9, 3: 2, 21: 3}
_ORDER = {29: [*range(20), 23, 21, 20, 22, 24, 25, 26]}  # VTK's order of the middles of faces
_WAY_ON = "FEBio Studio can write it anew, also as VTK's"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a model."""
    try:
        return _Reading(path, source).raw()
    except (ValueError, KeyError, AttributeError, OSError, xml.etree.ElementTree.ParseError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as FEBio writes it ({error})", _WAY_ON) from error


class _Reading:
    """Nodes, parts, surfaces and sets of a model."""

    def __init__(self, path: str, source: str) -> None:
        self.source = source
        self.nodes: list[int] = []
        self.places: list[list[float]] = []
        self.kinds: list[int] = []
        self.cells: list[list[int]] = []
        self.ids: list[int] = []
        self.parts: dict[str, list[int]] = {}
        mesh = _mesh_of(path)
        if mesh is None:
            raise MeshError(source, "it has no mesh", _WAY_ON)
        if mesh.find("Part") is not None or mesh.find("Instance") is not None:
            raise MeshError(source, "its mesh is made of parts and instances", _WAY_ON)
        for nodes in mesh.iter("Nodes"):
            for node in nodes.iter("node"):
                self.nodes.append(int(node.attrib["id"]))
                self.places.append([float(word) for word in _words(node)])
        for elements in mesh.findall("Elements"):
            self._add_part(elements)
        self.mesh = mesh
        self.is_solid = any(linear.DIMENSION[kind] == 3 for kind in self.kinds)
        self.surfaces: dict[str, list[int]] = {}
        for surface in mesh.findall("Surface") if self.is_solid else ():
            self._add_surface(surface)

    def _add_surface(self, surface: Any) -> None:
        """Faces as cells, so that those of second order are divided as the sides of solids are."""
        start = len(self.cells)
        for face in surface:
            kind = _type_of(face.tag, self.source)
            self.kinds.append(kind)
            self.cells.append(_nodes_of(face, kind, self.source))
        self.surfaces.setdefault(surface.attrib["name"], []).extend(range(start, len(self.cells)))

    def _add_part(self, elements: Any) -> None:
        """Elements of one part and type; in version 1 each element says both, by its tag and by its material."""
        own = elements.get("name") or elements.get("elset") or elements.get("mat")
        unnamed = str(len(self.parts) + 1)
        for element in elements:
            kind = _type_of(elements.get("type") or element.tag, self.source)
            self.parts.setdefault(own or element.get("mat") or unnamed, []).append(len(self.cells))
            self.kinds.append(kind)
            self.cells.append(_nodes_of(element, kind, self.source))
            self.ids.append(int(element.attrib["id"]))

    def raw(self) -> Raw:
        points = rows.Numbers(self.nodes, "node")
        cells = rows.cells_of(self.kinds, [points.of(cell) for cell in self.cells])
        raw = Raw(np.array(self.places, np.float64).reshape(-1, 3), cells, source=self.source, reader="NumPy")
        raw.regions = np.zeros(len(self.kinds), np.int64)
        for label, (name, members) in enumerate(self.parts.items(), 1):
            raw.regions[members] = label
            _add_group(raw, name, "part", members)
            if np.any(linear.DIMENSION[raw.cells.types[members]] == linear.DIMENSION[raw.cells.types].max(initial=0)):
                raw.region_names[name] = label
        place = rows.Numbers(self.ids, "element")
        sets, lists = dict[str, list[int]](), dict[str, list[int]]()
        for elements in self.mesh.findall("ElementSet"):
            sets.setdefault(elements.attrib["name"], []).extend(place.of(_numbers_of(elements)))
        for parts in self.mesh.findall("PartList"):
            names = [name for word in (parts.text or "").split(",") if (name := word.strip())]
            lists.setdefault(parts.attrib["name"], []).extend(i for name in names for i in self.parts[name])
        for kind, groups in (("element", sets), ("part", lists), ("surface", self.surfaces)):
            for name, members in groups.items():
                _add_group(raw, name, kind, members)
        if not self.is_solid:
            raw.notes += [f"the surface '{surface.attrib['name']}' is one of shells, and was left out" for surface in self.mesh.findall("Surface")]
        return raw


def _add_group(raw: Raw, name: str, kind: str, members: list[int]) -> None:
    """A group of cells and one of faces may have one name. Of two groups of the same dimension the second one has its kind behind its name,
    unless both have the same members."""
    rows, known = np.unique(np.array(members, np.int64)), raw.groups.get(name, np.empty(0, np.int64))
    dimensions = linear.DIMENSION[raw.cells.types]
    alike = known[np.isin(dimensions[known], dimensions[rows])]
    if len(alike) == 0:
        raw.groups[name] = np.unique(np.concatenate([known, rows]))
    elif not np.array_equal(alike, rows):
        raw.groups[free_name(name, kind, raw.groups)] = rows


def _mesh_of(path: str) -> Any:
    """The part of the model that has the mesh, which may be in a file of its own."""
    root = xml.etree.ElementTree.parse(path).getroot()
    for _ in range(8):
        every: list[Any] = [root, root.find("Mesh"), root.find("Geometry")]
        mesh = next((one for one in every if one is not None and one.tag in ("Mesh", "Geometry")), None)
        if mesh is None or mesh.get("from") is None:
            return mesh
        path = os.path.join(os.path.dirname(path), mesh.attrib["from"])
        root = xml.etree.ElementTree.parse(path).getroot()
    return None


def _type_of(name: str, source: str) -> int:
    low = name.lower()
    found = max((known for known in _TYPES if low.startswith(known)), key=len, default=None)
    if found is None:
        raise MeshError(source, f"elements have the type '{name}'", _WAY_ON)
    return _TYPES[found]


def _nodes_of(element: Any, kind: int, source: str) -> list[int]:
    """Nodes in VTK's order; those that VTK's type has not, such as the middles of the faces of a TET15, are left out."""
    nodes = [int(word) for word in _words(element)]
    if len(nodes) < _WIDTHS[kind]:
        raise MeshError(source, f"element {element.get('id')} has {len(nodes)} nodes, where its type has {_WIDTHS[kind]}", _WAY_ON)
    return [nodes[i] for i in _ORDER.get(kind, range(_WIDTHS[kind]))]


def _numbers_of(elements: Any) -> Iterator[int]:
    """The numbers of a set, which may be ranges such as 3:7 or 3:7:2, whose ends belong to them."""
    for element in elements:
        yield int(element.attrib["id"])
    for word in _words(elements):
        first, *more = map(int, word.split(":"))
        yield from range(first, (more or [first])[0] + 1, *more[1:])


def _words(element: Any) -> list[str]:
    return (element.text or "").replace(",", " ").split()
