"""TetGen fills the lumen, then the tissue; both keep the triangles between them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .arrays import Indices, Points, Refused, areas, components, inside_volumes, numbers, volumes

LUMEN, TISSUE = 1, 2  # as in surfaces.py
SIZE = 0.8  # of edges by default, over the lumen's width: a few cells lie side by side across it


def filled(
    points: Points, wall: Indices, outside: str, size: float | None, thickness: float | None
) -> tuple[Points, Indices, NDArray[np.int32], Indices]:
    """Points, cells, regions and the wall, out of the lumen."""
    count = len(points)
    width = 4 * inside_volumes(points, wall).sum() / areas(points, wall).sum()  # exact for a long tube
    places, cells, parts = _tetrahedra(points, wall, SIZE * width if size is None else size)

    # Behind each triangle of the surface the inside becomes outside, the outside inside.
    beside = np.append(parts, 0)[_sides(cells, wall, count)]
    part_count = parts.max() + 1
    crossings = np.concatenate([beside, beside[:, ::-1]])
    label = components(2 * part_count, crossings[:, 0], crossings[:, 1] + part_count)
    is_lumen = label[part_count:] == label[0]
    if np.any(is_lumen[beside[:, 0]] == is_lumen[beside[:, 1]]):
        raise Refused("TetGen can't keep its triangles: some of them nearly touch")
    wall = np.where(is_lumen[beside[:, 0]][:, np.newaxis], wall, wall[:, ::-1])
    cells, parts = cells[is_lumen[parts]], parts[is_lumen[parts]]
    used, index = np.unique(np.append(np.arange(count), cells), return_inverse=True)
    places, cells = places[used], index[count:].reshape(-1, 4)
    if outside == "nothing":
        return places, cells, np.full(len(cells), LUMEN, np.int32), wall

    margin = 2 * width if thickness is None else thickness
    box, sides = _box(points.min(axis=0) - margin, points.max(axis=0) + margin, margin)
    order = np.lexsort((volumes(places, cells), parts))
    seeds = places[cells[order[np.append(np.diff(parts[order]) != 0, True)]]].mean(axis=1)  # of the largest cell of each part
    around, tissue, _ = _tetrahedra(np.vstack([points, box]), np.concatenate([wall, sides + count]), math.inf, seeds)
    beside = _sides(tissue, wall, count)
    if np.any(beside[:, 0] >= 0) or np.any(beside[:, 1] < 0):
        raise Refused("TetGen can't keep its triangles: some of them nearly touch")
    tissue = np.where(tissue < count, tissue, tissue + len(places) - count)
    regions = np.repeat(np.array([LUMEN, TISSUE], np.int32), [len(cells), len(tissue)])
    return np.vstack([places, around[count:]]), np.concatenate([cells, tissue]), regions, wall


def _tetrahedra(points: Points, triangles: Indices, size: float, holes: Points | None = None) -> tuple[Points, Indices, Indices]:
    """Points, those of the surface first; cells of at most the volume of a regular tetrahedron with edges of a length; and the part of each
    cell, from 1 on. There are no cells in parts that hold one of the points `holes`."""
    import tetgen

    unit = 2.0 ** np.floor(np.log2(np.ptp(points, axis=0).max()))  # TetGen has limits that do not know the unit; these scalings are exact
    mesher = tetgen.TetGen(points / unit, np.ascontiguousarray(triangles, np.int32))
    for hole in [] if holes is None else holes:
        mesher.add_hole(hole / unit)
    limit = {"fixedvolume": True, "maxvolume": (size / unit) ** 3 / math.sqrt(72)} if size < math.inf else {}
    try:
        mesher.tetrahedralize(
            plc=True, nobisect=True, quality=True, minratio=1.5, mindihedral=5, steinerleft=-1, regionattrib=True, quiet=True, **limit
        )
    except RuntimeError as error:
        raise Refused(f"TetGen can't fill it ({error})") from error
    places = mesher.node * unit
    if not np.array_equal(places[: len(points)], points):
        raise Refused("TetGen can't keep its points: some of them nearly touch")
    return places, np.array(mesher.elem, np.int64), np.array(mesher.attributes, np.int64).ravel()


def _sides(cells: Indices, triangles: Indices, point_count: int) -> Indices:
    """For each triangle of the first points the cell behind it and that in front of it, where its normal points; -1 for none."""
    faces = cells[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)  # normals out of the cell
    candidates = np.flatnonzero((faces < point_count).all(axis=1))
    number = numbers(np.concatenate([triangles, faces[candidates]]), point_count)
    triangle_of = np.full(number.max() + 1, -1)
    triangle_of[number[: len(triangles)]] = np.arange(len(triangles))
    triangle = triangle_of[number[len(triangles) :]]
    candidates, triangle = candidates[triangle >= 0], triangle[triangle >= 0]
    is_in_front = _is_even(faces[candidates]) != _is_even(triangles[triangle])
    sides = np.full((len(triangles), 2), -1)
    sides[triangle, is_in_front.astype(int)] = candidates // 4
    return sides


def _is_even(rows: Indices) -> NDArray[np.bool_]:
    """Whether an even number of exchanges sorts a row of three."""
    a, b, c = rows.T
    return (a < b) ^ (b < c) ^ (a < c)  # type: ignore[no-any-return]


def _box(low: Points, high: Points, step: float) -> tuple[Points, Indices]:
    """Points and triangles of a box, in squares of about a step."""
    counts = np.clip(np.ceil((high - low) / step), 1, 16).astype(int)
    rows = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        corner = np.zeros((counts[u], counts[v], 3), int)
        corner[..., u], corner[..., v] = np.ogrid[: counts[u], : counts[v]]
        steps = np.eye(3, dtype=int)[[u, v]]
        square = np.stack([corner, corner + steps[0], corner + steps[0] + steps[1], corner + steps[1]], axis=-2).reshape(-1, 4, 3)
        for side in (0, counts[axis]):
            square[..., axis] = side
            rows.append(square[:, [0, 1, 2]])
            rows.append(square[:, [0, 2, 3]])
    lattice, index = np.unique(np.concatenate(rows).reshape(-1, 3), axis=0, return_inverse=True)
    return low + lattice * ((high - low) / counts), index.reshape(-1, 3)
