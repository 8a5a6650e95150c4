"""What MeshFix makes of arrays: caps, and triangles that cross."""

from __future__ import annotations

from typing import Any

import numpy as np

from .arrays import Indices, Mendable, Points, at, components, distinct, numbers

PLACES = 5  # that messages name at most


def tool_of(points: Points, triangles: Indices) -> Any:
    import pymeshfix

    tool = pymeshfix.PyTMesh()
    tool.set_quiet(True)
    tool.load_array(points, np.ascontiguousarray(triangles, np.int32))
    return tool


def arrays_of(points: Points, tool: Any) -> tuple[Points, Indices]:
    """The points with those that MeshFix has added behind them, and its triangles by indices there. MeshFix has its own order."""
    its_points, its_triangles = tool.return_arrays()
    every, index = distinct(np.concatenate([points, its_points]))
    return every, index[len(points) :][its_triangles]


def capped(points: Points, triangles: Indices) -> tuple[Points, Indices]:
    tool = tool_of(points, triangles)
    tool.fill_small_boundaries(0, True)
    points, made = arrays_of(points, tool)
    number = numbers(np.concatenate([triangles, made]), len(points))
    return points, np.concatenate([triangles, made[~np.isin(number[len(triangles) :], number[: len(triangles)])]])


def check_crossings(points: Points, triangles: Indices, surface_count: int) -> None:
    tool = tool_of(points, triangles)
    found = tool.select_intersecting_triangles()
    if len(found) == 0:
        return
    _, its = arrays_of(points, tool)
    crossing = its[np.ravel(found)[: len(found)]]  # the array has three columns, but no more numbers than rows
    number = numbers(np.concatenate([triangles, crossing]), len(points))
    of_caps = np.isin(number[len(triangles) :], number[surface_count : len(triangles)]).sum()
    caps = f", {of_caps} of them in caps of open ends" if of_caps > 0 else ""
    raise Mendable(f"{len(found)} of its triangles cross others{caps}, {places(points, crossing)}")


def places(points: Points, triangles: Indices) -> str:
    """The middle of each connected set of triangles; the largest sets first."""
    label = components(len(points), triangles[:, :2].ravel(), triangles[:, 1:].ravel())[triangles[:, 0]]
    sets, sizes = np.unique(label, return_counts=True)
    order = np.argsort(-sizes, kind="stable")
    middles = [at(points[triangles[label == sets[i]]].mean(axis=(0, 1))) for i in order[:PLACES]]
    return f"at {', '.join(middles)}" + (f" and at {len(sets) - PLACES} more places" if len(sets) > PLACES else "")
