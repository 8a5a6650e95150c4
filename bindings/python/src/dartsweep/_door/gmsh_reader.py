"""Files that Gmsh reads, and its current model. Gmsh runs files that it does not know as scripts, so it only gets those that the table knows."""

from __future__ import annotations

import contextlib
import mmap
import os
import tempfile
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..errors import MeshError
from . import linear
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
_WAY_ON = "Gmsh can write the mesh anew"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file, in a model of its own; format: the ending by which Gmsh knows it."""
    import gmsh

    with _own_model(gmsh), _known_ending(path, format) as known:
        gmsh.logger.start()
        try:
            gmsh.merge(known)
            raw = raw_of_model(source)
            _check_count(path, format, len(raw.cells.types), source)
        except MeshError:
            raise
        except Exception as error:
            raise MeshError(source, f"Gmsh can't read it ({_reason(gmsh, error)})", _WAY_ON) from error
        finally:
            gmsh.logger.stop()
    return raw


def _check_count(path: str, format: str, count: int, source: str) -> None:
    """Gmsh keeps one of several elements with the same number, without a word."""
    if format != "msh" or os.path.getsize(path) == 0:
        return
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        at = max(text.find(b"\n$Elements"), text.find(b"\n$ELM"))
        head = text[at + 1 : at + 300] if at >= 0 else b""
        version = text[:200].split(b"$MeshFormat")[-1].split()[:2]
    declared = _declared(head.partition(b"\n")[2], version)
    if declared > count:
        raise MeshError(source, f"Gmsh keeps {count} of {declared} elements: some have the same number", _WAY_ON)


def _declared(head: bytes, version: list[bytes]) -> int:
    """How many elements a file says that it has."""
    is_fourth = len(version) == 2 and version[0].startswith(b"4")
    if is_fourth and version[1] == b"1":
        return int(np.frombuffer(head[8:16], "<u8")[0])
    numbers = head.partition(b"\n")[0].split()
    return int(numbers[1 if is_fourth else 0]) if len(numbers) > is_fourth else 0


def _reason(gmsh: Any, error: Exception) -> str:
    errors = [line.partition(":")[2].strip() for line in gmsh.logger.get() if line.startswith("Error")]
    return (errors or [str(error)])[0]


@contextlib.contextmanager
def _own_model(gmsh: Any) -> Iterator[None]:
    """A new model, silent; afterwards all is as before."""
    was_running = bool(gmsh.isInitialized())
    if not was_running:
        gmsh.initialize(readConfigFiles=False, interruptible=False)
    before = gmsh.model.getCurrent() if was_running else ""
    options = {name: gmsh.option.getNumber(name) for name in ("General.Terminal", "Mesh.IgnorePeriodicity", "General.AbortOnError")}
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.add("dartsweep")
    try:
        yield
    finally:
        if was_running:
            gmsh.model.setCurrent("dartsweep")
            gmsh.model.remove()
            for name, value in options.items():
                gmsh.option.setNumber(name, value)
            if before in gmsh.model.list():
                gmsh.model.setCurrent(before)
        else:
            gmsh.finalize()


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


def raw_of_model(source: str) -> Raw:
    """The mesh of the current model: all its elements by their tags, with its physical groups."""
    import gmsh

    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    points = np.reshape(coordinates, (-1, 3))
    index = _index_of(tags)
    parts: list[Cells] = []
    elements: list[Any] = []
    dimensions: list[int] = []
    for kind in gmsh.model.mesh.getElementTypes():
        own, nodes = gmsh.model.mesh.getElementsByType(kind)
        cells, dimension = _cells_of(gmsh, int(kind), index[np.asarray(nodes, np.int64)], len(own), source)
        parts.append(cells)
        elements.append(own)
        dimensions.append(dimension)
    raw = Raw(points, linear.joined(parts), source=source, reader="Gmsh")
    _in_order(raw, np.concatenate(elements) if elements else np.empty(0, np.int64))
    _add_groups(gmsh, raw, max(dimensions, default=0))
    return raw


def _index_of(tags: Any) -> Indices:
    """Where the node of each tag is."""
    index = np.full(int(np.max(tags, initial=0)) + 1, -1, np.int64)
    index[np.asarray(tags, np.int64)] = np.arange(len(tags))
    return index


def _cells_of(gmsh: Any, kind: int, nodes: Indices, count: int, source: str) -> tuple[Cells, int]:
    name, dimension, _, width, _, corners = gmsh.model.mesh.getElementProperties(kind)
    known, order = _TYPES.get(kind, (_LAGRANGE.get((dimension, corners), 0), None))
    if known == 0:
        raise MeshError(source, f"{count} cells have the type '{name}'", "its cells have to be divided into linear ones first")
    rows = nodes.reshape(count, width)
    return linear.uniform(known, rows if order is None else rows[:, order]), dimension


def _in_order(raw: Raw, tags: Any) -> None:
    """Cells by their tags, as in the file. The tags are kept to find the members of groups."""
    tags = np.asarray(tags, np.int64)
    if np.any(np.diff(tags) < 0):
        order = np.argsort(tags, kind="stable")
        raw.cells, tags = raw.cells.some(order), tags[order]
    raw.data["gmsh:tag"] = tags


def _add_groups(gmsh: Any, raw: Raw, highest: int) -> None:
    """Physical groups; those of cells are regions where no cell is in two of them."""
    tags = raw.data["gmsh:tag"]
    labels, is_in_two = np.zeros(len(tags), np.int32), False
    for dimension, number in gmsh.model.getPhysicalGroups():
        if dimension not in (highest, highest - 1):
            continue
        entities = gmsh.model.getEntitiesForPhysicalGroup(dimension, number)
        members = _members(gmsh, dimension, entities, tags)
        if len(members) == 0:
            continue
        name = gmsh.model.getPhysicalName(dimension, number)
        raw.groups[name or str(number)] = np.union1d(raw.groups.get(name or str(number), members), members)
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


def _members(gmsh: Any, dimension: int, entities: Any, tags: Indices) -> Indices:
    found = [np.concatenate(gmsh.model.mesh.getElements(dimension, int(entity))[1] or [np.empty(0)]) for entity in entities]
    own = np.sort(np.concatenate(found).astype(np.int64)) if found else np.empty(0, np.int64)
    return np.searchsorted(tags, own)
