"""Cells whose mean does not see them whole, split when an environment is made."""

from __future__ import annotations

import pickle

import meshio
import numpy as np
import pytest

import dartsweep as ds
from dartsweep._door import meshio_reader, orient, raw

ARROW = np.array([(0, 0), (4, 0), (0.5, 0.5), (0, 4)], float)
"""A quadrilateral whose mean lies outside."""


def test_an_arrow_head_is_split_in_the_plane_and_in_space() -> None:
    with pytest.raises(ds.errors.InvalidCell, match="DSW_ENVIRONMENT_SPLIT"):
        ds.Environment(ARROW, [(0, 1, 2, 3)])
    points = np.concatenate([np.c_[ARROW, np.zeros(4)], np.c_[ARROW, np.ones(4)]])
    places = [(2.5, 0.125), (0.25, 0.25), (0.125, 2.5)]
    for environment, outside in (
        (ds.Environment(ARROW, [(0, 1, 2, 3)], split=True), (1, 1)),
        (ds.Environment(points, [range(8)], split=True), (1, 1, 0.5)),
    ):
        with environment:
            assert environment.info.volume_count == 2
            environment.check()
            for place in places:
                volume, location = environment.locate((*place, *outside[2:]))
                assert location == ds.Location.PASSABLE and environment.parent(volume) == 0
            assert environment.locate(outside)[1] == ds.Location.OUTSIDE
            again = pickle.loads(pickle.dumps(environment))
            assert [again.parent(again.volume_id(i)) for i in range(2)] == [0, 0]


def test_cells_with_repeated_points_are_what_is_left() -> None:
    cube = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
    cells = [(0, 1, 2, 2, 4, 5, 6, 6), (0, 2, 3, 3, 4, 6, 7, 7)]
    with pytest.raises(ds.errors.BadCell):
        ds.Environment(cube, cells)
    with ds.Environment(cube, cells, split=True) as environment:
        assert environment.info.part_count == 1 and environment.info.vertex_count == 8
        assert [environment.volume_counts(environment.volume_id(i)).faces for i in range(2)] == [5, 5]
        environment.check()


def test_what_meets_itself_is_told() -> None:
    with pytest.raises(ds.errors.InvalidCell, match="cell 0 can't be split: its boundary"):
        ds.Environment(ARROW[[0, 1, 3, 2]] + [[0, 0], [0, 0], [0, 0], [3, 3]], [(0, 3, 1, 2)], split=True)


def test_the_door_splits_cells_with_a_note_and_their_surfaces_stay() -> None:
    points = np.concatenate([np.c_[ARROW, np.zeros(4)], np.c_[ARROW, np.ones(4)]])
    sides = [(0, 1, 2, 3), (4, 5, 6, 7), (1, 2, 6, 5)]
    mesh = meshio.Mesh(points, [("hexahedron", [range(8)]), ("quad", sides)], cell_sets={"inlet": [[], [0]], "ends": [[], [0, 1]], "wall": [[], [2]]})
    with pytest.raises(ds.MeshError, match="not seen whole"):
        ds.from_meshio(mesh, split=False)
    with ds.from_meshio(mesh) as environment:
        assert environment.info.volume_count == 2
        assert [environment.parent(environment.volume_id(i)) for i in range(2)] == [0, 0]
        assert environment.notes[0].startswith("1 of 1 cells were split") and len(environment.notes) == 1
        assert [len(environment.faces(name)) for name in ("inlet", "ends", "wall")] == [2, 4, 1]
    folded = meshio.Mesh(ARROW[[0, 1, 3, 2]] + [[0, 0], [0, 0], [0, 0], [3, 3]], [("quad", [(0, 3, 1, 2)])])
    with pytest.raises(ds.MeshError, match="cell 0 can't be split"):
        ds.from_meshio(folded)


def test_faces_between_parts_of_a_cell_are_on_no_surface() -> None:
    """One part of this hexahedron has all four corners of a side."""
    points = np.array([(-3, 6, -6), (1, 3, -4), (7, 12, -2), (-2, 11, -5), (-7, -1, 4), (2, 0, 7), (9, 9, 15), (-1, 2, 3)]) / 8
    sides = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    with ds.from_meshio(meshio.Mesh(points, [("hexahedron", [range(8)]), ("quad", sides)], cell_sets={"skin": [[], range(6)]})) as environment:
        assert environment.info.volume_count > 1
        assert len(environment.faces("skin")) == environment.info.boundary_face_count


def test_warped_cells_are_not_called_inside_out() -> None:
    """A thin layer on a curved wall has such cells. Divided by unlike diagonals, the two large sides of one pass through each other."""
    corners = [(t, u, v) for v in (0, 1) for t, u in ((0, 0), (1, 0), (1, 1), (0, 1))]
    for height, sign in ((0, 1), (1, 0)):
        points = np.array([(0.01 * t + height * (u != v), u, v) for t, u, v in corners])
        for cell, expected in ((list(range(8)), sign), ([0, 3, 2, 1, 4, 7, 6, 5], -sign)):
            mesh = raw.mesh_of(meshio_reader.raw_of(meshio.Mesh(points, [("hexahedron", [cell])]), "the mesh"))
            assert orient.signs(mesh).tolist() == [expected]
