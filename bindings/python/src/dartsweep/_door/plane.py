"""Meshes of the plane, wherever they lie in space."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from .._names import PlaneFrame
from .error import MeshError
from . import linear
from .mesh import Mesh

FLAT = 1e-5
"""How far points of a plane may lie from it, over their extent: files have coordinates of 32 bits."""


def flatten(mesh: Mesh) -> tuple[Mesh, PlaneFrame | None]:
    """The mesh with two coordinates if its cells are triangles, quads or polygons; and where its plane lies. A plane across an axis keeps its
    coordinates bit by bit."""
    if not is_of_surface(mesh) or mesh.points.shape[1] == 2:
        return mesh, None
    frame, distance = _frame(mesh)
    if not distance <= FLAT:
        found = f"a surface of {len(mesh.types)} cells that lie in no plane: points are {distance:g} of their extent from the nearest one"
        raise MeshError(mesh.source, found, "dartsweep.from_surface fills a closed surface of triangles")
    across = np.flatnonzero((frame.axes == 0).all(axis=0))
    if len(across) == 0:
        normal = ", ".join(f"{each:g}" for each in np.cross(*frame.axes))
        note = f"the mesh lies in a plane across ({normal}), up to {distance:g} of its extent; `plane` has the axes of its coordinates"
        return _projected(mesh, (mesh.points - frame.origin) @ frame.axes.T, note), frame
    axis = int(across[0])
    along = [k for k in range(3) if k != axis]
    note = f"the mesh lies in the plane {'xyz'[axis]} = {frame.origin[axis]:g}; its coordinates are {'xyz'[along[0]]} and {'xyz'[along[1]]}"
    is_usual = axis == 2 and frame.origin[2] == 0
    return _projected(mesh, mesh.points[:, along], None if is_usual else note), frame


def is_flat(mesh: Mesh) -> bool:
    """Whether all cells of a surface lie in one plane, up to the rounding of files."""
    return mesh.points.shape[1] == 2 or _frame(mesh)[1] <= FLAT


def is_of_surface(mesh: Mesh) -> bool:
    """Whether cells are triangles, quads and polygons."""
    return bool(linear.DIMENSION[mesh.types[0]] == 2)


def _projected(mesh: Mesh, points: NDArray[np.float64], note: str | None) -> Mesh:
    return dataclasses.replace(mesh, points=np.ascontiguousarray(points), notes=[*mesh.notes, *([] if note is None else [note])])


def _frame(mesh: Mesh) -> tuple[PlaneFrame, float]:
    """The plane that is nearest to the points of all cells, and how far they are from it, over their extent."""
    used = mesh.points[np.unique(mesh.connectivity)]
    flat = np.flatnonzero((used == used[0]).all(axis=0))
    if len(flat) > 0:
        origin = np.zeros(3)
        origin[flat[-1]] = used[0, flat[-1]]
        return PlaneFrame(origin, np.delete(np.eye(3), flat[-1], axis=0)), 0.0
    origin = used.mean(axis=0)
    extent = float(np.ptp(used, axis=0).max())
    normal = np.linalg.eigh(np.cov((used - origin).T / extent))[1][:, 0]
    normal = normal * np.sign(normal[np.argmax(np.abs(normal))])
    first = np.eye(3)[np.argmin(np.abs(normal))]
    first = first - normal * (first @ normal)
    first /= np.linalg.norm(first)
    return PlaneFrame(origin, np.stack([first, np.cross(normal, first)])), float(np.abs((used - origin) @ normal).max()) / extent
