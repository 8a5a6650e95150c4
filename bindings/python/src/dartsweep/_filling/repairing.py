"""The repair of a surface that can't be filled: points that nearly touch become one, then MeshFix works on it."""

from __future__ import annotations

import math

import numpy as np

from . import closing, meshfix
from .arrays import Indices, Mendable, Points, Refused, areas, at, components, numbers, used
from .closing import Closed

NEAR = 1e-6  # of the extent: a repair makes points one that lie nearer; MeshFix rounds coordinates to 6 digits


def repaired(points: Points, triangles: Indices, parts: str, largest_hole: float, reason: Refused) -> tuple[Closed, tuple[str, ...]]:
    """The surface, closed, after points that nearly touch have become one, and if that is not enough after MeshFix; and what has changed."""
    label, count = _welded(points), len(points)
    notes = [f"the surface could not be filled: {reason}"]
    merged = label[triangles]
    merged = merged[(merged != np.roll(merged, 1, axis=1)).all(axis=1)]
    if len(np.unique(label)) < count and len(merged):
        notes.append(f"{count - len(np.unique(label))} of {count} points lay nearer than {NEAR:g} of the extent to others and have become one with them")
        points, triangles = used(points, merged)
        try:
            return closing.surface(points, triangles, parts, largest_hole), tuple(notes)
        except Mendable:
            pass
    triangles, part_count = closing.chosen(points, triangles, parts)
    points, kept, made = _by_meshfix(points, triangles)
    gone = len(triangles) - len(kept)
    if areas(points, kept).sum() < 0.5 * areas(points, triangles).sum():
        raise Refused(f"{reason}; MeshFix would take away {gone} of {len(triangles)} triangles")
    if gone:
        number = numbers(np.concatenate([triangles, kept]), len(points))
        places = meshfix.places(points, triangles[~np.isin(number[: len(triangles)], number[len(triangles) :])])
        notes.append(f"MeshFix has taken away {gone} of {len(triangles)} triangles, {places}")
    if len(made):
        _check_widths(points, made, largest_hole)
        notes.append(f"MeshFix has put in {len(made)} triangle{'s' * (len(made) > 1)}, {meshfix.places(points, made)}")
    try:
        points, every = used(points, np.concatenate([kept, made]))
        points, wall, hole_count = closing.closed(points, every, largest_hole, len(kept))
    except Mendable as still:
        raise Refused(f"{reason}; after MeshFix {str(still).removeprefix('its ').removeprefix('it ')}") from still
    return (points, wall, len(kept), hole_count, part_count), tuple(notes)


def _by_meshfix(points: Points, triangles: Indices) -> tuple[Points, Indices, Indices]:
    """Points, those of the triangles that MeshFix leaves, and those that it makes. Each part is repaired by itself, because MeshFix keeps the
    largest part alone."""
    part = components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    unit = 2.0 ** np.floor(np.log2(np.ptp(points, axis=0).max())) / 1024  # MeshFix rounds to 6 digits behind the point, whatever the unit
    kept, made = [np.empty((0, 3), np.int64)], [np.empty((0, 3), np.int64)]
    for each in np.unique(part):
        mine = triangles[part == each]
        tool = meshfix.tool_of((points - middle) / unit, mine)
        tool.fill_small_boundaries(0, True)
        tool.clean(10, 3)
        its_points, its_triangles = tool.return_arrays()
        every = np.concatenate([points, its_points * unit + middle])
        its = _welded(every)[len(points) :][its_triangles]
        its = its[(its != np.roll(its, 1, axis=1)).all(axis=1)]
        number = numbers(np.concatenate([mine, its]), len(every))
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
    boxes: dict[tuple[int, ...], list[int]] = {}
    places = points.tolist()
    for i, (x, y, z) in enumerate(np.floor(points / near).astype(np.int64).tolist() if near > 0 else ()):
        beside = (j for a in (x - 1, x, x + 1) for b in (y - 1, y, y + 1) for c in (z - 1, z, z + 1) for j in boxes.get((a, b, c), ()))
        label[i] = next((j for j in beside if math.dist(places[i], places[j]) < near), i)
        if label[i] == i:
            boxes.setdefault((x, y, z), []).append(i)
    return label


def _check_widths(points: Points, triangles: Indices, largest_hole: float) -> None:
    label = components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    for each in np.unique(label) if largest_hole < math.inf else ():
        corners = points[triangles[label == each]].reshape(-1, 3)
        middle = corners.mean(axis=0)
        width = 2 * np.linalg.norm(corners - middle, axis=1).max()
        if width > largest_hole:
            raise Refused(f"MeshFix would close {width:g} of it at {at(middle)}, and largest_hole is {largest_hole:g}")
