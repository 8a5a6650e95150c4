"""Polyhedra: face streams from the ways in which libraries keep them, and faces that are turned alike."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from .linear import POLYHEDRON, Cells
from .mesh import Indices
from .ragged import offsets_of, positions


def cells_of_faces(face_counts: Any, face_sizes: Any, points: Any) -> Cells:
    """Polyhedra of their numbers of faces, and the sizes and points of all faces of the first cell, then of the second, and so on."""
    face_counts, face_sizes, points = (np.asarray(values, np.int64) for values in (face_counts, face_sizes, points))
    cell_of_face = np.repeat(np.arange(len(face_counts)), face_counts)
    integers = 1 + face_counts + np.bincount(cell_of_face, face_sizes, len(face_counts)).astype(np.int64)
    offsets = offsets_of(integers)
    flat = np.empty(int(offsets[-1]), np.int64)
    is_point = np.ones(len(flat), np.bool_)
    face_starts = np.arange(len(face_sizes)) + offsets_of(face_sizes)[:-1] + cell_of_face + 1
    is_point[offsets[:-1]] = is_point[face_starts] = False
    flat[is_point] = points
    flat[offsets[:-1]], flat[face_starts] = face_counts, face_sizes
    return Cells(np.full(len(face_counts), POLYHEDRON, np.uint8), offsets, flat)


def faces_of_cells(cells: Cells, source: str) -> tuple[Indices, Indices, Indices]:
    """How many faces each polyhedron has; where in `flat` the points of each face begin, and how many they are."""
    starts, ends = cells.offsets[:-1], cells.offsets[1:]
    damaged = MeshError(source, "the faces of a polyhedron do not fill its stream", "the file is damaged")
    if np.any(ends == starts):
        raise damaged
    counts = cells.flat[starts]
    face_offsets = offsets_of(counts)
    places, sizes = np.empty(int(face_offsets[-1]), np.int64), np.empty(int(face_offsets[-1]), np.int64)
    at = starts + 1
    for k in range(int(counts.max(initial=0))):
        cell = np.flatnonzero(counts > k)
        if np.any(at[cell] >= ends[cell]):
            raise damaged
        face = face_offsets[cell] + k
        sizes[face], places[face] = cells.flat[at[cell]], at[cell] + 1
        at[cell] += sizes[face] + 1
    if np.any(at != ends) or np.any(sizes < 3):
        raise damaged
    return counts, places, sizes


def consistent(points: NDArray[np.float64], cells: Cells, source: str) -> tuple[Cells, int]:
    """Cells with all faces of polyhedra counter-clockwise seen from outside; and in how many polyhedra faces had to be turned."""
    rows = np.flatnonzero(cells.types == POLYHEDRON)
    if len(rows) == 0:
        return cells, 0
    some = cells.some(rows)
    counts, places, sizes = faces_of_cells(some, source)
    corner = positions(places, sizes)
    vertices = some.flat[corner]
    if int(vertices.max(initial=0)) >= len(points):
        raise MeshError(source, f"a polyhedron names point {vertices.max()} of {len(points)}", "the file is damaged")
    cell_of_face = np.repeat(np.arange(len(rows)), counts)
    sign = _alike(cell_of_face, sizes, vertices, rows, source)
    volume = np.bincount(cell_of_face, sign * _fans(points, vertices, sizes, cell_of_face), len(rows))
    sign = np.where(volume[cell_of_face] < 0, -sign, sign)
    turned = np.flatnonzero(sign < 0)
    if len(turned) == 0:
        return cells, 0
    if len(rows) == len(cells.types):
        flat, shift = some.flat, places
    else:
        flat, shift = cells.flat.copy(), places + np.repeat(cells.offsets[rows] - some.offsets[:-1], counts)
    to = positions(shift[turned], sizes[turned])
    last = np.repeat(shift[turned] + sizes[turned] - 1, sizes[turned])
    flat[to] = flat[last - (to - np.repeat(shift[turned], sizes[turned]))]
    return Cells(cells.types, cells.offsets, flat), len(np.unique(cell_of_face[turned]))


def _alike(cell_of_face: Indices, sizes: Indices, vertices: Indices, rows: Indices, source: str) -> NDArray[np.int64]:
    """For each face 1 or -1: how it is turned against the first face of its cell."""
    face = np.repeat(np.arange(len(sizes)), sizes)
    ends = np.cumsum(sizes)
    following = np.arange(1, len(vertices) + 1)
    following[ends - 1] = ends - sizes
    other = vertices[following]
    low, high = np.minimum(vertices, other), np.maximum(vertices, other)
    order = np.lexsort((high, low, cell_of_face[face]))
    cell, low, high = cell_of_face[face][order], low[order], high[order]
    is_pair = len(order) % 2 == 0 and all(np.array_equal(values[::2], values[1::2]) for values in (cell, low, high))
    if not is_pair:
        raise MeshError(source, f"the faces of polyhedron {_unpaired(cell, low, high, rows)} do not close it", "each side needs two faces")
    a, b = face[order[::2]], face[order[1::2]]
    relation = np.where(vertices[order[::2]] == vertices[order[1::2]], -1, 1)  # the same way along the side: turned against each other
    return _spread(cell_of_face, a, b, relation)


def _unpaired(cell: Indices, low: Indices, high: Indices, rows: Indices) -> int:
    """The first cell with a side that has not two faces."""
    keys, counts = np.unique(np.stack([cell, low, high], axis=1), axis=0, return_counts=True)
    return int(rows[keys[np.flatnonzero(counts != 2)[0], 0]])


def _spread(cell_of_face: Indices, a: Indices, b: Indices, relation: Indices) -> NDArray[np.int64]:
    """Goes from the first faces of all cells over sides to all others, one ring at a time."""
    sign = np.zeros(len(cell_of_face), np.int64)
    sign[np.flatnonzero(np.diff(cell_of_face, prepend=-1))] = 1
    while True:
        forth, back = np.flatnonzero((sign[a] != 0) & (sign[b] == 0)), np.flatnonzero((sign[b] != 0) & (sign[a] == 0))
        if len(forth) == 0 and len(back) == 0:
            return np.where(sign == 0, 1, sign)
        sign[b[forth]] = sign[a[forth]] * relation[forth]
        sign[a[back]] = sign[b[back]] * relation[back]


def _fans(points: NDArray[np.float64], vertices: Indices, sizes: Indices, cell_of_face: Indices) -> NDArray[np.float64]:
    """Volume under each face, as a fan from its first point, seen from a point of its cell."""
    starts = np.cumsum(sizes) - sizes
    first_of_cell = starts[np.flatnonzero(np.diff(cell_of_face, prepend=-1))]
    apex = points[vertices[first_of_cell]][cell_of_face]
    counts = sizes - 2
    second = positions(starts + 1, counts)
    face = np.repeat(np.arange(len(sizes)), counts)
    p = [points[vertices[at]] - apex[face] for at in (np.repeat(starts, counts), second, second + 1)]
    volumes: NDArray[np.float64] = np.einsum("ij,ij->i", p[0], np.cross(p[1], p[2]))
    return np.bincount(face, volumes, len(sizes)).astype(np.float64)
