"""The work of surfaces.py, a program of its own: it reads a pickle of the arguments of `_work` from its standard input and writes one of what
that gives, or of the text that tells why the surface can't be filled.

MeshFix makes caps and finds triangles that cross. TetGen fills the lumen, then the tissue; both keep the triangles between them.
"""

from __future__ import annotations

import math
import os
import pickle
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Indices = NDArray[np.int64]
Closed = tuple[Points, Indices, int, int, int]

LUMEN, TISSUE = 1, 2  # as in surfaces.py
SIZE = 0.8  # of edges by default, over the lumen's width: a few cells lie side by side across it
PLACES = 5  # that messages name at most
NEAR = 1e-6  # of the extent: a repair makes points one that lie nearer; MeshFix rounds coordinates to 6 digits
FLAT = 1e-9  # volume over the power 3/2 of the area; TetGen takes what is flatter for a sheet


class Refused(Exception):
    """The surface can't be filled; the text says why."""


class Mendable(Refused):
    """A repair may help."""


def _answer() -> None:
    with os.fdopen(os.dup(1), "wb") as out:
        os.dup2(2, 1)  # what others print does not go to the answer
        try:
            answer: Any = _work(*pickle.load(sys.stdin.buffer))
        except Refused as reason:
            answer = str(reason)
        pickle.dump(answer, out)


def _work(
    points: Points,
    triangles: NDArray[Any],
    scale: float,
    parts: str,
    largest_hole: float,
    outside: str,
    size: float | None,
    thickness: float | None,
    repair: bool = False,
) -> tuple[Any, ...]:
    """The members of FilledSurface."""
    points, triangles = _merged(points * scale, triangles)
    notes: tuple[str, ...] = ()
    try:
        points, wall, count, hole_count, part_count = _surface(points, triangles, parts, largest_hole)
    except Mendable as reason:
        if not repair:
            raise Refused(f"{reason}; repair=True may mend it") from reason
        (points, wall, count, hole_count, part_count), notes = _repaired(points, triangles, parts, largest_hole, reason)
    is_cap = np.arange(len(wall)) >= count
    return *_filled(points, wall, outside, size, thickness), is_cap, hole_count, part_count, notes


def _surface(points: Points, triangles: Indices, parts: str, largest_hole: float) -> Closed:
    """The parts that are asked for, closed: points, triangles, how many of them are no caps, and how many open ends and parts there were."""
    triangles, part_count = _chosen(points, triangles, parts)
    points, triangles = _used(points, triangles)
    points, wall, hole_count = _closed(points, triangles, largest_hole, len(triangles))
    return points, wall, len(triangles), hole_count, part_count


def _at(place: Points) -> str:
    return "({:g}, {:g}, {:g})".format(*place)


# --- what comes in


def _merged(place: Points, rows: NDArray[Any]) -> tuple[Points, Indices]:
    """The arrays, checked: of points at the same place the first, and triangles that have three points."""
    if rows.size == 0:
        raise Refused("it has no triangles")
    if place.ndim != 2 or place.shape[1] != 3:
        raise Refused(f"points have shape (n, 3), not {place.shape}")
    if rows.ndim != 2 or rows.shape[1] != 3 or rows.dtype.kind not in "iu":
        raise Refused(f"triangles are integers of shape (m, 3), not {rows.dtype} of shape {rows.shape}")
    wrong = np.flatnonzero(((rows < 0) | (rows >= len(place))).any(axis=1))
    if len(wrong) > 0:
        raise Refused(f"triangle {wrong[0]} has points {rows[wrong[0]].tolist()}, there are 0 .. {len(place) - 1}")
    wrong = np.flatnonzero(~np.isfinite(place).all(axis=1))
    if len(wrong) > 0:
        raise Refused(f"point {wrong[0]} is not finite: {_at(place[wrong[0]])}")
    place, index = _distinct(place)
    merged = index[rows]
    merged = merged[(merged != np.roll(merged, 1, axis=1)).all(axis=1)]
    if len(merged) == 0:
        raise Refused("it has no triangles with three different points")
    return _used(place, merged)


def _distinct(points: Points) -> tuple[Points, Indices]:
    """Points without repetitions, in the order in which they come first, and for each point its index there."""
    order = np.lexsort(points.T)
    is_new = np.concatenate([[True], (points[order[1:]] != points[order[:-1]]).any(axis=1)])
    first = order[is_new]
    rank = np.argsort(np.argsort(first))
    index = np.empty(len(points), np.int64)
    index[order] = rank[np.cumsum(is_new) - 1]
    return points[np.sort(first)], index


