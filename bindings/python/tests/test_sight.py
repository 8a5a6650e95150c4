"""Rays among walls and bodies, and points of walls that see each other."""

from __future__ import annotations

import numpy as np
import pytest

import dartsweep as ds
from test_names import block


def room() -> ds.Environment:
    """A block of unit cubes, 2 x 2 x 4, with a pillar: one of them is impassable."""
    points, cells = block()
    environment = ds.Environment(points, cells, regions=(np.arange(len(cells)) == 0).astype(np.int32))
    environment.mark_region(1)
    return environment


def test_a_ray_names_the_part_that_it_meets() -> None:
    with room() as environment, ds.Scene(environment, features=ds.Feature.BODY_CONTACTS) as scene:
        leaf = scene.create_body([(1.2, 1.2, 1.5), (1.8, 1.2, 1.5), (1.2, 1.8, 1.5)], triangles=[(0, 1, 2)], level=ds.Level.FACES)
        flights, partners = scene.cast([(1.3, 1.3, 2.0), (1.9, 1.9, 2.0)], [(1.3, 1.3, 1.0), (1.9, 1.9, 1.0)])
        assert flights["outcome"].tolist() == [ds.Outcome.CONTACT, ds.Outcome.REACHED]
        assert flights["time"][0] == 0.5 and flights["contact"]["normal"][0].tolist() == [0, 0, 1]
        assert partners["body"]["index"][0] == leaf.id.index and partners["face"]["generation"].tolist() == [1, 0]
        nearest, near = scene.find_nearest([(1.3, 1.3, 1.625), (1.9, 1.9, 3.75)])
        assert nearest["distance"][0] == 0.125 and near["face"]["generation"].tolist() == [1, 0]
        with pytest.raises(ds.errors.OutOfRange):
            scene.find_nearest([(1.3, 1.3, 1.6)], radius=-1.0)


def test_distances_have_signs() -> None:
    with room() as environment:
        assert environment.signed_distances([(0.5, 0.5, 3.75), (3.0, 1.0, 1.0), (2.0, 1.0, 1.0)]).tolist() == [-0.25, 1.0, 0.0]
        assert environment.signed_distances((1.0, 1.0, 1.5)).shape == ()


def test_corners_see_each_other_past_a_pillar() -> None:
    with room() as environment:
        corners = np.array([(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (2.0, 2.0, 4.0), (0.0, 2.0, 2.0)])
        begin, end = np.triu_indices(len(corners), 1)
        seen = environment.sees(corners[begin], corners[end])
        assert (seen == environment.sees(corners[end], corners[begin])).all()
        # The first two are corners of the pillar with the pillar between them; the last two lie on one wall.
        assert dict(zip(zip(begin.tolist(), end.tolist()), seen.tolist())) == {
            (0, 1): False, (0, 2): True, (0, 3): False, (1, 2): True, (1, 3): False, (2, 3): False,
        }
