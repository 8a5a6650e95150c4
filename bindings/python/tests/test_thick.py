"""A thick wire in a room: its radius, the gap that is left, and a move that keeps it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import dartsweep as ds

CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
POINTS = [(x, y, z) for z in range(2) for y in range(2) for x in range(4)]
CELLS = [[(z * 2 + y) * 4 + i + x for x, y, z in CORNERS] for i in range(3)]
WIRE = np.array([(0.75, 0.5, 0.5), (1.5, 0.5, 0.5), (2.25, 0.5, 0.5)])
SHARE = 2**-31  # of a radius: what it may lack


@pytest.fixture
def scene() -> Iterator[ds.Scene]:
    """Three unit cubes in a row."""
    with ds.Environment(POINTS, CELLS) as environment, ds.Scene(environment, ds.Feature.BODY_CONTACTS) as made:
        yield made


def create(scene: ds.Scene, radius: float) -> ds.Body:
    return scene.create_body(WIRE, [(0, 1), (1, 2)], radius=radius)


def test_the_radius_is_read_and_changed(scene: ds.Scene) -> None:
    wire = create(scene, 0.1)
    assert wire.radius == 0.1
    assert 0.4 - 1e-8 < wire.least_gap(1) <= 0.4
    assert wire.least_gap(0.25) == 0.25
    wire.radius = 0.2
    assert wire.radius == 0.2 and wire.least_gap(1) == pytest.approx(0.3)
    with pytest.raises(ds.errors.Occupied):
        wire.radius = 0.6
    assert scene.offending_edges().tolist() == [[0, 1], [1, 2]] and wire.radius == 0.2
    wire.radius = 0
    assert scene.create_body([(0.5, 0.25, 0.5)]).radius == 0
    for bad in (-1.0, np.inf, np.nan):
        with pytest.raises(ds.errors.OutOfRange, match="radius is"):
            wire.radius = bad
        with pytest.raises(ds.errors.OutOfRange, match="limit is"):
            wire.least_gap(bad)


def test_what_is_too_near_is_not_created(scene: ds.Scene) -> None:
    with pytest.raises(ds.errors.Occupied):
        create(scene, 0.6)
    assert scene.offending_edges().tolist() == [[0, 1], [1, 2]]
    create(scene, 0.2)
    above = WIRE + (0, 0, 0.25)
    with pytest.raises(ds.errors.Occupied):
        scene.create_body(above, [(0, 1), (1, 2)], radius=0.1)
    assert scene.create_body(above, [(0, 1), (1, 2)], radius=0.05).radius == 0.05


def test_a_move_keeps_the_radius(scene: ds.Scene) -> None:
    wire = create(scene, 0.1)
    options = ds.MoveOptions()
    options.vertex_response = options.edge_response = ds.Response.SLIDE
    for _ in range(5):
        wire.move(wire.positions() + (0.1, 0, -0.2), options)
        assert wire.least_gap(0.1) >= -0.1 * SHARE
    assert wire.positions()[:, 2] == pytest.approx(0.1, abs=1e-3)
    assert wire.positions()[0, 0] > 1


def test_rows_have_the_radii(scene: ds.Scene) -> None:
    wire = create(scene, 0.125)
    rows = wire.near_rows(0.4)
    assert len(rows) and rows["gap"].tolist() == (rows["distance"] - 0.125).tolist() and rows["gap"][0] == 0.375
    assert len(wire.near_rows(0.25)) == 0
    assert wire.near_rows(0.25, radius=0.125)["gap"].tolist() == [0.25] * len(rows)
    other = scene.create_body([(1.5, 0.25, 0.875), (1.5, 0.75, 0.875)], [(0, 1)], radius=0.0625)
    between = wire.near_rows(0.25)
    assert between["body"].tolist() == [(other.id.index, other.id.generation)]
    assert between["gap"].tolist() == [0.1875]


def test_a_saved_scene_has_the_radius(scene: ds.Scene) -> None:
    wire = create(scene, 0.1)
    with ds.Scene.load(scene.environment, scene.save()) as loaded:
        assert loaded.body(wire.id).radius == 0.1
