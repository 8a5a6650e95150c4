"""Quadratic cells divided into linear ones: nodes of sides become corners, so the cells follow a curved boundary."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from .mesh import Indices

if TYPE_CHECKING:
    from .linear import Made

_TETRA, _HEXAHEDRON, _WEDGE, _PYRAMID = 10, 12, 13, 14
_CORNER_TETRAS = [(0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3)]
_INNER_TETRAS = [  # for each diagonal of the octahedron that is left
    [(4, 9, 5, 6), (4, 9, 6, 7), (4, 9, 7, 8), (4, 9, 8, 5)],
    [(5, 7, 4, 8), (5, 7, 8, 9), (5, 7, 9, 6), (5, 7, 6, 4)],
    [(6, 8, 7, 4), (6, 8, 9, 7), (6, 8, 5, 9), (6, 8, 4, 5)],
]
_TRIANGLES = [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)]
_QUADS = [(0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)]
_WEDGE_LAYERS = [(0, 1, 2, 6, 7, 8), (12, 13, 14, 15, 16, 17), (3, 4, 5, 9, 10, 11)]
_PYRAMIDS = [(0, 5, 13, 8, 9), (5, 1, 6, 13, 10), (13, 6, 2, 7, 11), (8, 13, 7, 3, 12), (9, 10, 11, 12, 4), (9, 12, 11, 10, 13)]
_PYRAMID_TETRAS = [(5, 9, 10, 13), (6, 10, 11, 13), (7, 11, 12, 13), (8, 12, 9, 13)]
_HEX_NODES = {  # nodes of 27 by their place in a grid of 3 x 3 x 3
    **dict(zip([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)], range(8))),
    **dict(zip([(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2)], range(8, 16))),
    **dict(zip([(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)], range(16, 20))),
    **dict(zip([(0, 1, 1), (2, 1, 1), (1, 0, 1), (1, 2, 1), (1, 1, 0), (1, 1, 2), (1, 1, 1)], range(20, 27))),
}
_HEXAHEDRA = [
    tuple(
        _HEX_NODES[i + a, j + b, k + c]
        for a, b, c in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    )
    for k, j, i in itertools.product((0, 1), repeat=3)
]
_WEDGES = [tuple(low[i] for i in t) + tuple(high[i] for i in t) for low, high in zip(_WEDGE_LAYERS, _WEDGE_LAYERS[1:]) for t in _TRIANGLES]
_FLAT_WEDGES = [tuple((0, 1, 2, 6, 7, 8)[i] for i in t) + tuple((3, 4, 5, 9, 10, 11)[i] for i in t) for t in _TRIANGLES]

_HEX_FACES = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (2, 3, 7, 6), (0, 1, 2, 3), (4, 5, 6, 7)]
_HEX_SIDES = [(16, 15, 19, 11), (9, 18, 13, 17), (8, 17, 12, 16), (10, 19, 14, 18), (8, 9, 10, 11), (12, 13, 14, 15)]
_WEDGE_FACES, _WEDGE_SIDES = [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)], [(6, 13, 9, 12), (7, 14, 10, 13), (8, 12, 11, 14)]

# For each of VTK's types: nodes that are used, the faces whose middles are made with the nodes of their sides, and the cells.
_Children = list[tuple[int, Any]]
_SPLITS: dict[int, tuple[int, list[Any], list[Any], _Children]] = {
    21: (3, [], [], [(3, [(0, 2), (2, 1)])]),
    22: (6, [], [], [(5, _TRIANGLES)]),
    23: (8, [(0, 1, 2, 3)], [(4, 5, 6, 7)], [(9, _QUADS)]),
    28: (9, [], [], [(9, _QUADS)]),
    30: (6, [], [], [(9, [(0, 4, 5, 3), (4, 1, 2, 5)])]),
    25: (20, _HEX_FACES, _HEX_SIDES, [(_HEXAHEDRON, _HEXAHEDRA)]),
    29: (27, [], [], [(_HEXAHEDRON, _HEXAHEDRA)]),
    26: (15, _WEDGE_FACES, _WEDGE_SIDES, [(_WEDGE, _WEDGES)]),
    32: (18, [], [], [(_WEDGE, _WEDGES)]),
    31: (12, [], [], [(_WEDGE, _FLAT_WEDGES)]),
    27: (13, [(0, 1, 2, 3)], [(5, 6, 7, 8)], [(_PYRAMID, _PYRAMIDS), (_TETRA, _PYRAMID_TETRAS)]),
    37: (14, [], [], [(_PYRAMID, _PYRAMIDS), (_TETRA, _PYRAMID_TETRAS)]),
}
_SAME = {34: 22, 69: 22, 70: 28, 71: 24, 68: 21}  # types whose nodes begin with those of another
_EDGES = {  # between which corners the first nodes after the corners lie
    **{kind: [(0, 1)] for kind in (21,)},
    **{kind: [(0, 1), (1, 2), (2, 0)] for kind in (22, 34)},
    **{kind: [(0, 1), (1, 2), (2, 3), (3, 0)] for kind in (23, 28)},
    **{kind: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)] for kind in (24,)},
    **{kind: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)] for kind in (25, 29, 33)},
    **{kind: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)] for kind in (26, 32)},
    **{kind: [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)] for kind in (27, 37)},
}


def sides_upwards_first(*middles: int) -> dict[int, list[int]]:
    """VTK's order of nodes in formats where nodes of sides upwards come before those of upper sides, by VTK's types. VTK has them behind.
    middles: where the middles of faces and of the cell stand among 27 nodes of a hexahedron."""
    hexahedron, wedge = [*range(12), 16, 17, 18, 19, 12, 13, 14, 15], [*range(9), 12, 13, 14, 9, 10, 11]
    return {25: hexahedron, 26: wedge, 29: [*hexahedron, *middles], 32: [*wedge, 15, 16, 17]}


_Found = list[tuple[int, Indices, Indices]]


def split(made: Made, kind: int, rows: Indices) -> _Found:
    """Linear cells of rows of nodes: for each linear type its rows, and of which row each is made. Adds the middles of faces and cells
    that have no node to the points."""
    kind = _SAME.get(kind, kind)
    _check(made, rows)
    if kind == 24 and rows.shape[1] == 10:
        return _split_tetra(made, rows)
    if kind == 33:
        rows, kind = _full_hexahedra(made, rows), 29
    used, faces, sides, children = _SPLITS.get(kind, (0, [], [], []))
    if not children or rows.shape[1] < used or kind in (21, 22, 28) and rows.shape[1] != used + (rows.shape[1] == 7):
        raise MeshError(made.source, f"cells of type {kind} of VTK with {rows.shape[1]} nodes are not divided", 'take quadratic="corners"')
    rows = np.concatenate([rows[:, :used], *(_middles(made, rows, face, side) for face, side in zip(faces, sides))], axis=1)
    if kind == 25:
        rows = np.concatenate([rows, _centres(made, rows)], axis=1)
    return [
        (linear, rows[:, np.array(nodes)].reshape(-1, len(nodes[0])), np.repeat(np.arange(len(rows)), len(nodes)))
        for linear, nodes in children
    ]


def measure_corners(made: Made, kind: int, rows: Indices) -> None:
    """Cells that are taken by their corners: how many there are, and how far the nodes of sides lie from the straight sides."""
    _check(made, rows)
    made.cornered += len(rows)
    edges = _EDGES.get(_SAME.get(kind, kind))
    if edges is not None and rows.shape[1] >= max(max(edge) for edge in edges) + 1 + len(edges):
        first = max(max(edge) for edge in edges) + 1
        ends = np.array(edges)
        middle = 0.5 * (made.points[rows[:, ends[:, 0]]] + made.points[rows[:, ends[:, 1]]])
        away = float(np.abs(made.points[rows[:, first : first + len(edges)]] - middle).max(initial=0.0))
        made.farthest = away if made.farthest is None else max(made.farthest, away)


def note_corners(made: Made) -> None:
    if made.cornered:
        away = "" if made.farthest is None else f", which lie up to {made.farthest:.3g} from the middles of straight sides"
        made.notes.append(f'{made.cornered} cells of higher order were taken by their corners; quadratic="split" keeps their nodes{away}')


def _check(made: Made, rows: Indices) -> None:
    if int(rows.max(initial=0)) >= len(made.points):
        raise MeshError(made.source, f"a cell names point {rows.max()} of {len(made.points)}", "the file is damaged")


def _split_tetra(made: Made, rows: Indices) -> _Found:
    """Four tetrahedra at the corners, and four round the diagonal of the rest with which the least of these is largest. All parts of a cell
    that is inside out are so, too."""
    sign = np.where(_volumes(made.points[rows[:, :4]]) < 0, -1.0, 1.0)
    least = [np.min([sign * _volumes(made.points[rows[:, tetra]]) for tetra in choice], axis=0) for choice in _INNER_TETRAS]
    best = np.argmax(least, axis=0)
    inner = rows[np.arange(len(rows))[:, None, None], np.array(_INNER_TETRAS)[best]]
    children = np.concatenate([rows[:, np.array(_CORNER_TETRAS)], inner], axis=1)
    return [(_TETRA, children.reshape(-1, 4), np.repeat(np.arange(len(rows)), 8))]


def _volumes(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    a, b, c = (corners[:, i] - corners[:, 0] for i in (1, 2, 3))
    made: NDArray[np.float64] = np.einsum("ij,ij->i", np.cross(a, b), c)
    return made


def _full_hexahedra(made: Made, rows: Indices) -> Indices:
    """27 nodes of 24: VTK's biquadratic hexahedra have the middles of four faces, in another order."""
    return np.concatenate([rows[:, :20], rows[:, [23, 21, 20, 22]], *(
        _middles(made, rows, face, side) for face, side in zip(_HEX_FACES[4:], _HEX_SIDES[4:])), _centres(made, rows)], axis=1)


