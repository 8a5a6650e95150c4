"""Small meshes of all types in VTK's classic numbers, and measures of environments that ask the library only."""

from __future__ import annotations

from typing import Any

import numpy as np

import dartsweep as ds

PRISM = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)], float)
CUBE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
CUBE_FACES = [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [0, 3, 2, 1], [4, 5, 6, 7]]
TETRA = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)


def box(count: int = 2) -> tuple[Any, Any]:
    """Points and hexahedra of the box from 0 to 1, 2 and 3, divided `count` times each way."""
    lines = [np.linspace(0, end, count + 1) for end in (1, 2, 3)]
    points = np.array([(x, y, z) for z in lines[2] for y in lines[1] for x in lines[0]])
    n = count + 1
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    first = [i + n * (j + n * k) for k in range(count) for j in range(count) for i in range(count)]
    return points, np.array(first)[:, None] + np.array([a + n * (b + n * c) for a, b, c in corners])


def volume_of(environment: ds.Environment) -> float:
    """Sum of the volumes of all cells, or their areas in the plane, from the faces that the library gives."""
    points = environment.points()
    total = 0.0
    for index in range(environment.info.volume_count):
        volume = environment.volume_id(index)
        if environment.dimension == 2:
            x, y = points[environment.vertices(volume)["index"]].T
            total += 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
            continue
        for local in range(environment.volume_counts(volume).faces):
            face = environment.face_id(volume, local)
            corners = points[environment.vertices(face)["index"]]
            corners = corners if face.volume == index else corners[::-1]  # seen from outside of the volume in the id
            for b, c in zip(corners[1:], corners[2:]):
                total += float(corners[0] @ np.cross(b, c)) / 6
    return total


def content(environment: ds.Environment) -> list[Any]:
    """All that a mesh says: points, and of each cell its type, vertices and region."""
    cells = [environment.volume_id(index) for index in range(environment.info.volume_count)]
    of_cells = [
        (int(environment.volume_counts(cell).type), environment.vertices(cell)["index"].tolist(), environment.region(cell)) for cell in cells
    ]
    return [environment.points().tolist(), of_cells]
