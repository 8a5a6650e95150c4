"""Cells that name a point twice, or two points at one place: hexahedra that are wedges or pyramids, as at an axis."""

from __future__ import annotations

import dataclasses
import itertools

import numpy as np

from . import linear, polyhedra
from .blocks import renumbered
from .linear import Cells
from .mesh import Indices, Mesh
from .orient import FACES


def opened(mesh: Mesh) -> Mesh | None:
    """The mesh with such cells as polyhedra of the faces that are left; None if there are none."""
    cells, merged = _merged(mesh)
    parts, rows = [], [np.empty(0, np.int64)]
    for kind, faces in FACES.items():
        of_type = np.flatnonzero(mesh.types == kind)
        corners = _corners(cells, of_type)
        ordered = np.sort(corners, axis=1)
        chosen = np.flatnonzero(np.any(ordered[:, 1:] == ordered[:, :-1], axis=1))
        if len(chosen):
            parts.append(_polyhedra(corners[chosen], faces))
            rows.append(of_type[chosen])
    if not parts:
        return None
    some, replaced = linear.joined(parts), np.concatenate(rows)
    others = np.setdiff1d(np.arange(len(mesh.types)), replaced)
    order = np.argsort(np.concatenate([others, replaced]), kind="stable")
    every = linear.joined([cells.some(others), some]).some(order)
    note = f"{len(replaced)} cells name a point twice; they are polyhedra of the faces that are left"
    if merged is not None:
        note = f"{len(replaced)} cells have several points at one place, which are one now; they are polyhedra of the faces that are left"
        mesh = dataclasses.replace(mesh, face_vertices=merged[mesh.face_vertices])
    return dataclasses.replace(
        mesh, types=every.types, offsets=every.offsets, connectivity=every.flat, notes=[*mesh.notes, note]
    )


def _corners(cells: Cells, rows: Indices) -> Indices:
    return cells.some(rows).flat.reshape(len(rows), -1) if len(rows) else np.empty((0, 4), np.int64)


def _merged(mesh: Mesh) -> tuple[Cells, Indices | None]:
    """The cells, and the new index of each point. Points at one place are one if a cell has several of them; None if there are none."""
    cells = Cells(mesh.types, mesh.offsets, mesh.connectivity)
    touched = [np.empty(0, np.int64)]
    for kind in FACES:
        corners = _corners(cells, np.flatnonzero(mesh.types == kind))
        for a, b in itertools.combinations(range(corners.shape[1] if len(corners) else 0), 2):
            same = (corners[:, a] != corners[:, b]) & np.all(mesh.points[corners[:, a]] == mesh.points[corners[:, b]], axis=1)
            touched += [corners[same, a], corners[same, b]]
    points = np.unique(np.concatenate(touched))
    if len(points) == 0:
        return cells, None
    _, first, group = np.unique(mesh.points[points] + 0.0, axis=0, return_index=True, return_inverse=True)
    index = np.arange(len(mesh.points))
    index[points] = points[first][np.ravel(group)]
    return renumbered(cells, index), index


def _polyhedra(corners: Indices, faces: list[tuple[int, ...]]) -> Cells:
    counts, sizes, points = np.zeros(len(corners), np.int64), [], []
    for i, row in enumerate(corners.tolist()):
        left = [[row[k] for k, before in zip(face, (face[-1], *face)) if row[k] != row[before]] for face in faces]
        kept = [face for face in left if len(set(face)) > 2]
        counts[i] = len(kept)
        sizes += [len(face) for face in kept]
        points += [point for face in kept for point in face]
    return polyhedra.cells_of_faces(counts, np.array(sizes, np.int64), np.array(points, np.int64))