def _middles(made: Made, rows: Indices, face: tuple[int, ...], side: tuple[int, ...]) -> Indices:
    """Points in the middle of a quadratic face of each cell, one for both cells of a face."""
    corners, nodes = rows[:, face], rows[:, side]
    keys, first, inverse = np.unique(np.sort(nodes, axis=1), axis=0, return_index=True, return_inverse=True)
    known = made.middles
    new = [i for i, key in enumerate(map(tuple, keys.tolist())) if key not in known]
    places = 0.5 * made.points[nodes[first[new]]].sum(axis=1) - 0.25 * made.points[corners[first[new]]].sum(axis=1)
    count = len(made.points)
    made.points = np.concatenate([made.points, places])
    known.update({tuple(keys[i].tolist()): count + j for j, i in enumerate(new)})
    ids = np.array([known[tuple(key)] for key in keys.tolist()], np.int64)
    return ids[np.ravel(inverse)][:, None]


def _centres(made: Made, rows: Indices) -> Indices:
    """Points in the middle of hexahedra with 20 nodes."""
    places = 0.25 * (made.points[rows[:, 8:20]].sum(axis=1) - made.points[rows[:, :8]].sum(axis=1))
    made.points = np.concatenate([made.points, places])
    return np.arange(len(made.points) - len(rows), len(made.points))[:, None]
