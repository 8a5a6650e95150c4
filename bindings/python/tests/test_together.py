"""All vertices of bodies at once, and walls with them: known answers, and arguments that are refused."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

import dartsweep as ds
from dartsweep import dtypes

CORNERS = np.array([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (0, 0, 4), (4, 0, 4), (4, 4, 4), (0, 4, 4)], np.float64)
EDGES = [(0, 1), (1, 2)]


def strand(x: float) -> NDArray[np.float64]:
    return np.array([(x, 1, 1), (x, 2, 1), (x, 3, 1)], np.float64)


@pytest.fixture
def room() -> Iterator[ds.Scene]:
    """One hexahedron, whose outer boundary is a wall."""
    with (
        ds.Environment(CORNERS, [range(8)]) as environment,
        ds.Scene(environment, ds.Feature.BODY_CONTACTS | ds.Feature.DEFORMING) as scene,
    ):
        yield scene


def test_strands_do_not_stop_each_other(room: ds.Scene) -> None:
    strands = [room.create_body(strand(x), EDGES) for x in (1, 1.25)]
    ids = [each.id for each in strands]
    moved = room.move_together(ids, np.concatenate([strand(2), strand(2.25)]))
    assert moved.dtype == dtypes.MOVE_REPORT and moved["fraction"].tolist() == [1, 1]
    assert np.array_equal(strands[0].positions(), strand(2))
    # One vertex at a time the left strand runs into the right one.
    moved = room.move_bodies(ids, np.concatenate([strand(3), strand(3.25)]))
    assert moved["vertices_stopped"].tolist() == [3, 0]


def test_what_stops(room: ds.Scene) -> None:
    left, right = room.create_body(strand(1), EDGES), room.create_body(strand(3), EDGES)
    targets = np.concatenate([strand(5), strand(3.5)])  # a wall is at x = 4, after 3 of 4 for the left strand
    targets[:3, 1:] -= 0.25, 0.25  # below the right strand
    assert room.move_together([left.id, right.id], targets)["fraction"] == pytest.approx(0.75, abs=1e-9)
    assert left.contacts()["time"].tolist() == [0.75] * 3 and len(right.contacts()) == 0
    assert right.positions()[0, 0] == pytest.approx(3.375, abs=1e-9)
    options = ds.options(ds.TogetherOptions, stop=ds.TogetherStop.FEATURE, max_rounds=4)
    assert options.stop is ds.TogetherStop.FEATURE
    moved = room.move_together([left.id, right.id], targets, options)
    assert moved["vertices_stopped"].tolist() == [3, 0]
    assert np.array_equal(right.positions(), strand(3.5))


def test_the_floor_stops_before_a_strand(room: ds.Scene) -> None:
    body = room.create_body(strand(2), EDGES)
    raised = CORNERS.copy()
    raised[:4, 2] = 2
    report, reports = room.deform(raised)
    assert report.outcome == ds.DeformOutcome.FRACTION and 0.4999999 < report.fraction < 0.5 and len(reports) == 0
    assert raised[0, 2] == pytest.approx(1, abs=1e-9) and raised[0, 2] < 1
    contacts = room.environment.wall_contacts()
    assert report.contact_count == len(contacts) > 0 and (contacts["time"] == 0.5).all()
    assert (contacts["response"] == ds.WallResponse.STOP).all() and contacts[0]["body"]["index"] == body.id.index
    assert np.array_equal(body.positions(), strand(2))


def test_a_strand_rises_with_the_floor(room: ds.Scene) -> None:
    body = room.create_body(strand(2), EDGES)
    raised, target = CORNERS.copy(), strand(2)
    raised[:4, 2] = 1.5
    target[:, 2] = 2
    report, reports = room.deform(raised, [body.id], target)
    assert report.outcome == ds.DeformOutcome.DONE and reports["fraction"].tolist() == [1]
    assert np.array_equal(body.positions(), target) and np.array_equal(room.environment.points(), raised)
    room.close()
    raised[0] = 7  # is no longer lent


def test_only_the_parts_that_touch_stop(room: ds.Scene) -> None:
    body = room.create_body(strand(2), EDGES)
    raised, target = CORNERS.copy(), strand(2)
    raised[:4, 2] = 2
    target[:, 0] += 0.5
    report, reports = room.deform(raised, [body.id], target, ds.options(ds.SceneDeformOptions, stop=ds.TogetherStop.FEATURE))
    assert report.outcome == ds.DeformOutcome.HELD and report.fraction == 1 and report.held_count == len(room.environment.held_vertices()) > 0
    assert reports["fraction"].tolist() == [0.5] and reports["vertices_stopped"][0] > 0
    with pytest.raises(ds.errors.Unsupported, match="ISLAND"):
        room.deform(CORNERS.copy(), options=ds.options(ds.SceneDeformOptions, stop=ds.TogetherStop.ISLAND))


def test_a_floor_pushes_a_strand(room: ds.Scene) -> None:
    body = room.create_body(strand(2), EDGES)
    raised, target = CORNERS.copy(), strand(2)
    raised[:4, 2] = 2
    target[:, 0] += 0.5
    slides = ds.options(ds.SceneDeformOptions, stop=ds.TogetherStop.FEATURE, response=ds.TogetherResponse.SLIDE)
    report, reports = room.deform(raised, [body.id], target, slides)
    assert report.outcome == ds.DeformOutcome.DONE and reports["fraction"].tolist() == [0.5]
    assert np.array_equal(body.positions()[:, 0], target[:, 0]) and body.positions()[:, 2] == pytest.approx(2, abs=1e-9)
    assert np.array_equal(body.ways_left(), target - body.positions())
    body.move(body.positions())
    assert body.ways_left().shape == (0, 3)


def test_a_floor_pushes_a_thick_strand(room: ds.Scene) -> None:
    body = room.create_body(strand(2), EDGES, radius=0.125)
    raised, target = CORNERS.copy(), strand(2)
    raised[:4, 2] = 2
    target[:, 0] += 0.5
    slides = ds.options(ds.SceneDeformOptions, stop=ds.TogetherStop.FEATURE, response=ds.TogetherResponse.SLIDE)
    report, reports = room.deform(raised, [body.id], target, slides)
    assert report.outcome == ds.DeformOutcome.DONE and reports["fraction"][0] == pytest.approx(0.4375, abs=1e-9)
    assert body.positions()[:, 0] == pytest.approx(target[:, 0], abs=1e-9) and body.positions()[:, 2] == pytest.approx(2.125, abs=0.125 * 2**-19)


def test_the_work_limit(room: ds.Scene) -> None:
    body = room.create_body(strand(2), EDGES)
    raised, side = CORNERS.copy(), strand(5e-324)  # integers are long beside it
    raised[:4, 2] = 2
    asked = raised.copy()
    report, reports = room.deform(raised, [body.id], side, ds.options(ds.SceneDeformOptions, max_work=1))
    assert report.outcome == ds.DeformOutcome.LIMITED and report.fraction == 0 and reports["vertices_limited"].tolist() == [3]
    assert np.array_equal(body.positions(), strand(2)) and np.array_equal(raised, asked)
    assert np.array_equal(room.environment.points(), CORNERS)
    report, reports = room.deform(raised, [body.id], side)
    assert report.outcome == ds.DeformOutcome.FRACTION and 0.4999999 < report.fraction <= 0.5
    assert reports["vertices_limited"].tolist() == [0] and reports["vertices_stopped"].tolist() == [3]


def test_what_is_wrong_is_refused(room: ds.Scene) -> None:
    body = room.create_body(strand(2), EDGES)
    for ids, targets, error in (
        ([body.id], strand(2)[:2], ds.errors.WrongSize),
        ([body.id] * 2, np.concatenate([strand(2)] * 2), ds.errors.DuplicateId),
        ([ds.BodyId(5, 1)], strand(2), ds.errors.StaleId),
        ([body.id], strand(np.nan), ds.errors.NonFinite),
        ([body.id], strand(2)[:, :2], ds.errors.WrongSize),
    ):
        with pytest.raises(error):
            room.move_together(ids, targets)
        with pytest.raises(error):
            room.deform(CORNERS.copy(), ids, targets)
    with pytest.raises(ds.errors.WrongSize):
        room.deform(CORNERS[:7].copy())
    with pytest.raises(TypeError):
        room.deform(CORNERS.tolist())
    with pytest.raises(ds.errors.Unsupported, match="stop"):
        room.move_together([body.id], strand(2), ds.options(ds.TogetherOptions, stop=3))
    with ds.Environment(CORNERS, [range(8)]) as environment, ds.Scene(environment) as scene:
        with pytest.raises(ds.errors.NotEnabled, match="DSW_FEATURE_DEFORMING"):
            scene.deform(CORNERS.copy())
    assert len(room.move_together([], np.empty((0, 3)))) == 0


def test_a_step_of_a_line_search(room: ds.Scene) -> None:
    wire = room.create_body(strand(1), EDGES)
    goal = strand(4.5)  # beyond the wall at x = 4: an energy that falls towards it

    def energy(points: NDArray[np.float64]) -> float:
        return float(((points - goal) ** 2).sum())

    for _ in range(20):
        points = wire.positions()
        step = 0.5 * (goal - points)  # Newton's
        found = room.step_fraction([wire.id], step)
        length = found.fraction  # instead of 1
        while length > 0 and energy(points + length * step) > energy(points):
            length /= 2
        places = found.places if length == found.fraction else points + length * step
        room.move_together([wire.id], places)
    assert 3.999999 < wire.positions()[0, 0] < 4


def test_how_much_of_steps_is_free(room: ds.Scene) -> None:
    left, right = room.create_body(strand(1), EDGES), room.create_body(strand(3), EDGES)
    steps = np.zeros((6, 3))
    steps[:3, 0], steps[3:, 0] = 4, 0.5
    steps[:3, 1:] = -0.25, 0.25
    found = room.step_fraction([left.id, right.id], steps)
    assert found.fraction == pytest.approx(0.75, abs=1e-15) and found.fraction < 0.75 and found.fractions.tolist() == [found.fraction] * 2
    assert np.array_equal(found.places, np.concatenate([strand(1), strand(3)]) + found.fraction * steps)
    assert np.array_equal(left.positions(), strand(1)) and found.environment_places is None
    walls = np.zeros((8, 3))
    walls[:4, 2] = 2
    found = room.step_fraction([left.id], np.zeros((3, 3)), walls)
    assert found.fraction == pytest.approx(0.5, abs=1e-15) and found.fraction < 0.5
    assert found.environment_places is not None and np.array_equal(found.environment_places, CORNERS + found.fraction * walls)
    by_island = ds.options(ds.TogetherOptions, stop=ds.TogetherStop.ISLAND)
    assert room.step_fraction([left.id, right.id], steps, options=by_island).fractions[1] < 1
    with pytest.raises(ds.errors.WrongSize):
        room.step_fraction([left.id], steps)


def test_back_edges_that_are_left_are_listed(room: ds.Scene) -> None:
    corners = np.array([(1, 1, 1), (2, 1, 1), (1, 2, 1), (1, 1, 2)], np.float64)
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    flags = ds.BodyFlag.SKIP_BACK_EDGES | ds.BodyFlag.LEAVE_BACK_EDGES
    body = room.create_body(corners, triangles=faces, level=ds.Level.EDGES, flags=flags)
    assert len(body.untested_edges()) == 0
    body.move([*corners[:3], (1.1, 1.1, 1.7)])  # the tip goes inwards
    assert {tuple(sorted(body.edge_ends(edge)["index"])) for edge in body.untested_edges()} == {(0, 3), (1, 3), (2, 3)}
    body.move(corners)
    assert len(body.untested_edges()) == 0


def test_a_particle_has_a_state(room: ds.Scene) -> None:
    particle = room.create_particle((2, 2, 2))
    cell, aim = room.particle_state(particle)
    assert cell.kind == ds.CellKind.VOLUME and aim.kind == ds.CellKind.NONE
    room.move_particle(particle, (2, 2, 9))
    assert room.particle_state(particle)[1].kind == ds.CellKind.FACE
