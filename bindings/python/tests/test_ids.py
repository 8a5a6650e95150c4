"""Every id that a result holds goes into every call that takes one; wrong arguments are told in words."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

import meshio
import numpy as np
import pytest

import dartsweep as ds
from dartsweep import dtypes
from scenario import vessel


@pytest.fixture
def contact(scene: ds.Scene) -> Any:
    """The contact of a body that was moved into a wall."""
    body = scene.create_body([(24.0, 24.0, 40.0), (24.0, 24.0, 44.0)], [(0, 1)])
    body.move([(24.0, 24.0, 40.0), (90.0, 24.0, 44.0)])
    return body.contacts()[0]["contact"]


def test_entries_of_results_name_cells(environment: ds.Environment, contact: Any) -> None:
    assert not environment.is_impassable(contact["front"])
    assert environment.is_impassable(contact["obstacle"]) and environment.is_impassable(contact["wall"])
    kind = ds.CellKind(contact["obstacle"]["kind"])
    count = {ds.CellKind.VERTEX: 1, ds.CellKind.EDGE: 2, ds.CellKind.FACE: 4, ds.CellKind.VOLUME: 8}[kind]
    assert len(environment.vertices(contact["obstacle"])) == count
    assert len(environment.vertices(contact["wall"])) == 4
    assert len(environment.vertices(contact["front"])) == 8
    near, far = environment.face_volumes(contact["wall"])
    assert not near.is_null() and not far.is_null()
    assert environment.region(contact["front"]) == 1


def test_flights_hold_ids(environment: ds.Environment) -> None:
    one = environment.cast((24, 24, 40), (90, 24, 44))
    many = environment.cast_segments([(24, 24, 40)] * 2, [(90, 24, 44)] * 2)
    for flight in (many[0], many[1:2][0], many.copy()[0]):
        assert np.array_equal(environment.vertices(flight["contact"]["wall"]), environment.vertices(one.contact.wall))
        assert environment.region(flight["volume"]) == environment.region(one.volume)
        assert environment.is_impassable(flight["contact"]["behind"]) == environment.is_impassable(one.contact.behind)
    trace = ds.Trace()
    trace.add_contact(many[0], 1.0)
    other = ds.Trace()
    other.add_contact(one, 1.0)
    assert np.array_equal(trace.points, other.points) and len(trace.points)


def test_ids_keep_their_kind_in_nested_structs() -> None:
    for kind in (dtypes.FLIGHT, dtypes.SWEEP, dtypes.BODY_CONTACT, dtypes.WALL_CONTACT):
        touched = np.zeros(1, kind)[0]["contact"]
        told = {name: (touched[name].dtype.metadata or {}).get("id") for name in ("wall", "front", "behind")}
        assert told == {"wall": "FaceId", "front": "VolumeId", "behind": "VolumeId"}
        assert touched["obstacle"].dtype == dtypes.CELL


def test_contacts_have_a_past_and_a_cross_check(environment: ds.Environment, scene: ds.Scene) -> None:
    body = scene.create_body([(24.0, 24.0, 40.0), (24.0, 24.0, 44.0)], [(0, 1)])
    for _ in range(2):
        body.move([(24.0, 24.0, 40.0), (90.0, 24.0, 44.0)])
    contact, past = body.contacts()[0], body.previous_contacts()[0]
    assert contact["history"] == ds.ContactHistory.LASTING and past["since"] == 1 and past["moves"] == 2
    assert environment.vertices(past["obstacle"]).tolist() == environment.vertices(contact["contact"]["obstacle"]).tolist()
    try:
        check = environment.cross_check(contact)
    except ds.errors.NotBuilt:
        return
    assert isinstance(check.kind, ds.CrossCheckKind) and check.angle_rad < 1e-3


def test_one_id_is_as_good_as_an_array(environment: ds.Environment) -> None:
    flight = environment.cast_segments([(24, 24, 40)], [(90, 24, 44)])[0]
    inside = environment.locate((24, 24, 40))[0]
    for volume in (inside, environment.locate_points([(24.0, 24.0, 40.0)])[0][0], np.array([tuple(pair(inside))], dtypes.VOLUME_ID)):
        environment.mark_volumes(volume)
        assert environment.is_impassable(inside)
        environment.mark_volumes([volume] if not isinstance(volume, np.ndarray) else volume, ds.Mark.PASSABLE)
        assert not environment.is_impassable(inside)
    environment.mark_faces(flight["contact"]["wall"])
    assert environment.is_marked(flight["contact"]["wall"])


def pair(volume: ds.VolumeId) -> tuple[int, int]:
    return volume.index, volume.generation


def test_cells_go_where_their_kind_is_asked_for(environment: ds.Environment) -> None:
    inside = environment.locate((24, 24, 40))[0]
    cell = ds.cell_of(inside)
    assert environment.region(cell) == environment.region(inside)
    cells = np.array([(cell.kind, cell.index, cell.generation, cell.local)], dtypes.CELL)
    assert environment.region(cells[0]) == environment.region(inside)
    environment.mark_volumes(cells)
    assert environment.is_impassable(cells[0])
    with pytest.raises(TypeError, match="the cell is no FaceId"):
        environment.face_volumes(cell)


def test_an_entry_without_a_kind_is_refused(environment: ds.Environment) -> None:
    plain = np.zeros(1, [("index", np.uint32), ("generation", np.uint32)])
    with pytest.raises(TypeError, match=r"VolumeId\(\*entry\)"):
        environment.is_impassable(plain[0])
    with pytest.raises(TypeError, match="a Cell, or the id"):
        environment.is_impassable(3)


def test_wrong_arguments_are_told_in_words(environment: ds.Environment) -> None:
    calls: dict[str, Callable[[], object]] = {
        r"get_volume_id\(\) takes an integer in its range": lambda: environment.volume_id("first"),  # type: ignore[arg-type]
        r"find_nearest\(\) takes a number": lambda: environment.find_nearest((24, 24, 40), "near"),  # type: ignore[arg-type]
        r"cast\(\) takes an object of type CastOptions": lambda: environment.cast((24, 24, 40), (90, 24, 44), None, 7),  # type: ignore[arg-type]
        "MoveOptions.edge_response takes a constant of Response": lambda: ds.options(ds.MoveOptions, edge_response="slide"),
        "VolumeId is needed": lambda: environment.region("first"),
    }
    for words, call in calls.items():
        with pytest.raises(TypeError, match=words):
            call()
    with pytest.raises(OverflowError, match="an integer in its range"):
        environment.volume_id(-1)


def test_a_misspelt_option_is_an_error() -> None:
    options: Any = ds.MoveOptions()
    with pytest.raises(AttributeError, match="did you mean 'edge_response'"):
        options.edge_respons = ds.Response.SLIDE
    with pytest.raises(TypeError, match="MoveOptions has no member 'speed'"):
        ds.options(ds.MoveOptions, speed=1)


def test_constants_print_as_names(environment: ds.Environment) -> None:
    flight = environment.cast((24, 24, 40), (90, 24, 44))
    assert flight.outcome is ds.Outcome.CONTACT
    assert str(flight.outcome) == f"{flight.outcome}" == repr(flight.outcome) == "Outcome.CONTACT"
    assert f"{flight.outcome:d}" == str(int(flight.outcome))
    assert "outcome=Outcome.CONTACT" in repr(flight)
    assert str(ds.BodyFlag.RIGID | ds.BodyFlag.SEQUENCES) == "BodyFlag.SEQUENCES|RIGID"
    assert environment.locate((24, 24, 40))[1] is ds.Location.PASSABLE


def test_groups_of_meshes_have_names() -> None:
    points, cells, regions = vessel()
    names = {"lumen": np.array([1, 3]), "wall": np.array([2, 3]), "seam": np.array([1, 2])}
    gmsh = meshio.Mesh(points, [("hexahedron", cells)], cell_data={"gmsh:physical": [regions]}, field_data=names)
    inner, outer = (np.flatnonzero(regions == label) for label in (1, 2))
    sets = meshio.Mesh(points, [("hexahedron", cells)], cell_sets={"lumen": [inner], "wall": [outer]})
    for mesh in (gmsh, sets):
        with ds.from_meshio(mesh) as environment:
            assert environment.region_names == {"lumen": 1, "wall": 2} and environment.regions() == [1, 2]
            assert environment.mark_region("wall")[0] == len(outer)
            assert environment.mark_between("lumen", "wall", ds.Mark.PASSABLE) > 0
            with pytest.raises(ValueError, match=r"no region is called 'bone'; regions are 1 \(lumen\), 2 \(wall\)"):
                environment.mark_region("bone")
            with pytest.raises(ValueError, match="no volume has region 7"):
                environment.mark_region(7)
            again = pickle.loads(pickle.dumps(environment))
            assert again.region_names == environment.region_names
    overlapping = meshio.Mesh(points, [("hexahedron", cells)], cell_sets={"all": [np.arange(len(cells))], "wall": [outer]})
    with ds.from_meshio(overlapping) as environment:
        assert environment.mark_region("wall")[0] == len(outer) and environment.mark_region("all")[0] == len(cells)
