"""Several blocks, zones or parts as one mesh: they share the points that have one id, or lie at one place."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import linear
from .linear import Cells
from .mesh import Indices
from .ragged import offsets_of
from .raw import Raw


def joined(parts: list[tuple[str, Raw]]) -> Raw:
    """One mesh of named blocks, each a group. Blocks of the highest dimension are regions, from 1 on, if there are several."""
    raws = [raw for _, raw in parts]
    points, index = _shared_points(raws)
    cells = linear.joined([renumbered(raw.cells, index[i]) for i, raw in enumerate(raws)])
    starts = offsets_of([len(raw.cells.types) for raw in raws])
    place, kept = once(cells)
    made = Raw(points, cells if kept is None else cells.some(kept), source=raws[0].source, reader=raws[0].reader)
    highest = [int(linear.DIMENSION[raw.cells.types].max(initial=0)) for raw in raws]
    made.data = _joined_data(raws, highest, starts)
    if kept is not None:
        made.data = {name: values[kept] for name, values in made.data.items()}
    volumes = [i for i, dimension in enumerate(highest) if dimension == max(highest)]
    if len(volumes) > 1 and kept is None:
        names = {name: label for label, name in enumerate(dict.fromkeys(parts[i][0] for i in volumes), 1)}
        made.region_names = names
        made.regions = np.concatenate([np.full(len(raw.cells.types), names.get(name, 0)) for name, raw in parts])
    for i, (name, raw) in enumerate(parts):
        own = place[starts[i] : starts[i + 1]]
        made.groups[name] = np.concatenate([made.groups[name], own]) if name in made.groups else own
        for inner, members in raw.groups.items():
            made.groups[inner] = np.concatenate([made.groups.get(inner, np.empty(0, np.int64)), own[members]])
        made.sides += [(side, offsets, index[i][corners]) for side, offsets, corners in raw.sides]
        made.numbers.update(raw.numbers)
        made.notes += [note for note in raw.notes if note not in made.notes]
        made.fields.update(raw.fields)
    return made


def once(cells: Cells) -> tuple[Indices, Indices | None]:
    """Where each cell is once volumes that several blocks have, such as zones, are kept once; and which are kept, None if all are."""
    count = len(cells.types)
    if np.any(cells.offsets[1:] == cells.offsets[:-1]):  # a cell without points: what is to be read can't be told
        return np.arange(count), None
    mixed = (cells.flat.astype(np.uint64) + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    key = np.add.reduceat((mixed ^ (mixed >> np.uint64(29))) * np.uint64(0xBF58476D1CE4E5B9), cells.offsets[:-1])
    volumes = np.flatnonzero(linear.DIMENSION[cells.types] == 3)
    order = volumes[np.argsort(key[volumes], kind="stable")]
    first = np.arange(count)
    for i in np.flatnonzero(key[order][1:] == key[order][:-1]) + 1:  # keys may be equal by chance
        a, b = int(first[order[i - 1]]), int(order[i])
        own, other = (np.sort(cells.flat[cells.offsets[cell] : cells.offsets[cell + 1]]) for cell in (a, b))
        if cells.types[a] == cells.types[b] and np.array_equal(own, other):
            first[b] = a
    if not np.any(first != np.arange(count)):
        return first, None
    kept = np.flatnonzero(first == np.arange(count))
    place = np.full(count, -1, np.int64)
    place[kept] = np.arange(len(kept))
    return place[first], kept


def renumbered(cells: Cells, index: Indices) -> Cells:
    """The cells with index[i] in place of point i, also in face streams."""
    streams = np.flatnonzero(cells.types == 42)
    if len(streams) == 0:
        return Cells(cells.types, cells.offsets, index[cells.flat])
    from .polyhedra import faces_of_cells
    from .ragged import positions

    _, places, sizes = faces_of_cells(cells.some(streams), "a block")
    some = cells.some(streams)
    counts = some.flat[some.offsets[:-1]]
    shift = np.repeat(cells.offsets[streams] - some.offsets[:-1], counts)
    is_point = np.ones(len(cells.flat), np.bool_)
    is_point[positions(cells.offsets[streams], np.diff(some.offsets))] = False
    is_point[positions(places + shift, sizes)] = True
    flat = cells.flat.copy()
    flat[is_point] = index[flat[is_point]]
    return Cells(cells.types, cells.offsets, flat)


def _shared_points(raws: list[Raw]) -> tuple[NDArray[np.float64], list[Indices]]:
    """All points, and for each block the new index of each of its points."""
    sizes = [len(raw.points) for raw in raws]
    points = np.concatenate([np.asarray(raw.points, np.float64) for raw in raws])
    if all(raw.point_ids is not None for raw in raws):
        _, first, new = np.unique(np.concatenate([raw.point_ids for raw in raws]), return_index=True, return_inverse=True)
    else:
        first, new = _by_place(points, np.repeat(np.arange(len(raws)), sizes))
    return points[first], np.split(np.ravel(new), np.cumsum(sizes)[:-1])


def _by_place(points: NDArray[np.float64], block: NDArray[Any]) -> tuple[Indices, Indices]:
    """Points of different blocks at one place become one. Where a block has two there, such as the lips of a crack, none do."""
    place = np.ravel(np.unique(points + 0.0, axis=0, return_inverse=True)[1])  # + 0.0: -0.0 is the same place
    pairs, counts = np.unique(np.stack([block, place]), axis=1, return_counts=True)
    is_double = np.zeros(int(place.max(initial=-1)) + 1, np.bool_)
    is_double[pairs[1][counts > 1]] = True
    key = np.where(is_double[place], len(place) + np.arange(len(place)), place)
    _, first, new = np.unique(key, return_index=True, return_inverse=True)
    order = np.argsort(np.argsort(first))  # in the order of the file
    return np.sort(first), order[np.ravel(new)]


def _joined_data(raws: list[Raw], highest: list[int], starts: Indices) -> dict[str, NDArray[Any]]:
    """Arrays that all blocks of the highest dimension have; other blocks have 0 there."""
    volumes = [raw for raw, dimension in zip(raws, highest) if dimension == max(highest)]
    made = {}
    for name, first in volumes[0].data.items():
        if all(name in raw.data and raw.data[name].shape[1:] == first.shape[1:] for raw in volumes):
            values = np.zeros((int(starts[-1]), *first.shape[1:]), np.result_type(*(raw.data[name] for raw in volumes)))
            for i, raw in enumerate(raws):
                if name in raw.data and raw.data[name].shape[1:] == first.shape[1:]:
                    values[starts[i] : starts[i + 1]] = raw.data[name]
            made[name] = values
    return made
