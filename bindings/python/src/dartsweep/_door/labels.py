"""Regions of the cells of a Mesh: labels of the format, of cell data with a usual name, and groups."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from .mesh import Indices, Mesh

LABELS = (
    "gmsh:physical", "region", "regions", "medit:ref", "cell_tags", "tetgen:ref", "nastran:ref", "netgen:index", "CellEntityIds", "material",
    "materials", "MaterialIds", "MaterialID", "material_id", "attribute", "attributes", "label", "labels", "RegionId", "region_id", "BlockIds",
    "ElementBlockIds", "ObjectId", "PhysicalIds", "physical", "domain", "domains", "subdomain", "subdomain_id", "zone", "ZoneId", "part",
    "part_id", "PartId", "avsucd:material", "abaqus:elset", "flac3d:group", "su2:tag", "ugrid:ref", "EntityIds", "gmsh:geometrical",
)  # fmt: skip
"""Arrays of cells that are labels: names as usual writers give them, the first that a file has."""

FACE_LABELS = (*LABELS, "BoundaryIds", "boundary", "tetgen:marker", "patch", "PatchId", "ModelFaceID")
"""Arrays of faces that are labels, in the order in which they are looked for."""


def regions_of(mesh: Mesh, name: str | None) -> tuple[NDArray[Any] | None, dict[str, Any]]:
    """A label for each cell, or None, and for each name its label, or labels. name: of the array, or group, that labels cells; by default what
    there is."""
    return _atoms(*_regions(mesh, name), mesh)



def _regions(mesh: Mesh, name: str | None) -> tuple[NDArray[Any] | None, dict[str, Indices]]:
    """Labels of cells, if there are any, and the groups of cells."""
    if name is not None and name in mesh.cell_groups and name not in mesh.cell_data:
        return None, {name: mesh.cell_groups[name]}
    if name is not None:
        if name not in mesh.cell_data:
            known = ", ".join(repr(each) for each in [*mesh.cell_data, *mesh.cell_groups]) or "none"
            raise MeshError(mesh.source, f"it has no array or group of cells called {name!r}", f"those that it has: {known}")
        return _labels(mesh, name, mesh.cell_data[name]), mesh.cell_groups
    if mesh.regions is not None:
        return _labels(mesh, "regions", mesh.regions), mesh.cell_groups
    for usual in LABELS:
        array = mesh.cell_data.get(usual)
        if array is None:
            continue
        if np.asarray(array).dtype.kind in "iu" and np.ndim(array) == 1:
            return _labels(mesh, usual, array), mesh.cell_groups
        mesh.notes.append(f"the array {usual!r} has no integers: it is not taken as labels")
    return None, mesh.cell_groups


def _labels(mesh: Mesh, name: str, values: Any) -> NDArray[Any]:
    """Labels as Environment takes them: no number is changed so that it fits."""
    array: NDArray[Any] = np.asarray(values)
    if array.ndim == 2 and array.shape[1] == 1:
        array = array[:, 0]
    if array.dtype.kind not in "iu" or array.shape != (len(mesh.types),):
        raise MeshError(mesh.source, f"the array {name!r} is {array.dtype} of shape {array.shape}", "labels of regions are one integer for each cell")
    low, high = (array.min(initial=0), array.max(initial=0)) if array.size else (0, 0)
    if low < -(2**31) or high >= 2**31:
        found = f"the array {name!r} has numbers from {low} to {high}"
        raise MeshError(mesh.source, found, "labels of regions have 32 bits; another array or regions= of Environment may be used")
    return array


def _atoms(labels: NDArray[Any] | None, groups: dict[str, Indices], mesh: Mesh) -> tuple[NDArray[Any] | None, dict[str, Any]]:
    """Labels, and for each name its labels. Groups that overlap, or that hold a part of a label only, get labels for what they have in common."""
    names: dict[str, Any] = dict(mesh.region_names)
    names = {name: label for name, label in names.items() if name not in groups}
    if not groups:
        return labels, names if labels is not None else {}
    count = len(mesh.types)
    for name, cells in groups.items():
        if len(cells) and not (0 <= np.min(cells) and np.max(cells) < count):
            raise MeshError(mesh.source, f"the group {name!r} names cell {int(np.max(cells))}, there are {count}", "the program that made it may be asked again")
    taken = np.zeros(count, np.int32)
    for cells in groups.values():
        taken[cells] += 1
    if labels is None and not (taken > 1).any():
        single = np.zeros(count, np.int32)
        for i, cells in enumerate(groups.values(), 1):
            single[cells] = i
        return single, {**names, **{name: i for i, name in enumerate(groups, 1)}}
    base = np.zeros(count, np.int64) if labels is None else labels.astype(np.int64)
    kinds, kind = _kinds(base, list(groups.values()))
    if labels is None:
        number = np.cumsum((kinds[:, 1:] == 0).any(axis=1)) * (kinds[:, 1:] == 0).any(axis=1)
    else:
        number = kinds[:, 0].copy()
        again = np.concatenate([[False], kinds[1:, 0] == kinds[:-1, 0]])
        number[again] = max(int(base.max()), 0) + 1 + np.arange(again.sum())
        for label in np.unique(kinds[again, 0]).tolist():
            parts = number[kinds[:, 0] == label].tolist()
            mesh.notes.append(f"region {label} is divided into {', '.join(map(str, parts))}: groups of cells hold parts of it")
            names = {name: tuple(parts) if value == label else value for name, value in names.items()}
    for i, name in enumerate(groups):
        held = number[kinds[:, 1 + i] == 0].tolist()
        names[name] = held[0] if len(held) == 1 else tuple(held)
    return number[kind].astype(np.int32), {name: value for name, value in names.items() if value != ()}


def _kinds(base: NDArray[np.int64], groups: list[Indices]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """What cells can be: rows of a label and, for each group, 0 for its cells and 1 for others, in ascending order, so that of each label what
    most groups have is first; and the row of each cell. Each step numbers what there is anew, without sorting cells."""
    low = int(base.min(initial=0))
    spread = int(base.max(initial=0)) - low + 1
    if spread <= 4 * len(base) + 1024:
        present = np.bincount(base - low, minlength=1) > 0
        values, kind = np.flatnonzero(present) + low, (np.cumsum(present) - 1)[base - low]
    else:
        values, kind = np.unique(base, return_inverse=True)
    rows = values[:, np.newaxis]
    for cells in groups:
        outside = np.ones(len(base), np.int64)
        outside[cells] = 0
        step = 2 * kind + outside
        present = np.bincount(step, minlength=1) > 0
        there = np.flatnonzero(present)
        rows = np.column_stack([rows[there // 2], there % 2])
        kind = (np.cumsum(present) - 1)[step]
    return rows, kind
