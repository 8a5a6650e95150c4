"""Cells that name a point twice: hexahedra that are wedges or pyramids, as at an axis."""

from __future__ import annotations

import dataclasses

import numpy as np

from . import linear, polyhedra
from .linear import Cells
from .mesh import Indices, Mesh
from .orient import FACES


def opened(mesh: Mesh) -> Mesh | None:
    """The mesh with such cells as polyhedra of the faces that are left; None if there are none."""
    cells = Cells(mesh.types, mesh.offsets, mesh.connectivity)
    parts, rows = [], [np.empty(0, np.int64)]
    for kind, faces in FACES.items():
        of_type = np.flatnonzero(mesh.types == kind)
        corners = cells.some(of_type).flat.reshape(len(of_type), -1) if len(of_type) else np.empty((0, 4), np.int64)
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
    return dataclasses.replace(
        mesh, types=every.types, offsets=every.offsets, connectivity=every.flat, notes=[*mesh.notes, note]
    )


def _polyhedra(corners: Indices, faces: list[tuple[int, ...]]) -> Cells:
    counts, sizes, points = np.zeros(len(corners), np.int64), [], []
    for i, row in enumerate(corners.tolist()):
        left = [[row[k] for k, before in zip(face, (face[-1], *face)) if row[k] != row[before]] for face in faces]
        kept = [face for face in left if len(set(face)) > 2]
        counts[i] = len(kept)
        sizes += [len(face) for face in kept]
        points += [point for face in kept for point in face]
    return polyhedra.cells_of_faces(counts, np.array(sizes, np.int64), np.array(points, np.int64))
