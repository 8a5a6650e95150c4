"""Meshes of meshio and trimesh, as these libraries make them."""

from __future__ import annotations

import pathlib

import meshio
import numpy as np
import pytest
import trimesh

import dartsweep as ds
from scenario import vessel


def test_meshes_of_meshio() -> None:
    points, cells, regions = vessel()
    tetra = [[0, 1, 2, 3]]
    extra = np.array([[100.0, 0, 0], [101, 0, 0], [100, 1, 0], [100, 0, 1]])
    mesh = meshio.Mesh(
        np.concatenate([points, extra]),
        [("hexahedron", cells), ("triangle", [[0, 1, 2]]), ("tetra", np.array(tetra) + len(points))],
        cell_data={"region": [regions, np.array([9]), np.array([3])]},
    )
    with ds.from_meshio(mesh) as environment:
        assert environment.info.volume_count == len(cells) + 1 and environment.info.part_count == 2
        assert environment.region(environment.volume_id(len(cells))) == 3
        assert environment.volume_counts(environment.volume_id(len(cells))).type == ds.CellType.TETRA
        assert environment.mark_region(2)[0] == int(np.sum(regions == 2))
    with pytest.raises(ds.MeshError, match="it has 1 lines and points, but no cells that fill space or the plane"):
        ds.from_meshio(meshio.Mesh(points, [("line", [[0, 1]])]))


def test_meshes_of_files(tmp_path: pathlib.Path) -> None:
    points, cells, regions = vessel()
    path = str(tmp_path / "vessel.vtu")
    meshio.write(path, meshio.Mesh(points, [("hexahedron", cells)], cell_data={"layer": [regions]}))
    with ds.meshes.read(path, regions="layer") as environment:
        assert environment.info.volume_count == len(cells)
        assert environment.region(environment.volume_id(0)) == regions[0]


def test_planar_meshes_of_files(tmp_path: pathlib.Path) -> None:
    points = [(0, 0, 0), (2, 0, 0), (3, 1, 0), (2, 2, 0), (0, 2, 0), (-2, 0, 0), (-2, 2, 0), (-3, 1, 0)]
    cells = [("line", [[0, 1]]), ("polygon", [[0, 1, 2, 3, 4]]), ("quad", [[5, 0, 4, 6]]), ("triangle", [[7, 5, 6]])]
    path = str(tmp_path / "floor.vtu")
    meshio.write(path, meshio.Mesh(points, cells, cell_data={"region": [[9], [1], [2], [3]]}))
    with ds.meshes.read(path) as environment:
        assert environment.dimension == 2 and np.array_equal(environment.points(), np.array(points)[:, :2])
        volumes = [environment.volume_id(i) for i in range(environment.info.volume_count)]
        assert [environment.volume_counts(volume).vertices for volume in volumes] == [5, 4, 3]
        assert [environment.region(volume) for volume in volumes] == [1, 2, 3]
        assert environment.cast((1, 1), (1, 9)).time == 0.125


def test_bodies_of_trimesh(scene: ds.Scene) -> None:
    ball = trimesh.creation.icosphere(subdivisions=2, radius=2.0)
    ball.apply_translation((24, 24, 48))
    body = ds.meshes.body_from_trimesh(scene, ball, level=ds.Level.FACES)
    assert body.counts.vertex_count == len(ball.vertices) and body.counts.face_count == len(ball.faces)
    report = body.move_rigid(translation=(0, 0, 4))
    moved = ds.meshes.to_trimesh(body)
    assert report.fraction == 1 and moved.is_watertight
    assert moved.volume == pytest.approx(ball.volume) and np.allclose(moved.vertices - ball.vertices, (0, 0, 4))
    body.remove_face(body.face_ids()[3])
    assert len(ds.meshes.to_trimesh(body).faces) == len(ball.faces) - 1


def test_carving_with_trimesh(environment: ds.Environment) -> None:
    def walls() -> trimesh.Trimesh:
        trace = ds.Trace()
        trace.add_impassable(environment, with_boundary=False)
        return ds.meshes.to_trimesh(trace)

    before = walls()
    drill = trimesh.creation.box((6.0, 6.0, 6.0))
    drill.apply_translation((4, 28, 52))  # in the wall, which is marked
    change = ds.meshes.carve_trimesh(environment, drill)
    assert len(change.carved) > 0 and not any(environment.is_impassable(volume) for volume in change.carved)
    assert walls().area > before.area
    with pytest.raises(ds.errors.BadTopology, match="closed"):
        ds.meshes.carve_trimesh(environment, trimesh.Trimesh(drill.vertices, drill.faces[1:]))
