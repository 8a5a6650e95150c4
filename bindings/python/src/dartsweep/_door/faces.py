"""Surfaces of the environment of a mesh: named groups of faces, and labels of faces."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from .._core import VolumeId
from ..enums import CellType
from ..environment import Environment
from ..errors import NotFound, OutOfRange
from .labels import FACE_LABELS
from .mesh import Indices, Mesh
from .ragged import take

_MOST_CORNERS = 16
"""Triangles are looked for in faces with so many corners: a face with n has n (n - 1) (n - 2) / 6."""


def name(made: Environment, mesh: Mesh) -> None:
    """Names the surfaces of an environment as its mesh does. A note tells how many faces of a surface are not there."""
    groups, tags = dict(mesh.face_groups), dict(mesh.face_numbers)
    if not groups:
        groups, tags = _groups_of_labels(mesh)
    groups = {name: faces for name, faces in groups.items() if len(faces)}
    if not groups:
        return
    surfaces = made._names.surfaces
    surfaces.add(mesh.face_offsets, mesh.face_vertices, groups, {name: tags[name] for name in groups if name in tags})
    missing = surfaces.ids(made)["generation"] == 0
    if np.any(missing) and made._core.build_report().split_count != 0:
        _add_triangles(made, mesh, groups, missing)
    if np.any(missing):
        _add_with_more_points(made, mesh, groups, missing)
    for name, faces in groups.items():
        lost = int(missing[faces].sum())
        if lost:
            mesh.notes.append(f"{lost} of {len(faces)} faces of the surface {name!r} are faces of no cell")


def _groups_of_labels(mesh: Mesh) -> tuple[dict[str, Indices], dict[str, int]]:
    """Faces that carry labels without names: each label is a surface, and its name is the number."""
    for usual in FACE_LABELS:
        array = np.asarray(mesh.face_data.get(usual, ()))
        if array.dtype.kind not in "iu" or array.shape != (len(mesh.face_offsets) - 1,):
            continue
        numbers = [int(number) for number in np.unique(array)]
        return {str(number): np.flatnonzero(array == number) for number in numbers}, {str(number): number for number in numbers}
    return {}, {}


def _add_triangles(made: Environment, mesh: Mesh, groups: dict[str, Indices], missing: NDArray[np.bool_]) -> None:
    """Faces of cells that were split are triangles now: those between the corners of a face belong to its surfaces."""
    named = np.unique(np.concatenate(list(groups.values())))
    chosen = named[missing[named]]
    sizes, flat = take(mesh.face_offsets, mesh.face_vertices, chosen)
    owners, rows = [np.empty(0, np.int64)], [np.empty((0, 3), np.int64)]
    for face, corners in zip(chosen.tolist(), np.split(flat, np.cumsum(sizes)[:-1])):
        if 3 < len(corners) <= _MOST_CORNERS:
            triples = np.array(list(itertools.combinations(corners.tolist(), 3)))
            owners.append(np.full(len(triples), face))
            rows.append(triples)
    owner, corners = np.concatenate(owners), np.concatenate(rows)
    ids = made.find_faces(np.arange(0, corners.size + 1, 3), corners.ravel())
    is_part = np.array([bool(face["generation"]) and not _is_inside(made, face) for face in ids], np.bool_)
    owner, corners = owner[is_part], corners[is_part]
    missing[owner] = False
    parts = {name: np.flatnonzero(np.isin(owner, faces)) for name, faces in groups.items()}
    made._names.surfaces.add(np.arange(0, corners.size + 1, 3), corners.ravel(), {name: own for name, own in parts.items() if len(own)}, {})


def _add_with_more_points(made: Environment, mesh: Mesh, groups: dict[str, Indices], missing: NDArray[np.bool_]) -> None:
    """A face beside smaller cells has hanging points on its sides, too, once the mesh is conforming. Its cell keeps its index."""
    named = np.unique(np.concatenate(list(groups.values())))
    wanted = {face: set(_corners(mesh, face)) for face in named[missing[named]].tolist()}
    is_corner = np.zeros(len(mesh.points), np.bool_)
    is_corner[[point for corners in wanted.values() for point in corners]] = True
    at = np.flatnonzero(is_corner[mesh.connectivity] & np.repeat(mesh.types != CellType.POLYHEDRON, np.diff(mesh.offsets)))
    cells: dict[int, set[int]] = {}
    for point, cell in zip(mesh.connectivity[at].tolist(), (np.searchsorted(mesh.offsets, at, side="right") - 1).tolist()):
        cells.setdefault(point, set()).add(cell)
    found: dict[int, Indices] = {}
    for face, corners in wanted.items():
        for cell in set.intersection(*(cells.get(point, set()) for point in corners)):
            around = [made.vertices(made.face_id(volume, i))["index"].astype(np.int64) for volume in _volume(made, cell) for i in range(made.volume_counts(volume).faces)]
            whole = [each for each in around if corners <= set(each.tolist())]
            if len(corners) > 2 and len(whole) == 1:
                found[face] = whole[0]
    if not found:
        return
    owner, rows = np.array(list(found)), list(found.values())
    missing[owner] = False
    parts = {name: np.flatnonzero(np.isin(owner, faces)) for name, faces in groups.items()}
    offsets = np.concatenate([[0], np.cumsum([len(row) for row in rows])])
    made._names.surfaces.add(offsets, np.concatenate(rows), {name: own for name, own in parts.items() if len(own)}, {})


def _corners(mesh: Mesh, face: int) -> list[int]:
    return mesh.face_vertices[mesh.face_offsets[face] : mesh.face_offsets[face + 1]].tolist()  # type: ignore[no-any-return]


def _volume(made: Environment, cell: int) -> list[VolumeId]:
    try:
        return [made.volume_id(cell)]
    except (NotFound, OutOfRange):
        return []


def _is_inside(made: Environment, face: np.void) -> bool:
    """Whether a face lies between two parts of one cell."""
    volume = made.volume_id(int(face["volume"]))
    behind = made.neighbour(volume, int(face["local"])).volume
    try:
        return behind.generation != 0 and made.parent(behind) == made.parent(volume)
    except NotFound:
        return False
