"""A vessel made here: a square tube of hexahedra that winds, with a wall of one cell round its lumen."""

from __future__ import annotations

import numpy as np

import dartsweep as ds

WIDTH, LENGTH = 6, 40
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def axis(z: np.ndarray) -> np.ndarray:
    """Where the middle of the lumen is at heights z: straight at the inlet z = 0, then to one side and back."""
    return np.stack([4 * (1 - np.cos(np.pi * z / 20)), 2 * (1 - np.cos(np.pi * z / 13)), z], axis=-1)


def winding_tube() -> ds.Environment:
    """The environment; the lumen is 4 wide, walls are impassable."""
    i, j, k = np.meshgrid(np.arange(WIDTH + 1), np.arange(WIDTH + 1), np.arange(LENGTH + 1), indexing="ij")
    points = np.stack([i - WIDTH / 2, j - WIDTH / 2, np.zeros(k.shape)], axis=-1) + axis(k.astype(float))
    index = np.arange(k.size).reshape(k.shape)
    cells = np.stack([index[a : a + WIDTH, b : b + WIDTH, c : c + LENGTH].ravel() for a, b, c in CORNERS], axis=1)
    inner = (i > 0) & (i < WIDTH - 1) & (j > 0) & (j < WIDTH - 1)
    regions = np.where(inner[:WIDTH, :WIDTH, :LENGTH].ravel(), 1, 2)
    environment = ds.Environment(points.reshape(-1, 3), cells, regions=regions)
    environment.mark_region(2)
    return environment
