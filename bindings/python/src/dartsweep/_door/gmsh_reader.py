"""Files that Gmsh reads, and its current model. Gmsh runs files that it does not know as scripts, so it only gets those that the table knows."""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
from collections.abc import Iterator
from typing import Any

import numpy as np

from .error import MeshError
from .mapped import mapped
from . import linear, msh_walk, nastran_systems
from .linear import Cells
from .mesh import Indices
from .raw import Raw

_TYPES = {  # of Gmsh: VTK's type, and VTK's order of nodes where it is another
    **{15: (1, None), 1: (3, None), 2: (5, None), 3: (9, None), 4: (10, None), 5: (12, None), 6: (13, None), 7: (14, None)},
    **{8: (21, None), 9: (22, None), 10: (28, None), 16: (23, None), 14: (37, [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12, 13])},
    11: (24, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
    12: (29, [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26]),
    17: (25, [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]),
    13: (32, [*range(6), 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16]),
    18: (26, [*range(6), 6, 9, 7, 12, 14, 13, 8, 10, 11]),
    19: (27, [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12]),
}
_LAGRANGE = {(1, 2): 68, (2, 3): 69, (2, 4): 70, (3, 4): 71, (3, 8): 72, (3, 6): 73, (3, 5): 74}
_LARGE = 16_000_000
"""Bytes of a file for which a process of its own, which takes 0.3 s, is a small part."""
_ELEMENT_OF_NASTRAN = re.compile(r"C(?:TETRA|PENTA|HEXA|PYRAM?|TRIA[R36]|QUAD[R48]?)\b", re.IGNORECASE)
_WAY_ON = "Gmsh can write the mesh anew"


def is_apart(path: str, format: str) -> bool:
    """Whether Gmsh reads a file in a process of its own: where its models have to stay as they are, as MED's files would be added to one of the
    same name; and where it may crash, unless a large file is whole."""
    import gmsh

    return gmsh.isInitialized() or format != "msh" or os.path.getsize(path) < _LARGE or not msh_walk.is_whole(path)


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file; format: the ending by which Gmsh knows it."""
    import gmsh

    if format == "med" and _has_polyhedra(path):
        raise MeshError(source, "it has polyhedra or polygons, which Gmsh leaves out", "its cells have to be divided into linear ones first")
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        with _known_ending(path, format) as known:
            return _read(gmsh, path, known, source, format)
    finally:
        gmsh.finalize()


def _read(gmsh: Any, path: str, known: str, source: str, format: str) -> Raw:
    gmsh.logger.start()
    try:
        gmsh.merge(known)
        raw = raw_of_model(source, not _is_of_blocks(path, format))
        if format == "bdf":
            numbers = np.sort(_signed(gmsh.model.mesh.getNodes(returnParametricCoord=False)[0]))
            raw.points = nastran_systems.placed(path, source, numbers, raw.points)
        if format in ("bdf", "diff") and raw.regions is None:
            _label_entities(gmsh, raw)
        _check_count(path, format, raw)
        return raw
    except MeshError:
        raise
    except Exception as error:
        raise MeshError(source, f"Gmsh can't read it ({_reason(gmsh, error)})", _WAY_ON) from error


def _has_polyhedra(path: str) -> bool:
    """Whether a MED file has a folder of such cells. HDF5 has names of folders as they are, up to a zero."""
    with mapped(path) as text:
        return re.search(rb"[\0\3](?:POE|POG|PG2)", text) is not None


def _is_of_blocks(path: str, format: str) -> bool:
    """Whether the nodes of a file stand entity by entity, as they do in Gmsh. In other files they stand by their tags."""
    if format != "msh":
        return False
    with open(path, "rb") as file:
        return file.read(200).rpartition(b"$MeshFormat")[2].lstrip().startswith(b"4")


def _label_entities(gmsh: Any, raw: Raw) -> None:
    """Nastran's properties and Diffpack's materials: Gmsh makes an entity of each."""
    tags = raw.data["gmsh:tag"]
    raw.regions = np.zeros(len(tags), np.int32)
    for dimension, number in gmsh.model.getEntities():
        for own in gmsh.model.mesh.getElements(dimension, number)[1]:
            raw.regions[np.searchsorted(tags, np.asarray(own, np.int64))] = number


def _check_count(path: str, format: str, raw: Raw) -> None:
    """Gmsh leaves out elements of types that it does not know, and keeps one of several with the same number, without a word."""
    declared, count = 0, len(raw.cells.types)
    if format == "bdf":
        with open(path, encoding="latin-1") as rows:
            lines = rows.readlines()
        declared = sum(_ELEMENT_OF_NASTRAN.match(line) is not None for line in lines)
        if not any(line.upper().startswith("ENDDATA") for line in lines):
            raw.notes.append("the file has no ENDDATA: it may have been cut short")
    elif format == "mesh":
        with mapped(path) as text:
            found = re.search(rb"(?m)^[ \t]*(Prisms|Pyramids)\s+[1-9]", text)
            kind = found.group(1).decode().lower() if found else ""
        if kind:
            raise MeshError(raw.source, f"Gmsh leaves out its {kind}, without a word", "a program that reads them can write the mesh anew")
    elif format == "msh" and os.path.getsize(path) > 0:
        with mapped(path) as text:
            at = text.find(b"\n$ELM" if text[:4] == b"$NOD" else b"\n$Elements")
            head = text[at + 1 : at + 300] if at >= 0 else b""
            version = text[:200].split(b"$MeshFormat")[-1].split()[:2]
        declared = _declared(head.partition(b"\n")[2], version)
    if declared > count:
        raise MeshError(raw.source, f"Gmsh keeps {count} of {declared} elements, without a word", "others have the same number or an unknown type")


def _declared(head: bytes, version: list[bytes]) -> int:
    """How many elements a file says that it has."""
    is_fourth = len(version) == 2 and version[0].startswith(b"4")
    if is_fourth and version[1] == b"1":
        return int(np.frombuffer(head[8:16], "<u8")[0])
    numbers = head.partition(b"\n")[0].split()
    return int(numbers[1 if is_fourth else 0]) if len(numbers) > is_fourth else 0


def _reason(gmsh: Any, error: Exception) -> str:
    errors = [line.partition(":")[2].strip() for line in gmsh.logger.get() if line.startswith("Error")]
    return str((errors or [error])[0])


@contextlib.contextmanager
def _known_ending(path: str, ending: str) -> Iterator[str]:
    """A name by which Gmsh takes the file for what it is. Beside that name there is no file of options, which Gmsh would run."""
    with tempfile.TemporaryDirectory() as folder:
        known = os.path.join(folder, f"mesh.{ending}")
        try:
            os.symlink(os.path.abspath(path), known)
        except OSError:  # Windows without the right to
            import shutil

            shutil.copyfile(path, known)
        yield known


def raw_of_model(source: str, nodes_by_tags: bool = False) -> Raw:
    """The mesh of the current model: all its elements by their tags, with its physical groups. Nodes come as Gmsh has them or by their tags."""
    import gmsh

    tags, coordinates, _ = gmsh.model.mesh.getNodes(returnParametricCoord=False)
    own, points = _signed(tags), np.reshape(coordinates, (-1, 3))
    if nodes_by_tags and np.any(own[1:] < own[:-1]):
        order = np.argsort(own, kind="stable")
        own, points = own[order], points[order]
    index = _index_of(own)
    parts: list[Cells] = []
    elements: list[Any] = []
    rows: dict[tuple[int, int], list[tuple[int, int]]] = {}  # of each entity: where its elements begin and end
    count = 0
    for entity in gmsh.model.getEntities():
        for kind, own, nodes in zip(*gmsh.model.mesh.getElements(*entity)):
            parts.append(_cells_of(gmsh, int(kind), _indices(index, _signed(nodes)), len(own), source))
            elements.append(_signed(own))
            rows.setdefault(tuple(entity), []).append((count, count + len(own)))
            count += len(own)
    raw = Raw(points, linear.joined(parts), source=source, reader="Gmsh")
    place = _in_order(raw, np.concatenate(elements) if elements else np.empty(0, np.int64))
    _add_groups(gmsh, raw, rows, place)
    return raw


def _signed(tags: Any) -> Indices:
    """Tags of Gmsh, without a copy: they are below 2^63."""
    array = np.asarray(tags)
    return array.view(np.int64) if array.dtype == np.uint64 else array.astype(np.int64)


def _index_of(own: Indices) -> Indices | int:
    """Where the node of each tag is; the first tag if they ascend one by one."""
    if len(own) and int(own[-1]) - int(own[0]) == len(own) - 1 and bool(np.all(own[1:] > own[:-1])):
        return int(own[0])
    index = np.full(int(np.max(own, initial=0)) + 1, -1, np.int64)
    index[own] = np.arange(len(own))
    return index


def _indices(index: Indices | int, tags: Indices) -> Indices:
    return tags - index if isinstance(index, int) else index[tags]


def _cells_of(gmsh: Any, kind: int, nodes: Indices, count: int, source: str) -> Cells:
    name, dimension, _, width, _, corners = gmsh.model.mesh.getElementProperties(kind)
    known, order = _TYPES.get(kind, (_LAGRANGE.get((dimension, corners), 0), None))
    if known == 0:
        raise MeshError(source, f"{count} cells have the type '{name}'", "its cells have to be divided into linear ones first")
    rows = nodes.reshape(count, width)
    return linear.uniform(known, rows if order is None else rows[:, order])


def _in_order(raw: Raw, tags: Indices) -> Indices | None:
    """Cells by their tags, as in the file; gives where each cell has gone, None if all stay."""
    raw.data["gmsh:tag"] = tags
    if not np.any(tags[1:] < tags[:-1]):
        return None
    order = np.argsort(tags, kind="stable")
    raw.cells, raw.data["gmsh:tag"] = raw.cells.some(order), tags[order]
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    return place


def _add_groups(gmsh: Any, raw: Raw, rows: dict[tuple[int, int], list[tuple[int, int]]], place: Indices | None) -> None:
    """Physical groups; those of cells are regions where no cell is in two of them."""
    labels, is_in_two = np.zeros(len(raw.cells.types), np.int32), False
    highest = max((dimension for dimension, _ in rows), default=0)
    for dimension, number in gmsh.model.getPhysicalGroups():
        if dimension not in (highest, highest - 1):
            continue
        entities = gmsh.model.getEntitiesForPhysicalGroup(dimension, number)
        members = _members([part for entity in entities for part in rows.get((dimension, int(entity)), ())], place)
        if len(members) == 0:
            continue
        name = gmsh.model.getPhysicalName(dimension, number).strip()  # MED's are padded
        before = raw.groups.get(name or str(number))
        raw.groups[name or str(number)] = members if before is None else np.concatenate([before, members])
        if dimension != highest:
            raw.numbers[name or str(number)] = number
            continue
        is_in_two = is_in_two or bool(np.any(labels[members] != 0))
        labels[members] = number
        if name:
            raw.region_names[name] = number
    if np.any(labels) and not is_in_two:
        raw.regions = labels
    else:
        raw.region_names = {}


def _members(parts: list[tuple[int, int]], place: Indices | None) -> Indices:
    found = np.concatenate([np.empty(0, np.int64), *(np.arange(first, end) for first, end in parts)])
    return found if place is None else place[found]
