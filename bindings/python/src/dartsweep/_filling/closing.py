"""A surface becomes closed: its parts, how its triangles are turned, and caps on its open ends."""

from __future__ import annotations

import math

import numpy as np

from . import meshfix
from .arrays import Indices, Mendable, Points, Refused, areas, at, components, inside_volumes, used

Closed = tuple[Points, Indices, int, int, int]

FLAT = 1e-9  # volume over the power 3/2 of the area; TetGen takes what is flatter for a sheet


def surface(points: Points, triangles: Indices, parts: str, largest_hole: float) -> Closed:
    """The parts that are asked for, closed: points, triangles, how many of them are no caps, and how many open ends and parts there were."""
    triangles, part_count = chosen(points, triangles, parts)
    points, triangles = used(points, triangles)
    points, wall, hole_count = closed(points, triangles, largest_hole, len(triangles))
    return points, wall, len(triangles), hole_count, part_count


def chosen(points: Points, triangles: Indices, parts: str) -> tuple[Indices, int]:
    """The triangles of the parts that are asked for, and how many parts there are."""
    part = components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    count = len(np.unique(part))
    if count > 1 and parts == "one":
        raise Mendable(f"it has {count} parts that share no point: parts='largest' fills the largest, parts='all' fills all")
    if parts == "largest":
        triangles = triangles[part == np.argmax(np.bincount(part, areas(points, triangles)))]
    return triangles, count


def closed(points: Points, triangles: Indices, largest_hole: float, surface_count: int) -> tuple[Points, Indices, int]:
    """Points and triangles with caps on the open ends, normals out of the inside of each sheet; and how many open ends there were.
    Triangles from `surface_count` on are caps already."""
    triangles, _, rim = _turned(points, triangles)
    holes = _loops(points, triangles, rim)
    for hole in holes:
        middle = points[hole].mean(axis=0)
        width = 2 * np.linalg.norm(points[hole] - middle, axis=1).max()
        if width > largest_hole:
            raise Refused(f"its open end at {at(middle)} is {width:g} wide, and largest_hole is {largest_hole:g}")
    try:
        return *_outward(*_capped(points, triangles, holes), surface_count), len(holes)
    except Refused:
        try:  # a fan can cross the surface where a cap of MeshFix does not
            return *_outward(*meshfix.capped(points, triangles), surface_count), len(holes)
        except Refused:
            pass
        raise


def _outward(points: Points, triangles: Indices, surface_count: int) -> tuple[Points, Indices]:
    """The closed surface, checked, with normals out of the inside of each sheet. Triangles from `surface_count` on are caps."""
    triangles, sheet, rim = _turned(points, triangles)
    if len(rim) > 0:
        raise Mendable(f"its open end at {at(points[rim].mean(axis=(0, 1)))} can't be closed")
    volumes, extents = np.bincount(sheet, inside_volumes(points, triangles)), np.bincount(sheet, areas(points, triangles))
    flat = np.flatnonzero((extents > 0) & (np.abs(volumes) <= FLAT * extents**1.5))
    if len(flat) > 0:
        raise Mendable(f"it is flat near {at(points[triangles[flat[0]]].mean(axis=0))}: it encloses no volume")
    meshfix.check_crossings(points, triangles, surface_count)
    return points, np.where((volumes[sheet] < 0)[:, np.newaxis], triangles[:, ::-1], triangles)


