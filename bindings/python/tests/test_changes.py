"""Changes of the topology: numbers, and lists that are arrays whose ids go into calls."""

from __future__ import annotations

import numpy as np
import pytest

import dartsweep as ds
from dartsweep import dtypes
from scenario import create

BLADE = [[(x, 3.0, z) for x in (-5.0, 60.0)] for z in (20.5, 60.25)]


def test_lists_are_arrays_that_last() -> None:
    environment = create()
    cut = environment.cut(BLADE)
    assert cut.volumes_split > 0 and len(cut.faces) > 0 and len(cut.detached) == 0
    kinds = {"volumes": dtypes.VOLUME_CHANGE, "vertices": dtypes.VERTEX_ORIGIN, "faces": dtypes.CUT_FACE, "whole": dtypes.VOLUME_ID}
    kinds |= {"carved": dtypes.VOLUME_ID, "unrepaired": dtypes.VOLUME_ID, "detached": dtypes.VOLUME_ID}
    kinds |= {"body_vertices": dtypes.VERTEX_ORIGIN, "body_faces": dtypes.FACE_ORIGIN}
    for name, kind in kinds.items():
        assert getattr(cut, name).dtype == kind and getattr(cut, name) is getattr(cut, name)
    last = environment.change()
    assert repr(last) == repr(cut) and f"faces={len(cut.faces)}" in repr(cut) and "volume_count" not in repr(cut)
    environment.unsew_face(cut.faces[0]["front"])
    assert len(environment.change().faces) == 0 and environment.change().volumes_split == 0
    faces = cut.faces
    environment.close()
    del cut, environment
    assert np.array_equal(faces, last.faces) and np.allclose(last.vertices["weights"].sum(axis=1), 1)


def test_a_drill_halves_what_it_crosses(environment: ds.Environment) -> None:
    environment.mark_volumes([environment.volume_id(237)])
    drill = [(29.25, 29.25, 53.25), (29.25, 27.25, 51.25), (27.25, 29.25, 51.25), (27.25, 27.25, 53.25)]
    change = environment.carve(drill, [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)], finest=1.0, flags=ds.CarveFlag.COVER)
    assert (change.volumes_split, len(change.carved), len(change.whole)) == (1, 63, 0)
    assert not any(environment.is_impassable(volume) for volume in change.carved)


def test_ids_of_changes_go_into_calls(environment: ds.Environment) -> None:
    cut = environment.cut(BLADE)
    one, gone = cut.volumes[0]["after"], cut.volumes[0]["before"]
    assert environment.volume_counts(one).faces > 0
    with pytest.raises(ds.errors.StaleId):
        environment.volume_counts(gone)
    added = cut.vertices[0]
    ends = np.array([environment.vertex_position(vertex) for vertex in added["from"]])
    assert np.allclose(environment.vertex_position(added["vertex"]), added["weights"] @ ends)
    torn = environment.tear_faces(cut.faces["front"], np.arange(len(cut.faces), dtype=float), 3.0)
    assert len(torn.faces) == len(cut.faces) - 4
    near, far = environment.face_volumes(torn.faces[0]["front"])
    assert not near.is_null() and far.is_null()
    opened = environment.open_crack(torn.faces, 0.125)
    assert opened.vertices_parted > 0 and opened.largest_width <= 0.125 * (1 + 1e-9) and len(opened.faces) == len(torn.faces)


def test_a_cut_opens(environment: ds.Environment) -> None:
    cut = environment.cut(BLADE, flags=ds.CutFlag.UNSEW)
    before = environment.info.volume_count
    opened = environment.open_crack(cut.faces, width=0.1)
    assert environment.info.volume_count - before == len(opened.faces) > 0
    added = opened.volumes[-len(opened.faces) :]
    assert not added["before"]["generation"].any() and not environment.is_impassable(added[0]["after"])


def test_a_name_that_no_change_has_is_an_error(environment: ds.Environment) -> None:
    cut = environment.cut(BLADE)
    with pytest.raises(AttributeError, match="did you mean 'volumes_split'"):
        setattr(cut, "volume_split", 1)


def test_a_piece_becomes_a_body(environment: ds.Environment, scene: ds.Scene) -> None:
    piece = environment.locate((24.0, 24.0, 48.0))[0]
    environment.mark_volumes(piece)
    body, change = environment.detach(piece)
    assert not environment.is_impassable(change.detached[0]) and len(change.detached) == 1
    made = scene.body(body)
    assert made.counts.vertex_count == len(change.body_vertices) and made.counts.face_count == len(change.body_faces)
    origins = np.array([environment.vertex_position(vertex) for vertex in change.body_vertices["from"][:, 0]])
    assert 0 < np.linalg.norm(made.positions() - origins, axis=1).max() == pytest.approx(change.distance)
    assert len(environment.vertices(change.body_faces[0]["face"])) == 4
    assert environment.region(change.body_faces[0]["volume"]) == 1
    with pytest.raises(ds.errors.BadTopology):
        environment.detach(change.detached[0])


def test_walls_tell_what_they_touched(environment: ds.Environment) -> None:
    with ds.Scene(environment, ds.Feature.DEFORMING) as scene:
        particle = scene.create_particle((10.0, 24.0, 48.0))
        moved = environment.points()
        moved[:, 0] += 0.4375 * (48 - moved[:, 0])
        report = environment.deform(moved)
        told = environment.wall_contacts()
        assert report.contact_count == len(told) > 0 and told[0]["particle"]["index"] == particle.index
        assert environment.is_impassable(told[0]["contact"]["wall"])
        assert np.all(np.isclose(np.linalg.norm(told["contact"]["normal"], axis=1), 1))
        assert len(environment.held_vertices()) == report.held_count and len(environment.invalid_volumes()) == report.invalid_count
