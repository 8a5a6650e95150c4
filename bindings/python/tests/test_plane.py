"""The plane: points of two coordinates."""

from __future__ import annotations

import copy

import meshio
import numpy as np
import pytest

import dartsweep as ds
from scenario import create, create_plane

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def square(**options: object) -> ds.Environment:
    return ds.Environment(SQUARE, [(0, 1, 2), (0, 2, 3)], **options)  # type: ignore[arg-type]


def test_points_have_two_coordinates() -> None:
    with square() as environment:
        assert environment.dimension == environment.info.dimension == 2
        assert environment.points().tolist() == [list(point) for point in SQUARE]
        assert environment.position(environment.vertex(2)).tolist() == [1.0, 1.0]
        assert environment.centre(environment.volume(0)).shape == (2,)
        flight = environment.cast((0.5, 0.25), (0.5, 2.25))
        assert flight.time == 0.375 and flight.normal.tolist() == [0.0, -1.0, 0.0]
        # As points of structs have them.
        assert environment.cast((0.5, 0.25, 0.0), (0.5, 2.25, 0.0)).time == 0.375
        wide = np.array([(0.5, 0.25, 9.0, 9.0)])
        assert environment.cast_segments(wide[:, :2], wide[:, :2] + (0, 2))["time"] == 0.375
        for wrong in ((0.5, 0.25, 1.0), (0.5,), 0.5):
            with pytest.raises((ValueError, TypeError)):
                environment.cast(wrong, (0.5, 0.5))
        with pytest.raises(ds.errors.WrongSize, match="2 coordinates"):
            environment.cast_segments(np.zeros((4, 3)), np.zeros((4, 3)))
    with create() as space, pytest.raises(ds.errors.WrongSize, match="3 coordinates"):
        space.cast((24.0, 24.0), (24.0, 30.0))


def test_polygons() -> None:
    corners = [(0, 0), (2, 0), (3, 1), (2, 2), (0, 2)]
    with ds.Environment(corners, [range(5)]) as environment:
        assert environment.counts(environment.volume(0)).type == ds.CellType.POLYGON
        (added,) = environment.add_volumes([environment.vertex(0), environment.vertex(1)], [(2, -1), (1, -2), (0, -1)], [(0, 4, 3, 2, 1)])
        assert environment.counts(added).faces == 5
    with pytest.raises(ds.errors.BadCellType):
        ds.Environment(corners, [0, 1, 2, 3], [ds.CellType.TETRA], [0, 4])


def test_bodies_meet_marked_vertices() -> None:
    with create_plane() as environment, ds.Scene(environment) as scene:
        pole = environment.position(environment.vertex(60))
        environment.mark_vertices([environment.vertex(60)])
        body = scene.create_body([pole - (3, 2), pole - (-3, 2)], [(0, 1)])
        report = body.move(body.positions() + (0, 4))
        contact = body.contacts()[0]
        assert report.vertices_stopped > 0 and contact["obstacle"]["kind"] == ds.CellKind.VERTEX
        assert contact["point"].tolist() == [*pole, 0.0]
        volume = body.volumes()[0]
        assert scene.particle(scene.create_particle(body.positions()[0], volume))[0].tolist() == body.positions()[0].tolist()
        assert body.move_rigid((0.0, -1.0)).fraction == 1.0
        with pytest.raises(ds.Error):
            scene.create_body([pole - (3, 2), pole - (-3, 2), pole - (0, 3)], triangles=[(0, 1, 2)])


def test_walls_move() -> None:
    with square() as environment, ds.Scene(environment, ds.Feature.DEFORMING) as scene:
        body = scene.create_body([(0.25, 0.25), (0.75, 0.25)], [(0, 1)])
        positions = environment.points() * (1.0, 0.5) + (0.0, 0.375)
        scene.deform(positions)
        assert np.array_equal(environment.points(), positions) and np.all(body.positions()[:, 1] > 0.375)
        with pytest.raises(ds.errors.WrongSize):
            scene.deform(np.zeros((4, 3)))


def test_cuts_and_shapes() -> None:
    with create_plane() as environment:
        report = environment.cut([(20.0, 20.5), (60.0, 41.25)])
        assert report.face_count > 0 and report.volumes_split > 0
    with create_plane() as environment:
        environment.mark_region(1)
        carved = environment.carve([(30.0, 30.0), (50.0, 31.0), (40.0, 50.0)], [(0, 1), (1, 2), (2, 0)])
        assert carved.volumes_carved > 0 and len(environment.carved_volumes()) == carved.volumes_carved


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
            verdict = scene.write_bundle(f"{tmp_path}/report")
    assert verdict.is_right == 1 and verdict.contacts > 0 and verdict.missed == 0


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
            assert environment.region(environment.volume(1)) == 2
    with pytest.raises(ValueError, match="triangle6"):
        ds.from_meshio(meshio.Mesh(SQUARE, [("triangle6", [[0, 1, 2, 0, 1, 2]])]))
    with pytest.raises(ValueError, match="no volume cells"):
        ds.from_meshio(meshio.Mesh([(*point, 1.0) for point in SQUARE], triangles))
