"""Meshes that PyVista draws, and one picture where there is something to draw with."""

from __future__ import annotations

import pathlib

import numpy as np
import pytest
import pyvista

import dartsweep as ds
from dartsweep import plot
from scenario import create_catheter, create_plane, vessel


@pytest.fixture
def catheter(scene: ds.Scene) -> ds.Body:
    """Pressed against the wall."""
    made = create_catheter(scene)
    made.move(made.positions() + (30, 0, 0))
    assert len(made.contacts()) > 0
    return made


def test_grid_of_an_environment(environment: ds.Environment) -> None:
    points, cells, regions = vessel()
    grid = plot.grid(environment)
    assert np.array_equal(grid.points, points) and np.array_equal(grid.cells_dict[pyvista.CellType.HEXAHEDRON], cells)
    assert np.array_equal(grid.cell_data["region"], regions) and np.array_equal(grid.cell_data["impassable"], regions == 2)
    assert np.all(grid.compute_cell_sizes().cell_data["Volume"] > 0)


def test_grid_after_a_cut(environment: ds.Environment) -> None:
    before = plot.grid(environment).volume
    environment.cut([[(-9.0, -9.0, 21.0), (-9.0, 99.0, 42.0)], [(60.0, -9.0, 60.0), (60.0, 99.0, 81.0)]])
    grid = plot.grid(environment)
    assert grid.n_cells == environment.info.volume_count > len(vessel()[1])
    assert pyvista.CellType.POLYHEDRON in grid.celltypes and ds.CellType.POLYHEDRON == pyvista.CellType.POLYHEDRON
    assert grid.volume == pytest.approx(before, rel=1e-2)  # VTK cuts warped faces otherwise
    environment.remove_volumes([environment.volume_id(int(grid.cell_data["volume"][0]))])
    assert plot.grid(environment).n_cells == grid.n_cells - 1


def test_walls(environment: ds.Environment) -> None:
    lumen, all_walls = plot.walls(environment, with_boundary=False), plot.walls(environment)
    assert lumen.is_all_triangles and 0 < lumen.n_cells < all_walls.n_cells


def test_contacts_with_normals(catheter: ds.Body) -> None:
    told = catheter.contacts()
    points = plot.contacts(told)
    assert np.array_equal(points.points, told["point"]) and np.array_equal(points.point_data["normal"], told["contact"]["normal"])
    assert np.all(points.point_data["time"] < 1)
    assert plot.contacts(told[:0]).n_points == 0


def test_bodies(scene: ds.Scene, catheter: ds.Body) -> None:
    lines = plot.body(catheter)
    assert lines.n_lines == 11 and np.array_equal(lines.points, catheter.positions())
    catheter.remove_edge(catheter.edge_ids()[0])
    assert plot.body(catheter).n_lines == 10
    triangle = scene.create_body([(24, 24, 60), (26, 24, 60), (24, 26, 60)], triangles=[(0, 1, 2)])
    assert plot.body(triangle).n_cells == 1 and plot.body(triangle).is_all_triangles


def test_the_plane(tmp_path: pathlib.Path) -> None:
    with create_plane() as environment, ds.Scene(environment) as scene:
        environment.mark_region(2)
        grid = plot.grid(environment)
        assert np.array_equal(grid.points[:, :2], environment.points()) and not grid.points[:, 2].any()
        assert sorted(set(grid.celltypes)) == [pyvista.CellType.TRIANGLE, pyvista.CellType.QUAD]
        assert np.count_nonzero(grid.cell_data["impassable"]) == np.count_nonzero(grid.cell_data["region"] == 2) > 0
        walls = plot.walls(environment)
        assert walls.n_lines == walls.n_cells == 32  # round 8 x 8 squares
        rope = scene.create_body([(30, 40), (50, 40)], [(0, 1)])
        rope.move(rope.positions() + (0, 60))
        lines = plot.body(rope)
        assert lines.n_lines == 1 and np.array_equal(lines.points[:, :2], rope.positions())
        assert np.array_equal(plot.contacts(rope.contacts()).points, rope.contacts()["point"])
        if pyvista.system_supports_plotting():
            plotter = plot.draw(scene, pyvista.Plotter(off_screen=True, window_size=(200, 200)))
            seen = np.subtract(plotter.camera.position, plotter.camera.focal_point)
            assert seen[2] > 0 and np.allclose(seen[:2], 0) and len(plotter.actors) >= 4
            assert plotter.screenshot(tmp_path / "plane.png", return_img=True).std() > 1


def test_a_picture(scene: ds.Scene, catheter: ds.Body, tmp_path: pathlib.Path) -> None:
    if not pyvista.system_supports_plotting():
        pytest.skip("nothing here draws without a display: install libosmesa6")
    plotter = plot.draw(scene, pyvista.Plotter(off_screen=True, window_size=(200, 200)))
    assert len(plotter.actors) >= 4  # walls, catheter, contacts, their normals
    picture = plotter.screenshot(tmp_path / "scene.png", return_img=True)
    assert picture.shape == (200, 200, 3) and picture.std() > 1
