"""Cells that a mesh has inside out: whole types are turned back, single cells are an error."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .. import errors
from ..enums import CellType
from .error import MeshError
from .mesh import Indices, Mesh
from .ragged import positions

_MIRRORED = {5: [0, 2, 1], 9: [0, 3, 2, 1], 10: [0, 2, 1, 3], 12: [0, 3, 2, 1, 4, 7, 6, 5], 13: [0, 2, 1, 3, 5, 4], 14: [0, 3, 2, 1, 4]}
FACES: dict[int, list[tuple[int, ...]]] = {  # counter-clockwise seen from outside
    10: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    12: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    13: [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
    14: [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
}
_Made = TypeVar("_Made")


def created(mesh: Mesh, create: Callable[[Mesh], _Made]) -> _Made:
    """What `create` makes of a mesh, after types of which every cell is inside out have been turned. The library decides exactly which
    cells are valid; this only looks for whole types once one is not."""
    try:
        return create(mesh)
    except (errors.InvertedCell, errors.InvalidCell, errors.DuplicateCell, errors.SharedFace):
        turned = _turned_back(mesh)
        if turned is None:
            raise
    try:
        return create(turned)
    except (errors.DuplicateCell, errors.SharedFace) as error:
        is_mixed = bool(np.any(signs(turned) * signs(mesh) > 0))
        if mesh.points.shape[1] == 3 or not is_mixed:
            raise
        raise _single_cells(mesh, signs(mesh), np.unique(mesh.types).tolist()) from error


def signs(mesh: Mesh) -> NDArray[np.int8]:
    """1 or -1 for each cell that surely is turned so; 0 where rounding or a polyhedron leaves it open."""
    made = np.zeros(len(mesh.types), np.int8)
    for kind in np.unique(mesh.types):
        rows = np.flatnonzero(mesh.types == kind)
        if int(kind) in FACES:
            made[rows] = _signs_of_volumes(mesh.points[_rows_of(mesh, rows)], FACES[int(kind)])
        elif kind != CellType.POLYHEDRON and mesh.points.shape[1] == 2:
            made[rows] = _signs_of_areas(mesh, rows)
    return made


def _rows_of(mesh: Mesh, rows: Indices) -> Indices:
    starts = mesh.offsets[rows]
    return mesh.connectivity[starts[:, None] + np.arange(mesh.offsets[rows[0] + 1] - starts[0])]


def _signs_of_volumes(corners: NDArray[np.float64], faces: list[tuple[int, ...]]) -> NDArray[np.int8]:
    """A cell is turned for sure if it is so whichever diagonals divide its quadrilaterals, which can be warped."""
    away = corners - corners[:, :1]
    low, high, size = np.zeros(len(corners)), np.zeros(len(corners)), np.zeros(len(corners))
    for face in faces:
        volumes = []
        for fan in (face,) if len(face) == 3 else (face, (*face[1:], face[0])):
            volume = np.zeros(len(corners))
            for b, c in zip(fan[1:], fan[2:]):
                p, q, r = away[:, fan[0]], away[:, b], away[:, c]
                volume += np.einsum("ij,ij->i", p, np.cross(q, r))
                size += np.abs(p).sum(axis=1) * np.abs(q).sum(axis=1) * np.abs(r).sum(axis=1)
            volumes.append(volume)
        low += np.minimum(volumes[0], volumes[-1])
        high += np.maximum(volumes[0], volumes[-1])
    scale = np.abs(corners).max(axis=(1, 2)) * np.abs(away).max(axis=(1, 2)) ** 2
    bound = 64 * np.finfo(np.float64).eps * (size + scale)
    return np.where(low > bound, 1, np.where(high < -bound, -1, 0)).astype(np.int8)


def _signs_of_areas(mesh: Mesh, rows: Indices) -> NDArray[np.int8]:
    starts, sizes = mesh.offsets[rows], mesh.offsets[rows + 1] - mesh.offsets[rows]
    at = positions(starts, sizes)
    cell = np.repeat(np.arange(len(rows)), sizes)
    following = at + 1
    following[np.cumsum(sizes) - 1] = starts
    origin = mesh.points[mesh.connectivity[starts]][cell]
    p, q = mesh.points[mesh.connectivity[at]] - origin, mesh.points[mesh.connectivity[following]] - origin
    area = np.bincount(cell, p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0], len(rows)).astype(np.float64)
    size = np.bincount(cell, np.abs(p).sum(axis=1) * np.abs(q).sum(axis=1), len(rows)).astype(np.float64)
    return _sure(area, 64 * np.finfo(np.float64).eps * size)


def _sure(values: NDArray[np.float64], bounds: NDArray[np.float64]) -> NDArray[np.int8]:
    made = np.sign(values).astype(np.int8)
    made[np.abs(values) <= bounds] = 0
    return made


def _turned_back(mesh: Mesh) -> Mesh | None:
    """The mesh with those types turned of which no cell surely is right; None where there are none.

    Raises MeshError if some cells of a type are inside out and others are not."""
    sign = signs(mesh)
    whole: list[int] = []
    single: list[int] = []
    for kind in np.unique(mesh.types[sign < 0]):
        (single if np.any(sign[mesh.types == kind] > 0) else whole).append(int(kind))
    ascending = [kind for kind in single if kind in (5, 10) and _is_ascending(mesh, kind)]
    is_plane = mesh.points.shape[1] == 2
    single = [kind for kind in single if kind not in ascending and not is_plane]
    if single:
        raise _single_cells(mesh, sign, single)
    if not np.any(sign < 0):
        return None
    connectivity, notes = mesh.connectivity.copy(), list(mesh.notes)
    for kind in whole:
        rows = np.flatnonzero(mesh.types == kind)
        _mirror(mesh, rows, kind, connectivity)
        notes.append(f"all {len(rows)} cells of type {CellType(kind).name.lower()} were inside out and have been turned")
    if is_plane:
        _turn_in_the_plane(mesh, sign, connectivity, notes)
    for kind in () if is_plane else ascending:
        rows = np.flatnonzero((mesh.types == kind) & (sign < 0))
        _mirror(mesh, rows, kind, connectivity)
        notes.append(f"{len(rows)} cells of type {CellType(kind).name.lower()} have been turned: points ascend in each, as in DOLFIN")
    return dataclasses.replace(mesh, connectivity=connectivity, notes=notes)


def _single_cells(mesh: Mesh, sign: NDArray[np.int8], kinds: list[int]) -> MeshError:
    """The error about cells of some types that are inside out while others are not."""
    wrong = np.flatnonzero((sign < 0) & np.isin(mesh.types, kinds))
    names = " and ".join(CellType(kind).name.lower() for kind in kinds if kind in mesh.types[wrong])
    count = int(np.isin(mesh.types, kinds).sum())
    return MeshError(
        mesh.source,
        f"{len(wrong)} of {count} cells of type {names} are inside out, the first is cell {wrong[0]}",
        ('quadratic="split" follows the curves of the cells; ' if any("split" in note for note in mesh.notes) else "")
        + "flags=EnvironmentFlag.REORIENT mirrors them",
    )


def _turn_in_the_plane(mesh: Mesh, sign: NDArray[np.int8], connectivity: Indices, notes: list[str]) -> None:
    """Writers turn cells of the plane as the surface is turned that they lie on. A cell that is folded over others stays an error:
    once it is turned it lies on the same side of an edge as its neighbour."""
    rows = np.flatnonzero(sign < 0)
    mixed = [kind for kind in np.unique(mesh.types[rows]).tolist() if np.any(sign[mesh.types == kind] > 0)]
    for kind in mixed:
        own = rows[mesh.types[rows] == kind]
        _mirror(mesh, own, kind, connectivity)
        notes.append(f"{len(own)} cells of type {CellType(kind).name.lower()} were clockwise and have been turned")


def _is_ascending(mesh: Mesh, kind: int) -> bool:
    """Whether the points of each cell of a type ascend: then their order does not tell how a cell is turned."""
    corners = _rows_of(mesh, np.flatnonzero(mesh.types == kind))
    return bool(np.all(corners[:, 1:] > corners[:, :-1]))


def _mirror(mesh: Mesh, rows: Indices, kind: int, connectivity: Indices) -> None:
    starts, sizes = mesh.offsets[rows], mesh.offsets[rows + 1] - mesh.offsets[rows]
    if kind in _MIRRORED:
        order = np.array(_MIRRORED[kind])
        connectivity[starts[:, None] + np.arange(len(order))] = mesh.connectivity[starts[:, None] + order]
    else:  # polygons
        at = positions(starts, sizes)
        connectivity[at] = mesh.connectivity[np.repeat(2 * starts + sizes - 1, sizes) - at]
