"""Rigid motions: how far bodies could go along paths, while nothing moves, and how they slide."""

from __future__ import annotations

import numpy as np
import pytest

import dartsweep as ds
from dartsweep import dtypes

CORNERS = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (0, 0, 4), (4, 0, 4), (4, 4, 4), (0, 4, 4)]
BAR = [(1, 2, 2), (3, 2, 2)]
MIDDLE = (2, 2, 2)
# The bar as it is, turned by half, and beside the room.
POSES = [(0, 0, 0, 1, 0, 0, 0), (0, 0, 1, 0, 0, 0, 0), (0, 0, 0, 1, 4, 0, 0)]


def test_paths_of_any_length() -> None:
    with ds.Environment(CORNERS, [range(8)]) as environment, ds.Scene(environment) as scene:
        bar = scene.create_body(BAR, [(0, 1)])
        contacts = np.empty(4, dtypes.BODY_CONTACT)
        found = bar.find_free_fractions(POSES, [(0, 1, 0), (0, 2), (2,), (1,)], MIDDLE, contacts)
        assert found["starts_free"].tolist() == [1, 1, 0, 1]
        assert found["piece"].tolist() == [2, 0, 0, 0]
        assert found["fraction"] == pytest.approx([1, 0.25, 0, 1], abs=1e-12) and found["fraction"][1] < 0.25
        assert contacts["time"].tolist() == [0, 0.25, 0, 0]
        assert bar.positions().tolist() == [list(map(float, point)) for point in BAR]
        assert bar.move_rigid(translation=(4, 0, 0)).fraction == found["piece_fraction"][1]
        assert len(bar.find_free_fractions(POSES, [])) == 0
        at_once = bar.find_free_fractions(POSES, np.array([(0, 1, 0), (0, 0, 1)], np.uint8), MIDDLE)
        assert at_once["piece"].tolist() == [2, 2]


def test_paths_are_checked() -> None:
    with ds.Environment(CORNERS, [range(8)]) as environment, ds.Scene(environment) as scene:
        bar = scene.create_body(BAR, [(0, 1)])
        with pytest.raises(ValueError):
            bar.find_free_fractions([(0, 0, 0, 1)], [(0, 0)])
        for paths in ([(0, 3)], [(-1, 0)]):
            with pytest.raises(IndexError):
                bar.find_free_fractions(POSES, paths)
        for fractional in ([(0, 0.7)], np.array([(0.0, 1.0)]), [(0,), (1.0,)]):
            with pytest.raises(TypeError):
                bar.find_free_fractions(POSES, fractional)
        with pytest.raises(ds.errors.WrongSize):
            bar.find_free_fractions(POSES, [()])
        with pytest.raises(ds.errors.OutOfRange):
            bar.find_free_fractions([[0] * 7], [(0, 0)])


def test_a_bar_slides_along_a_wall() -> None:
    with ds.Environment(CORNERS, [range(8)]) as environment, ds.Scene(environment) as scene:
        bar = scene.create_body(BAR, [(0, 1)])
        report = bar.move_rigid((4, 1, 0), options=ds.options(ds.MoveOptions, flags=ds.MoveFlag.SLIDE_WHOLE))
        assert report.fraction == pytest.approx(0.25, abs=1e-12) and report.vertices_stopped == 2
        assert bar.positions() == pytest.approx(np.array([(2, 3, 2), (4, 3, 2)], float), abs=1e-9)
        assert bar.motion_left().translation == pytest.approx([3, 0, 0], abs=1e-9)


def test_rigid_bodies_move_at_once() -> None:
    with ds.Environment(CORNERS, [range(8)]) as environment, ds.Scene(environment, ds.Feature.BODY_CONTACTS) as scene:
        bars = [scene.create_body([(x, 2, 2), (x + 0.5, 2, 2)], [(0, 1)]) for x in (0.5, 3)]
        motions = [(0, 0, 0, 1, 0, 0, 0, way, 0, 0) for way in (4, -4)]
        reports = scene.move_rigid([bar.id for bar in bars], motions)
        assert reports["fraction"] == pytest.approx([0.25, 0.25], abs=1e-12) and reports["fraction"][0] == reports["fraction"][1]
        with pytest.raises(ValueError):
            scene.move_rigid([bar.id for bar in bars], [(0, 0, 0, 1)])


def test_thick_rigid_bodies_keep_their_distance_at_once() -> None:
    with ds.Environment(CORNERS, [range(8)]) as environment, ds.Scene(environment, ds.Feature.BODY_CONTACTS) as scene:
        bars = [scene.create_body([(x, 2, 2), (x + 0.5, 2, 2)], [(0, 1)], radius=0.125) for x in (0.5, 3)]
        motions = [(0, 0, 0, 1, 0, 0, 0, way, 0, 0) for way in (4, -4)]
        reports = scene.move_rigid([bar.id for bar in bars], motions)
        assert reports["fraction"] == pytest.approx([0.21875] * 2, abs=1e-9) and reports["contact_count"].all()


def test_a_bar_turns_while_the_floor_rises() -> None:
    half = 0.5**0.5
    raised = np.array(CORNERS, float)
    raised[:4, 2] = 3
    with ds.Environment(CORNERS, [range(8)]) as environment, ds.Scene(environment, ds.Feature.DEFORMING) as scene:
        bar = scene.create_body(BAR, [(0, 1)])
        report, reports = scene.deform_rigid(raised, [bar.id], [(0, 0, half, half, 2, 2, 2, 0, 0, 0)])
        assert report.outcome == ds.DeformOutcome.FRACTION and reports["fraction"] == report.fraction
        assert report.fraction == pytest.approx(2 / 3, abs=1e-9) and report.contact_count > 0
        assert environment.wall_contacts()["time"] == pytest.approx(2 / 3)
        # At this fraction of the way of the quaternion.
        tangent = report.fraction * half / (1 - report.fraction + report.fraction * half)
        angle = 2 * np.arctan(tangent)
        assert bar.positions()[1] == pytest.approx([2 + np.cos(angle), 2 + np.sin(angle), 2], abs=1e-9)
        with pytest.raises(ValueError):
            scene.deform_rigid(raised.copy(), [bar.id], [(0, 0, 0, 1)])
        with pytest.raises(ds.errors.Unsupported):
            options = ds.options(ds.SceneDeformOptions, stop=ds.TogetherStop.FEATURE)
            scene.deform_rigid(raised.copy(), [bar.id], [(0, 0, 0, 1) + (0,) * 6], options)
