"""Meshes of the plane, wherever they lie in space."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from .._names import PlaneFrame
from ..enums import CellType
from ..errors import MeshError
from .mesh import Indices, Mesh

FLAT = 1e-5
"""How far points of a plane may lie from it, over their extent: files have coordinates of 32 bits."""

_PLANAR = (CellType.TRIANGLE, CellType.QUAD, CellType.POLYGON)


def flatten(mesh: Mesh) -> tuple[Mesh, PlaneFrame | None]:
    """The mesh with two coordinates if its cells are triangles, quads or polygons; and where its plane lies. A plane across an axis keeps its
    coordinates bit by bit."""
    if len(mesh.types) == 0 or mesh.types[0] not in _PLANAR:
        return mesh, None
    points, frame = mesh.points, None
    if points.shape[1] == 3:
        points, frame = _in_plane(mesh)
    turned = _areas(points, mesh.offsets, mesh.connectivity) < 0
    if turned.any() and turned.all():
        mesh.notes.append("All cells run clockwise: they are turned.")
        mesh = dataclasses.replace(mesh, connectivity=_reversed(mesh.offsets, mesh.connectivity))
    return dataclasses.replace(mesh, points=np.ascontiguousarray(points)), frame


def _in_plane(mesh: Mesh) -> tuple[NDArray[np.float64], PlaneFrame]:
    points, used = mesh.points, mesh.points[np.unique(mesh.connectivity)]
    flat = np.flatnonzero((used == used[0]).all(axis=0))
    if len(flat) > 0:
        across = int(flat[-1])
        along = [axis for axis in range(3) if axis != across]
        origin = np.zeros(3)
        origin[across] = used[0, across]
        if across != 2 or origin[2] != 0:
            mesh.notes.append(f"The mesh lies in the plane {'xyz'[across]} = {origin[across]:g}; its coordinates are {'xyz'[along[0]]} and {'xyz'[along[1]]}.")
        return points[:, along], PlaneFrame(origin, np.eye(3)[along])
    origin = used.mean(axis=0)
    extent, directions = np.linalg.eigh(np.cov((used - origin).T))
    normal = directions[:, 0]
    distance = float(np.abs((used - origin) @ normal).max())
    size = float(np.ptp(used, axis=0).max())
    if not distance <= FLAT * size:
        found = f"a surface of {len(mesh.types)} cells that lie in no plane: points are {distance:g} from the nearest one"
        raise MeshError(mesh.source, found, "dartsweep.from_surface fills a closed surface of triangles")
    normal = normal * np.sign(normal[np.argmax(np.abs(normal))])
    first = np.eye(3)[np.argmin(np.abs(normal))]
    first = first - normal * (first @ normal)
    first /= np.linalg.norm(first)
    axes = np.stack([first, np.cross(normal, first)])
    mesh.notes.append(f"The mesh lies in a plane across ({', '.join(f'{each:g}' for each in normal)}), at most {distance:g} from it; `plane` has its axes.")
    return (points - origin) @ axes.T, PlaneFrame(origin, axes)


def _areas(points: NDArray[np.float64], offsets: Indices, corners: Indices) -> NDArray[np.float64]:
    """Twice the signed area of each cell."""
    following = np.arange(1, len(corners) + 1)
    following[offsets[1:] - 1] = offsets[:-1]
    start = points[np.repeat(corners[offsets[:-1]], np.diff(offsets))]
    a, b = points[corners] - start, points[corners[following]] - start
    return np.add.reduceat(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], offsets[:-1])


def _reversed(offsets: Indices, corners: Indices) -> Indices:
    """Each cell's points in the opposite order."""
    sizes = np.diff(offsets)
    within = np.arange(len(corners)) - np.repeat(offsets[:-1], sizes)
    return corners[np.repeat(offsets[1:] - 1, sizes) - within]