def _turned(points: Points, triangles: Indices) -> tuple[Indices, Indices, Indices]:
    """The triangles, neighbours turned alike; the sheet of each, which is what edges of two triangles connect; and the edges (k, 2) of one
    triangle, as it runs along them."""
    count = len(triangles)
    starts, ends = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    key = np.minimum(starts, ends) * len(points) + np.maximum(starts, ends)
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.concatenate([[True], np.diff(key[order]) != 0]))
    uses = np.diff(np.append(first, len(key)))
    crowded = order[first[uses > 2]]
    if len(crowded) > 0:
        which = "1 edge has" if len(crowded) == 1 else f"{len(crowded)} edges have"
        start, end = points[starts[crowded[0]]], points[ends[crowded[0]]]
        raise Mendable(f"{which} more than two triangles, the first from {at(start)} to {at(end)}: it has no inside")
    shared, rim = first[uses == 2], order[first[uses == 1]]
    a, b = order[shared], order[shared + 1]
    # Each triangle is two nodes, for its two sides. Neighbours that run along their edge the same way have unlike sides.
    side = np.where(starts[a] == starts[b], count, 0)
    front, back = b // 3 + side, b // 3 + count - side
    label = components(2 * count, np.concatenate([a // 3, a // 3 + count]), np.concatenate([front, back]))
    one_sided = np.flatnonzero(label[:count] == label[count:])
    if len(one_sided) > 0:
        place = points[triangles[one_sided[0]]].mean(axis=0)
        raise Mendable(f"it has only one side, as a Moebius strip has, near {at(place)}: it has no inside")
    is_turned = label[:count] > label[count:]
    rims = np.stack([starts[rim], ends[rim]], axis=1)
    rims[is_turned[rim // 3]] = rims[is_turned[rim // 3], ::-1]
    turned = np.where(is_turned[:, np.newaxis], triangles[:, ::-1], triangles)
    return turned, np.minimum(label[:count], label[count:]), rims


def _loops(points: Points, triangles: Indices, rim: Indices) -> list[Indices]:
    """The points round each open end, in the order of the edges. Loops that meet in a point are cut there, so none has a point twice."""
    normals = np.zeros_like(points)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    np.add.at(normals, triangles, np.cross(b - a, c - a)[:, np.newaxis])

    def turn(start: int, middle: int, end: int) -> float:
        """The angle from `start` to `end` at a point, counterclockwise seen from outside: an open end is on this side of its edges."""
        u, v = points[start] - points[middle], points[end] - points[middle]
        normal = normals[middle] / (np.linalg.norm(normals[middle]) or 1)
        return math.atan2(np.cross(u, v) @ normal, u @ v - (u @ normal) * (v @ normal)) % (2 * math.pi)

    following: dict[int, list[int]] = {}
    for start, end in rim.tolist():
        following.setdefault(start, []).append(end)
    loops = []
    while following:
        path = [next(iter(following))]
        place = {path[0]: 0}
        while path[-1] in following:  # as many edges lead to a point as lead away, so a walk ends where it began
            ends = following[path[-1]]
            end = min(ends, key=lambda end: turn(path[-2], path[-1], end)) if len(ends) > 1 and len(path) > 1 else ends[0]
            ends.remove(end)
            if not ends:
                del following[path[-1]]
            if end in place:
                loops.append(np.array(path[place[end] :]))
                for point in path[place[end] :]:
                    del place[point]
                del path[-len(loops[-1]) :]
            place[end] = len(path)
            path.append(end)
    return loops


def _capped(points: Points, triangles: Indices, holes: list[Indices]) -> tuple[Points, Indices]:
    """With caps behind the triangles: one triangle, or a fan round the middle where none of its triangles fold over others, seen along the
    axis of the hole; else what MeshFix makes."""
    added: list[Points] = []
    caps: list[Indices] = []
    for hole in holes:
        after = np.roll(hole, -1)
        middle = points[hole].mean(axis=0)
        normals = np.cross(points[after] - middle, points[hole] - middle)
        heights = normals @ normals.sum(axis=0)
        if len(hole) == 3:
            caps.append(hole[np.newaxis, ::-1])
        elif heights.min() > 1e-6 * heights.max():
            caps.append(np.stack([after, hole, np.full(len(hole), len(points) + len(added))], axis=1))
            added.append(middle)
    points, triangles = np.vstack([points, *added]), np.concatenate([triangles, *caps])
    return (points, triangles) if len(caps) == len(holes) else meshfix.capped(points, triangles)
