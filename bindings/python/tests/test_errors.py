from __future__ import annotations

import pytest

import dartsweep as ds
from dartsweep import _core

STATUSES = [status for status in ds.Status if status is not ds.Status.OK]


@pytest.mark.parametrize("status", STATUSES, ids=lambda status: status.name)
def test_every_status_has_its_exception(status: ds.Status) -> None:
    name = "".join(part.capitalize() for part in status.name.split("_"))
    with pytest.raises(ds.Error) as caught:
        _core.raise_status(int(status))
    assert type(caught.value).__name__ == name
    assert type(caught.value) is getattr(ds.errors, name)
    assert caught.value.status is status


def test_the_text_is_that_of_the_library(environment: ds.Environment) -> None:
    with pytest.raises(ds.errors.NonFinite, match=r"dsw_environment_cast: from\[1\] is nan, must be finite"):
        environment.cast((0.0, float("nan"), 0.0), (1.0, 1.0, 1.0))


def test_a_missing_cell_type_is_named() -> None:
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    with pytest.raises(ValueError, match="cells in one dimension need `types`"):
        ds.Environment(corners, [0, 1, 2, 3])
    with ds.Environment(corners, [[0, 1, 2, 3]]) as environment:
        assert environment.info.volume_count == 1


def test_some_are_of_pythons_kinds_too() -> None:
    assert issubclass(ds.errors.OutOfMemory, MemoryError)
    assert issubclass(ds.errors.OutOfRange, ValueError)
    assert issubclass(ds.Closed, ds.errors.NullArgument)


def test_the_failing_call_changes_nothing(scene: ds.Scene) -> None:
    scene.create_particles([(24.0, 24.0, 48.0)])
    before = scene.save()
    with pytest.raises(ds.errors.Outside):
        scene.create_particles([(24.0, 24.0, 48.0), (-9.0, 0.0, 0.0)])
    with pytest.raises(ds.errors.Occupied):
        scene.environment.mark_volumes([scene.environment.locate((24.0, 24.0, 48.0))[0]])
    assert scene.save() == before
    assert len(scene.occupants()) == 1


def test_bodies_tell_what_is_wrong_with_a_part(scene: ds.Scene) -> None:
    corners = [(24.0, 24.0, 40.0), (26.0, 24.0, 40.0), (24.0, 26.0, 40.0), (26.0, 26.0, 41.0), (26.0, 26.0, 39.0)]
    body = scene.create_body(corners, triangles=[(0, 1, 2)])
    a, b, c, d, e = body.vertex_ids()
    with pytest.raises(ds.errors.RepeatedVertex):
        body.add_edge(a, a)
    with pytest.raises(ds.errors.DuplicatePart):
        body.add_edge(b, a)
    with pytest.raises(ds.errors.NotOriented):
        body.add_face(b, c, d)
    body.add_face(c, b, d)
    with pytest.raises(ds.errors.NotManifold):
        body.add_face(b, c, e)
    assert body.counts.face_count == 2


def test_options_know_their_members() -> None:
    assert ds.options(ds.MoveOptions, stand_off=-1.0).stand_off == -1.0
    with pytest.raises(TypeError, match="MoveOptions has no member 'standoff'"):
        ds.options(ds.MoveOptions, standoff=-1.0)
