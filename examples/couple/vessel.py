"""A vessel made here: a tube of tetrahedra that is straight at first and then winds in space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
BORE, SIDES, LAYER = 3e-3, 8, 5e-3  # its radius, corners of a cross section, distance of two of them; metres


def winding_axis(straight: float, winding: float) -> tuple[Points, Points, Points]:
    """An axis, its directions, and normals that do not turn about it."""
    along = np.arange(0, straight + winding, LAYER)
    way = np.maximum(along - straight, 0)
    tilt, turn = 1.1 * np.sin(way / 0.025), 25 * np.maximum(way - 0.03, 0)
    tangent = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=1)
    axis = np.vstack([np.zeros(3), np.cumsum(LAYER * (tangent[1:] + tangent[:-1]) / 2, axis=0)])
    normal = np.tile([1.0, 0.0, 0.0], (len(along), 1))
    for k in range(1, len(along)):
        across = normal[k - 1] - (normal[k - 1] @ tangent[k]) * tangent[k]
        normal[k] = across / np.linalg.norm(across)
    return axis, tangent, normal


def tube(axis: Points, tangent: Points, normal: Points) -> tuple[Points, NDArray[np.int64]]:
    """Points and tetrahedra of a vessel round an axis. Its outer boundary is the wall."""
    angle = (2 * np.pi * np.arange(SIDES) / SIDES)[:, None, None]
    ring = BORE * (np.cos(angle) * normal + np.sin(angle) * np.cross(tangent, normal))
    points = np.concatenate([axis[None], axis + ring]).transpose(1, 0, 2)  # of each layer the centre first
    side = np.arange(SIDES)
    triangle = np.sort(np.stack([np.zeros_like(side), 1 + side, 1 + (side + 1) % SIDES], axis=1))
    wedge = np.hstack([triangle, triangle + SIDES + 1])
    parts = wedge[:, [[0, 1, 2, 5], [0, 1, 5, 4], [0, 3, 4, 5]]]
    parts[-1, :, :2] = parts[-1, :, 1::-1]  # the last triangle was turned over by the sorting
    cells = parts.reshape(-1, 4) + (SIDES + 1) * np.arange(len(axis) - 1)[:, None, None]
    return points.reshape(-1, 3), cells.reshape(-1, 4)
