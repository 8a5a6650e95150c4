"""Cells whose mean does not see them whole, split when an environment is made."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import dartsweep as ds

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
