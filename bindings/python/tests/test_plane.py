"""The plane: points of two coordinates."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable

import meshio
import numpy as np
import pytest
from numpy.typing import NDArray

import dartsweep as ds
from scenario import create, create_plane

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def square(**options: object) -> ds.Environment:
    return ds.Environment(SQUARE, [(0, 1, 2), (0, 2, 3)], **options)  # type: ignore[arg-type]


def test_points_have_two_coordinates() -> None:
    with square() as environment:
        assert environment.dimension == environment.info.dimension == 2
        assert environment.points().tolist() == [list(point) for point in SQUARE]
        assert environment.vertex_position(environment.vertex_id(2)).tolist() == [1.0, 1.0]
        assert environment.centre(environment.volume_id(0)).shape == (2,)
        flight = environment.cast((0.5, 0.25), (0.5, 2.25))
        assert flight.time == 0.375 and flight.contact.normal.tolist() == [0.0, -1.0, 0.0]
        # Points of structs have a third coordinate, too.
        assert environment.cast((0.5, 0.25, 0.0), (0.5, 2.25, 0.0)).time == 0.375
        wide = np.array([(0.5, 0.25, 9.0, 9.0)])
        assert environment.cast_segments(wide[:, :2], wide[:, :2] + (0, 2))["time"] == 0.375
    with create() as space, pytest.raises(ds.errors.WrongSize, match="3 coordinates, not 2"):
        space.cast((24.0, 24.0), (24.0, 30.0))


def test_wrong_lengths_are_told() -> None:
    with create_plane() as environment, ds.Scene(environment, ds.Feature.DEFORMING) as scene:
        body = scene.create_body([(40, 30), (45, 30)], [(0, 1)])
        particles = scene.create_particles([(40, 30)])
        point, wide = (40.0, 30.0), np.zeros((2, 3))
        calls: list[tuple[str, Callable[[], object]]] = [
            ("2 coordinates, or a third that is 0", lambda: environment.cast((40.0, 30.0, 1.0), point)),
            ("2 in the plane", lambda: environment.cast((40.0,), point)),
            ("2 in the plane", lambda: environment.locate(40.0)),
            ("2 coordinates, not 3", lambda: environment.cast_segments(wide, wide)),
            ("2 coordinates, not 3", lambda: environment.sweep_edges([point], [point], np.zeros((1, 3)))),
            ("2 coordinates, not 3", lambda: environment.locate_points(wide)),
            ("2 coordinates, not 3", lambda: environment.cut(wide)),
            ("2 coordinates, not 3", lambda: environment.tie(wide)),
            ("2 coordinates, not 3", lambda: environment.carve(wide, [(0, 1)])),
            ("shape (n, 2)", lambda: environment.carve([point] * 3, [(0, 1, 2)] * 2)),
            ("shape (n, 2)", lambda: scene.create_body([point] * 3, [(0, 1, 2)] * 2)),
            ("2 coordinates, not 3", lambda: scene.create_particles(wide)),
            ("targets has 2 entries, not 1", lambda: scene.move_particles(particles, [point, point])),
            ("positions has 2 entries, not 1", lambda: scene.particle_positions(particles, np.zeros((2, 2)))),
            ("2 coordinates, not 3", lambda: scene.particle_positions(particles, np.zeros((1, 3)))),
            ("2 coordinates, not 3", lambda: body.positions(wide)),
            ("positions has 3 entries, not 2", lambda: body.positions(np.zeros((3, 2)))),
            ("or (n, 2) in the plane", lambda: body.positions(np.zeros(4))),
            ("target_count is 1, there are 2", lambda: body.move([point])),
            ("2 coordinates, not 3", lambda: scene.move_bodies([body.id], wide)),
            ("2 coordinates, not 3", lambda: environment.deform(np.zeros((121, 3)))),
            ("point_count is 3, the environment has 121", lambda: environment.deform(np.zeros((3, 2)))),
            ("points of the plane have shape (n, 2)", lambda: ds.Environment(np.zeros((3, 3)), [(0, 1, 2)])),
        ]
        for text, call in calls:
            with pytest.raises((ds.errors.WrongSize, ValueError, TypeError), match=re.escape(text)):
                call()


def test_what_is_written_stays_within_its_array() -> None:
    with create_plane() as environment, ds.Scene(environment) as scene:
        body = scene.create_body([(40, 30), (45, 30)], [(0, 1)])
        particles = scene.create_particles([(40, 30), (45, 35)])
        calls: list[Callable[[NDArray[np.float64]], object]] = [body.positions, lambda out: scene.particle_positions(particles, out)]
        for call in calls:
            memory = np.full((4, 2), 7.0)
            call(memory[1:3])
            assert memory[[0, 3]].tolist() == [[7, 7], [7, 7]] and memory[1].tolist() == [40, 30]


def test_what_is_of_space_alone_says_so() -> None:
    with create_plane() as environment, ds.Scene(environment) as scene:
        body = scene.create_body([(40, 30), (45, 30)], [(0, 1)])
        calls: list[Callable[[], object]] = [environment.coarsen, environment.remesh, lambda: environment.find_edges([(0, 1)])]
        calls += [lambda: environment.detach(environment.volume_id(0), 3), lambda: setattr(body, "level", ds.Level.FACES)]
        for call in calls:
            with pytest.raises(ds.errors.Unsupported, match="in the plane"):
                call()
        with pytest.raises(ValueError, match="in the plane"):
            ds.meshes.to_trimesh(body)


def test_polygons() -> None:
    corners = [(0, 0), (2, 0), (3, 1), (2, 2), (0, 2)]
    with ds.Environment(corners, [range(5)]) as environment:
        assert environment.volume_counts(environment.volume_id(0)).type == ds.CellType.POLYGON
        (added,) = environment.add_volumes([environment.vertex_id(0), environment.vertex_id(1)], [(2, -1), (1, -2), (0, -1)], [(0, 4, 3, 2, 1)])
        assert environment.volume_counts(added).faces == 5
    with pytest.raises(ds.errors.BadCellType):
        ds.Environment(corners, [0, 1, 2, 3], [ds.CellType.TETRA], [0, 4])


def test_bodies_meet_marked_vertices() -> None:
    with create_plane() as environment, ds.Scene(environment) as scene:
        pole = environment.vertex_position(environment.vertex_id(60))
        environment.mark_vertices([environment.vertex_id(60)])
        body = scene.create_body([pole - (3, 2), pole - (-3, 2)], [(0, 1)])
        report = body.move(body.positions() + (0, 4))
        contact = body.contacts()[0]
        assert report.vertices_stopped > 0 and contact["contact"]["obstacle"]["kind"] == ds.CellKind.VERTEX
        assert contact["point"].tolist() == [*pole, 0.0]
        volume = body.volumes()[0]
        assert scene.particle_position(scene.create_particle(body.positions()[0], volume))[0].tolist() == body.positions()[0].tolist()
        assert body.move_rigid((0.0, -1.0)).fraction == 1.0
        with pytest.raises(ds.Error):
            scene.create_body([pole - (3, 2), pole - (-3, 2), pole - (0, 3)], triangles=[(0, 1, 2)])


def test_walls_move() -> None:
    with square() as environment, ds.Scene(environment, ds.Feature.DEFORMING) as scene:
        body = scene.create_body([(0.25, 0.25), (0.75, 0.25)], [(0, 1)])
        positions = environment.points() * (1.0, 0.5) + (0.0, 0.375)
        environment.deform(positions)
        assert np.array_equal(environment.points(), positions) and np.all(body.positions()[:, 1] > 0.375)
        with pytest.raises(ds.errors.WrongSize):
            environment.deform(np.zeros((4, 3)))


def test_cuts_and_shapes() -> None:
    with create_plane() as environment:
        change = environment.cut([(20.0, 20.5), (60.0, 41.25)])
        assert len(change.faces) > 0 and change.volumes_split > 0
    with create_plane() as environment:
        environment.mark_region(1)
        carved = environment.carve([(30.0, 30.0), (50.0, 31.0), (40.0, 50.0)], [(0, 1), (1, 2), (2, 0)])
        assert len(carved.carved) > 0 and not any(environment.is_impassable(volume) for volume in carved.carved)


def test_sides_are_split_as_edges() -> None:
    with square() as environment:
        side = environment.face_id(environment.volume_id(0), 1)
        with pytest.raises(TypeError):
            environment.split_edge(side)
        vertex, first, _ = environment.split_edge(ds.EdgeId(side.volume, side.generation, side.local), 0.25)
        assert environment.vertex_position(vertex).tolist() == [1.0, 0.25] and environment.volume_counts(environment.volume_id(0)).vertices == 4
        environment.merge_edges(first, vertex)
        assert environment.volume_counts(environment.volume_id(0)).vertices == 3


def test_snapshots_and_copies(tmp_path: object) -> None:
    with create_plane() as environment, ds.Scene(environment) as scene:
        rope = scene.create_body([(20.0, 40.0), (25.0, 40.0)], [(0, 1)])
        both = copy.deepcopy(scene)
        assert both.environment.dimension == 2
        again = both.body(rope.id)
        assert rope.move([(20.0, 90.0), (25.0, 90.0)]).contact_count == again.move([(20.0, 90.0), (25.0, 90.0)]).contact_count
        assert np.array_equal(rope.positions(), again.positions())


def test_bug_reports(tmp_path: object) -> None:
    with create_plane() as environment, ds.Scene(environment) as scene:
        with scene.recording(f"{tmp_path}/calls"):
            scene.create_body([(20.0, 40.0), (25.0, 40.0)], [(0, 1)]).move([(20.0, 90.0), (25.0, 90.0)])
            validation = scene.write_bug_report(f"{tmp_path}/report")
    assert validation.is_right == 1 and validation.contacts > 0 and validation.missed == 0


def test_traces_have_segments() -> None:
    with square() as environment:
        trace = ds.Trace()
        trace.add_impassable(environment)
        assert len(trace.segments[0]) == 4 and len(trace.triangles[0]) == 0
        assert trace.points.shape == (4, 3) and not trace.points[:, 2].any()


def test_meshes_of_meshio() -> None:
    triangles = [("line", [[0, 1]]), ("triangle", [[0, 1, 2], [0, 2, 3]])]
    data = {"region": [np.array([9]), np.array([1, 2])]}
    for points in (SQUARE, [(*point, 0.0) for point in SQUARE]):
        with ds.from_meshio(meshio.Mesh(points, triangles, cell_data=data)) as environment:
            assert environment.dimension == 2 and environment.info.volume_count == 2
            assert environment.region(environment.volume_id(1)) == 2
    with ds.from_meshio(meshio.Mesh(SQUARE, [("triangle6", [[0, 1, 2, 0, 1, 2]])])) as environment:
        assert "taken by their corners" in environment.notes[0]
    with ds.from_meshio(meshio.Mesh([(*point, 1.0) for point in SQUARE], triangles)) as environment:
        assert environment.dimension == 2 and environment.notes == ("the mesh lies in the plane z = 1; its coordinates are x and y",)
