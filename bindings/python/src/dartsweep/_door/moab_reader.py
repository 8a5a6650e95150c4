"""MOAB's .h5m files, by h5py. MOAB numbers cells as Exodus and Gmsh do."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from .error import MeshError
from . import linear
from .mesh import Indices
from .quadratics import sides_upwards_first
from .ragged import positions
from .raw import Raw

_TYPES = {  # names of folders: VTK's type
    **{"Edge2": 3, "Edge3": 21, "Tri3": 5, "Tri6": 22, "Tri7": 34, "Qua4": 9, "Quad4": 9, "Qua8": 23, "Qua9": 28, "Quad8": 23, "Quad9": 28},
    **{"Tet4": 10, "Tet10": 24, "Pyr5": 14, "Pyramid5": 14, "Pyr13": 27, "Prism6": 13, "Pri6": 13, "Prism15": 26, "Prism18": 32},
    **{"Hex8": 12, "Hex20": 25, "Hex27": 29},
}
_ORDER = sides_upwards_first(23, 21, 20, 22, 24, 25, 26)
_POLYGON = 7
_IS_RANGES = 8
_WAY_ON = "MOAB's mbconvert can write it as VTK's or as Exodus"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Material sets, or else volumes of the geometry, are labels; Neumann sets and sets with names are groups."""
    import h5py

    try:
        with h5py.File(path, "r") as file:
            return _raw_of(file["tstt"], source)
    except (KeyError, OSError, ValueError, IndexError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as MOAB writes it ({error})", _WAY_ON) from error


def _raw_of(file: Any, source: str) -> Raw:
    coordinates = file["nodes/coordinates"]
    first_node = int(coordinates.attrs["start_id"])
    parts, handles = [], []
    for name, folder in file["elements"].items():
        data = folder["connectivity"]
        kind = _TYPES.get(name, _POLYGON if re.fullmatch(r"Polygon\d+", name) else None)
        if kind is None:
            raise MeshError(source, f"{len(data)} cells have the type '{name}'", _WAY_ON)
        rows = data[()].astype(np.int64) - first_node
        parts.append(linear.uniform(kind, rows[:, _ORDER[kind]] if kind in _ORDER else rows))
        handles.append(np.arange(len(rows)) + int(data.attrs["start_id"]))
    every = np.concatenate([np.empty(0, np.int64), *handles])
    order = np.argsort(every, kind="stable")
    raw = Raw(coordinates[()], linear.joined(parts).some(order), source=source, reader="h5py")
    _add_sets(file, raw, every[order])
    _refuse_geometry(file, raw)
    return raw


def _refuse_geometry(file: Any, raw: Raw) -> None:
    """Triangles of DAGMC bound several volumes, which may lie within each other and share triangles; nothing tells a reader so but their senses."""
    volumes = sum(int(dimension) == 3 for dimension in _tag(file, "GEOM_DIMENSION").values())
    if volumes > 1 and not np.any(linear.DIMENSION[raw.cells.types] == 3):
        found = f"its triangles bound {volumes} volumes of a geometry, which have no cells"
        raise MeshError(raw.source, found, "a mesher fills them, or MOAB's mbconvert -v writes a volume by itself, whose surface is read")


def _add_sets(file: Any, raw: Raw, handles: Indices) -> None:
    sets = _sets(file)
    names = _tag(file, "NAME")
    for handle, value in names.items():
        _add_group(raw, _text(value), _members(sets, handle, handles))
    for handle, value in _tag(file, "NEUMANN_SET").items():
        _add_group(raw, str(int(value)), _members(sets, handle, handles))
    materials = _tag(file, "MATERIAL_SET")
    if not materials:
        ids, dimensions = _tag(file, "GLOBAL_ID"), _tag(file, "GEOM_DIMENSION")
        materials = {handle: ids.get(handle, 0) for handle, dimension in dimensions.items() if int(dimension) == 3}
    labels = np.zeros(len(handles), np.int64)
    for handle, value in materials.items():
        members = _members(sets, handle, handles)
        labels[members] = int(value)
        if len(members) and handle in names:
            raw.region_names[_text(names[handle])] = int(value)
    if np.any(labels):
        raw.regions = labels


def _add_group(raw: Raw, name: str, members: Indices) -> None:
    if len(members):
        raw.groups[name] = np.union1d(raw.groups.get(name, np.empty(0, np.int64)), members)


def _text(value: Any) -> str:
    return bytes(value).split(b"\0")[0].decode("utf-8", "replace")


def _sets(file: Any) -> dict[int, Indices]:
    """The handles that each set contains."""
    if "sets/list" not in file:
        return {}
    rows, first = file["sets/list"][()], int(file["sets/list"].attrs["start_id"])
    contents = file["sets/contents"][()].astype(np.int64) if "sets/contents" in file else np.empty(0, np.int64)
    made, start = {}, 0
    for i, row in enumerate(rows):
        end = int(row[0]) + 1
        own = contents[start:end]
        made[first + i] = positions(own[::2], own[1::2]) if int(row[3]) & _IS_RANGES else own
        start = max(start, end)
    return made


def _members(sets: dict[int, Indices], handle: int, handles: Indices) -> Indices:
    """Indices of the cells in a set and in the sets that it contains."""
    found, todo, seen = [np.empty(0, np.int64)], [handle], {handle}
    while todo:
        own = sets.get(todo.pop(), np.empty(0, np.int64))
        found.append(own)
        inner = [int(value) for value in own if int(value) in sets and int(value) not in seen] if len(sets) else []
        seen.update(inner)
        todo += inner
    every = np.unique(np.concatenate(found))
    return np.flatnonzero(np.isin(handles, every))


def _tag(file: Any, name: str) -> dict[int, Any]:
    """Values of a tag by the handle of the set: dense, with the sets, or sparse, with a list of handles."""
    made: dict[int, Any] = {}
    if f"sets/tags/{name}" in file:
        first = int(file["sets/list"].attrs["start_id"])
        made.update({first + i: value for i, value in enumerate(file[f"sets/tags/{name}"][()]) if not _is_default(file, name, value)})
    if f"tags/{name}/id_list" in file:
        made.update(zip(file[f"tags/{name}/id_list"][()].tolist(), file[f"tags/{name}/values"][()]))
    return made


def _is_default(file: Any, name: str, value: Any) -> bool:
    default = file[f"tags/{name}"].attrs.get("default") if f"tags/{name}" in file else None
    return default is not None and np.ndim(default) == np.ndim(value) == 0 and value == default