def _used(points: Points, triangles: Indices) -> tuple[Points, Indices]:
    """Without points that no triangle has."""
    used, index = np.unique(triangles, return_inverse=True)
    return points[used], index.reshape(-1, 3)


# --- what the surface is


def _components(count: int, a: Indices, b: Indices) -> Indices:
    """For each of `count` nodes the lowest node that edges (a[i], b[i]) connect with it."""
    label = np.arange(count)
    while True:
        low, high = np.minimum(label[a], label[b]), np.maximum(label[a], label[b])
        if np.array_equal(low, high):
            return label
        np.minimum.at(label, high, low)
        while not np.array_equal(label, label[label]):
            label = label[label]


def _chosen(points: Points, triangles: Indices, parts: str) -> tuple[Indices, int]:
    """The triangles of the parts that are asked for, and how many parts there are."""
    part = _components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    count = len(np.unique(part))
    if count > 1 and parts == "one":
        raise Mendable(f"it has {count} parts that share no point: parts='largest' fills the largest, parts='all' fills all")
    if parts == "largest":
        triangles = triangles[part == np.argmax(np.bincount(part, _areas(points, triangles)))]
    return triangles, count


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
        raise Mendable(f"{which} more than two triangles, the first from {_at(start)} to {_at(end)}: it has no inside")
    shared, rim = first[uses == 2], order[first[uses == 1]]
    a, b = order[shared], order[shared + 1]
    # Each triangle is two nodes, for its two sides. Neighbours that run along their edge the same way have unlike sides.
    side = np.where(starts[a] == starts[b], count, 0)
    front, back = b // 3 + side, b // 3 + count - side
    label = _components(2 * count, np.concatenate([a // 3, a // 3 + count]), np.concatenate([front, back]))
    one_sided = np.flatnonzero(label[:count] == label[count:])
    if len(one_sided) > 0:
        place = points[triangles[one_sided[0]]].mean(axis=0)
        raise Mendable(f"it has only one side, as a Moebius strip has, near {_at(place)}: it has no inside")
    is_turned = label[:count] > label[count:]
    rims = np.stack([starts[rim], ends[rim]], axis=1)
    rims[is_turned[rim // 3]] = rims[is_turned[rim // 3], ::-1]
    turned = np.where(is_turned[:, np.newaxis], triangles[:, ::-1], triangles)
    return turned, np.minimum(label[:count], label[count:]), rims


def _areas(points: Points, triangles: Indices) -> Points:
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)


def _volumes(points: Points, cells: Indices) -> Points:
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    return np.asarray(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6)


def _inside_volumes(points: Points, triangles: Indices) -> Points:
    """What each triangle adds to the volume inside, with normals that point out."""
    middle = points.mean(axis=0)
    cells = np.insert(triangles, 0, len(points), axis=1)
    return _volumes(np.vstack([points, middle]), cells)


# --- closed


def _closed(points: Points, triangles: Indices, largest_hole: float, surface_count: int) -> tuple[Points, Indices, int]:
    """Points and triangles with caps on the open ends, normals out of the inside of each sheet; and how many open ends there were.
    Triangles from `surface_count` on are caps already."""
    triangles, _, rim = _turned(points, triangles)
    holes = _loops(points, triangles, rim)
    for hole in holes:
        middle = points[hole].mean(axis=0)
        width = 2 * np.linalg.norm(points[hole] - middle, axis=1).max()
        if width > largest_hole:
            raise Refused(f"its open end at {_at(middle)} is {width:g} wide, and largest_hole is {largest_hole:g}")
    try:
        return *_outward(*_capped(points, triangles, holes), surface_count), len(holes)
    except Refused:
        try:  # a fan can cross the surface where a cap of MeshFix does not
            return *_outward(*_capped_by_meshfix(points, triangles), surface_count), len(holes)
        except Refused:
            pass
        raise


def _outward(points: Points, triangles: Indices, surface_count: int) -> tuple[Points, Indices]:
    """The closed surface, checked, with normals out of the inside of each sheet. Triangles from `surface_count` on are caps."""
    triangles, sheet, rim = _turned(points, triangles)
    if len(rim) > 0:
        raise Mendable(f"its open end at {_at(points[rim].mean(axis=(0, 1)))} can't be closed")
    volumes, areas = np.bincount(sheet, _inside_volumes(points, triangles)), np.bincount(sheet, _areas(points, triangles))
    flat = np.flatnonzero((areas > 0) & (np.abs(volumes) <= FLAT * areas**1.5))
    if len(flat) > 0:
        raise Mendable(f"it is flat near {_at(points[triangles[flat[0]]].mean(axis=0))}: it encloses no volume")
    _check_crossings(points, triangles, surface_count)
    return points, np.where((volumes[sheet] < 0)[:, np.newaxis], triangles[:, ::-1], triangles)


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
    return (points, triangles) if len(caps) == len(holes) else _capped_by_meshfix(points, triangles)


def _capped_by_meshfix(points: Points, triangles: Indices) -> tuple[Points, Indices]:
    tool = _meshfix(points, triangles)
    tool.fill_small_boundaries(0, True)
    points, made = _of_meshfix(points, tool)
    number = _numbers(np.concatenate([triangles, made]), len(points))
    return points, np.concatenate([triangles, made[~np.isin(number[len(triangles) :], number[: len(triangles)])]])


def _meshfix(points: Points, triangles: Indices) -> Any:
    import pymeshfix

    tool = pymeshfix.PyTMesh()
    tool.set_quiet(True)
    tool.load_array(points, np.ascontiguousarray(triangles, np.int32))
    return tool


def _of_meshfix(points: Points, tool: Any) -> tuple[Points, Indices]:
    """The points with those that MeshFix has added behind them, and its triangles by indices there. MeshFix has its own order."""
    its_points, its_triangles = tool.return_arrays()
    every, index = _distinct(np.concatenate([points, its_points]))
    return every, index[len(points) :][its_triangles]


def _check_crossings(points: Points, triangles: Indices, surface_count: int) -> None:
    tool = _meshfix(points, triangles)
    found = tool.select_intersecting_triangles()
    if len(found) == 0:
        return
    _, its = _of_meshfix(points, tool)
    crossing = its[np.ravel(found)[: len(found)]]  # the array has three columns, but no more numbers than rows
    number = _numbers(np.concatenate([triangles, crossing]), len(points))
    of_caps = np.isin(number[len(triangles) :], number[surface_count : len(triangles)]).sum()
    caps = f", {of_caps} of them in caps of open ends" if of_caps > 0 else ""
    raise Mendable(f"{len(found)} of its triangles cross others{caps}, {_places(points, crossing)}")


def _places(points: Points, triangles: Indices) -> str:
    """The middle of each connected set of triangles; the largest sets first."""
    label = _components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    sets, sizes = np.unique(label, return_counts=True)
    order = np.argsort(-sizes, kind="stable")
    middles = [_at(points[triangles[label == sets[i]]].mean(axis=(0, 1))) for i in order[:PLACES]]
    return f"at {', '.join(middles)}" + (f" and at {len(sets) - PLACES} more places" if len(sets) > PLACES else "")


# --- repaired


def _repaired(points: Points, triangles: Indices, parts: str, largest_hole: float, reason: Refused) -> tuple[Closed, tuple[str, ...]]:
    """The surface, closed, after points that nearly touch have become one, and if that is not enough after MeshFix; and what has changed."""
    label, count = _welded(points), len(points)
    notes = [f"the surface could not be filled: {reason}"]
    merged = label[triangles]
    merged = merged[(merged != np.roll(merged, 1, axis=1)).all(axis=1)]
    if len(np.unique(label)) < count and len(merged):
        notes.append(f"{count - len(np.unique(label))} of {count} points lay nearer than {NEAR:g} of the extent to others and have become one with them")
        points, triangles = _used(points, merged)
        try:
            return _surface(points, triangles, parts, largest_hole), tuple(notes)
        except Mendable:
            pass
    triangles, part_count = _chosen(points, triangles, parts)
    points, kept, made = _by_meshfix(points, triangles)
    gone = len(triangles) - len(kept)
    if _areas(points, kept).sum() < 0.5 * _areas(points, triangles).sum():
        raise Refused(f"{reason}; MeshFix would take away {gone} of {len(triangles)} triangles")
    if gone:
        number = _numbers(np.concatenate([triangles, kept]), len(points))
        places = _places(points, triangles[~np.isin(number[: len(triangles)], number[len(triangles) :])])
        notes.append(f"MeshFix has taken away {gone} of {len(triangles)} triangles, {places}")
    if len(made):
        _check_widths(points, made, largest_hole)
        notes.append(f"MeshFix has put in {len(made)} triangle{'s' * (len(made) > 1)}, {_places(points, made)}")
    try:
        points, every = _used(points, np.concatenate([kept, made]))
        points, wall, hole_count = _closed(points, every, largest_hole, len(kept))
    except Mendable as still:
        raise Refused(f"{reason}; after MeshFix {str(still).removeprefix('its ').removeprefix('it ')}") from still
    return (points, wall, len(kept), hole_count, part_count), tuple(notes)


def _by_meshfix(points: Points, triangles: Indices) -> tuple[Points, Indices, Indices]:
    """Points, those of the triangles that MeshFix leaves, and those that it makes. Each part is repaired by itself, because MeshFix keeps the
    largest part alone."""
    part = _components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    unit = 2.0 ** np.floor(np.log2(np.ptp(points, axis=0).max())) / 1024  # MeshFix rounds to 6 digits behind the point, whatever the unit
    kept, made = [np.empty((0, 3), np.int64)], [np.empty((0, 3), np.int64)]
    for each in np.unique(part):
        mine = triangles[part == each]
        tool = _meshfix((points - middle) / unit, mine)
        tool.fill_small_boundaries(0, True)
        tool.clean(10, 3)
        its_points, its_triangles = tool.return_arrays()
        every = np.concatenate([points, its_points * unit + middle])
        its = _welded(every)[len(points) :][its_triangles]
        its = its[(its != np.roll(its, 1, axis=1)).all(axis=1)]
        number = _numbers(np.concatenate([mine, its]), len(every))
        kept.append(mine[np.isin(number[: len(mine)], number[len(mine) :])])
        made.append(its[~np.isin(number[len(mine) :], number[: len(mine)])])
        points = every
    left, new = np.concatenate(kept), np.concatenate(made)
    if len(left) + len(new) == 0:
        raise Refused("MeshFix leaves nothing of it")
    return points, left, new


def _welded(points: Points) -> Indices:
    """For each point the first one that lies nearer than NEAR of the extent; that may be itself."""
    near = NEAR * float(np.ptp(points, axis=0).max())
    label = np.arange(len(points))
    at: dict[tuple[int, ...], list[int]] = {}
    places = points.tolist()
    for i, (x, y, z) in enumerate(np.floor(points / near).astype(np.int64).tolist() if near > 0 else ()):
        beside = (j for a in (x - 1, x, x + 1) for b in (y - 1, y, y + 1) for c in (z - 1, z, z + 1) for j in at.get((a, b, c), ()))
        label[i] = next((j for j in beside if math.dist(places[i], places[j]) < near), i)
        if label[i] == i:
            at.setdefault((x, y, z), []).append(i)
    return label


def _check_widths(points: Points, triangles: Indices, largest_hole: float) -> None:
    label = _components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    for each in np.unique(label) if largest_hole < math.inf else ():
        corners = points[triangles[label == each]].reshape(-1, 3)
        middle = corners.mean(axis=0)
        width = 2 * np.linalg.norm(corners - middle, axis=1).max()
        if width > largest_hole:
            raise Refused(f"MeshFix would close {width:g} of it at {_at(middle)}, and largest_hole is {largest_hole:g}")


def _numbers(rows: Indices, point_count: int) -> Indices:
    """A number for each row of three points, the same for rows with the same points."""
    low, middle, high = np.sort(rows, axis=1).T
    _, pair = np.unique(low * point_count + middle, return_inverse=True)
    _, number = np.unique(pair.ravel() * point_count + high, return_inverse=True)
    return np.asarray(number.ravel())


# --- filled


def _filled(
    points: Points, wall: Indices, outside: str, size: float | None, thickness: float | None
) -> tuple[Points, Indices, NDArray[np.int32], Indices]:
    """Points, cells, regions and the wall, out of the lumen."""
    count = len(points)
    width = 4 * _inside_volumes(points, wall).sum() / _areas(points, wall).sum()  # exact for a long tube
    places, cells, parts = _tetrahedra(points, wall, SIZE * width if size is None else size)

    # Behind each triangle of the surface the inside becomes outside, the outside inside.
    beside = np.append(parts, 0)[_sides(cells, wall, count)]
    part_count = parts.max() + 1
    crossings = np.concatenate([beside, beside[:, ::-1]])
    label = _components(2 * part_count, crossings[:, 0], crossings[:, 1] + part_count)
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
    order = np.lexsort((_volumes(places, cells), parts))
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
    number = _numbers(np.concatenate([triangles, faces[candidates]]), point_count)
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


if __name__ == "__main__":
    _answer()
