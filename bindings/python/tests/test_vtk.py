"""Filters of VTK: cells of points by rational arithmetic, segments and walls, and what becomes of meshes that change or are none."""

from __future__ import annotations

import importlib.util
import pathlib
import sys
import types
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import pyvista
from numpy.typing import NDArray
from vtkmodules.vtkCommonCore import vtkOutputWindow

import dartsweep as ds
from dartsweep import plot
from dartsweep import vtk as exact


def hexahedra(n: int = 3) -> pyvista.UnstructuredGrid:
    return pyvista.ImageData(dimensions=(n + 1,) * 3).cast_to_unstructured_grid()


def wedges(n: int = 3) -> pyvista.UnstructuredGrid:
    """Two in each voxel, in the order of the installed VTK."""
    grid = hexahedra(n)
    corners = grid.cells.reshape(-1, 9)[:, 1:]
    both = np.concatenate([corners[:, [0, 1, 3, 4, 5, 7]], corners[:, [0, 3, 2, 4, 7, 6]]])
    made = pyvista.UnstructuredGrid({pyvista.CellType.WEDGE: both}, grid.points)
    return made if made.compute_cell_sizes()["Volume"][0] > 0 else pyvista.UnstructuredGrid({pyvista.CellType.WEDGE: both[:, [3, 4, 5, 0, 1, 2]]}, grid.points)


def polyhedra() -> pyvista.UnstructuredGrid:
    """Hexahedra of which a blade cuts some."""
    with ds.from_pyvista(hexahedra()) as environment:
        environment.cut([[(-1.0, -1.0, 0.75), (-1.0, 4.0, 0.75)], [(4.0, -1.0, 2.25), (4.0, 4.0, 2.25)]])
        return plot.grid(environment)


def apart(grid: pyvista.UnstructuredGrid, cell: int, point: NDArray[np.float64]) -> bool:
    """Whether a point lies beyond a face of a convex cell, by rational arithmetic."""
    exactly = [[Fraction(float(x)) for x in row] for row in grid.get_cell(cell).points]
    middle = [sum(column) / len(exactly) for column in zip(*exactly)]
    for face in grid.get_cell(cell).faces:
        a, b, c = ([Fraction(float(x)) for x in face.points[i]] for i in range(3))

        def side(p: Any) -> Fraction:
            u, v, w = ([x - y for x, y in zip(q, a)] for q in (b, c, p))
            found: Fraction = w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0])
            return found

        if side([Fraction(float(x)) for x in point]) * side(middle) < 0:
            return True
    return False


def locate(grid: Any, points: Any, **options: Any) -> NDArray[np.int64]:
    made = exact.LocateCells(**options)
    made.SetInputDataObject(0, grid)
    made.SetInputDataObject(1, pyvista.PolyData(np.asarray(points)))
    made.Update()
    return np.asarray(pyvista.wrap(made.GetOutputDataObject(0))["CellId"])


@pytest.mark.parametrize("make", [hexahedra, wedges, polyhedra, lambda: hexahedra(2).triangulate()])
def test_cells_of_points(make: Any) -> None:
    grid, random = make(), np.random.default_rng(7)
    corners = grid.points[random.integers(0, grid.n_points, (2, 60))].astype(np.float64)
    points = np.concatenate([3 * random.random((100, 3)), corners[0], (corners[0] + corners[1]) / 2, 3 * random.random((20, 3)) + (3.5, 0, 0)])
    found = locate(grid, points)
    assert np.array_equal(found < 0, (points < grid.bounds[0::2]).any(axis=1) | (points > grid.bounds[1::2]).any(axis=1))
    for cell, point in zip(found, points):
        assert cell < 0 or not apart(grid, cell, point)


def test_cells_that_are_not_flat() -> None:
    """They are triangles about the means of their faces, and every point lies in one."""
    grid, random = hexahedra(4), np.random.default_rng(8)
    inner = np.all((grid.points > 0) & (grid.points < 4), axis=1)
    grid.points = grid.points.astype(np.float64)
    grid.points[inner] += 0.3 * random.random((int(inner.sum()), 3))
    points = np.concatenate([4 * random.random((500, 3)), grid.points])
    found, mesh = locate(grid, points), exact.Mesh(grid)
    assert np.all(found >= 0)
    for cell, point in zip(found, points):
        mesh.environment.classify(point, mesh.environment.volume_id(int(cell)))  # raises Outside


def test_cells_keep_the_numbers_of_the_input() -> None:
    """Though the mesh has other cells, too, and some are split or left out."""
    corner = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)]
    points = np.array(corner + [(x, y, 1) for x, y, _ in corner], np.float64)
    ell = [8, 6, *range(5, -1, -1), 6, *range(6, 12), *(k for i in range(6) for k in (4, i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i))]
    cells = [3, 0, 1, 2, len(ell), *ell]
    grid = pyvista.UnstructuredGrid(np.array(cells), np.array([5, 42], np.uint8), points)
    assert locate(grid, [(0.5, 0.5, 0.5), (1.5, 0.5, 0.5), (0.5, 1.5, 0.5), (1.5, 1.5, 0.5)]).tolist() == [1, 1, 1, -1]


def test_segments_and_nearest_walls() -> None:
    lines = pyvista.PolyData(np.array([(0.5, 0.5, 0.5), (2.5, 0.5, 0.5), (2.5, 0.5, 4.5), (-1, 0, 0), (1, 1, 1)], np.float64))
    lines.lines = [3, 0, 1, 2, 2, 3, 4]
    casts = exact.CastSegments()
    casts.SetInputDataObject(0, hexahedra())
    casts.SetInputDataObject(1, lines)
    casts.Update()
    ends = pyvista.wrap(casts.GetOutputDataObject(0))
    assert ends["Hit"].tolist() == [0, 1, -1] and ends["LineId"].tolist() == [5, 5, 6] and ends["CellId"].tolist() == [2, 20, -1]
    assert np.array_equal(ends.points[:2], [(2.5, 0.5, 0.5), (2.5, 0.5, 3)]) and ends["Time"][1] == 0.625
    assert np.array_equal(ends["Normal"][1], (0, 0, -1))

    places = pyvista.PolyData(np.array([(1.5, 1.25, 0.75), (3.0, 1.5, 1.5), (9.0, 9.0, 9.0)]))
    places["name"] = [7, 8, 9]
    walls = exact.FindNearestWalls()
    walls.SetInputDataObject(0, hexahedra())
    walls.SetInputDataObject(1, places)
    walls.Update()
    near = pyvista.wrap(walls.GetOutputDataObject(0))
    assert near["Distance"].tolist() == [0.75, 0, np.inf] and near["CellId"].tolist() == [4, 14, -1] and near["name"].tolist() == [7, 8, 9]
    assert np.array_equal(near["Nearest"][0], (1.5, 1.25, 0)) and np.array_equal(near["Normal"][0], (0, 0, 1))


def test_a_mesh_that_changes_or_is_none() -> None:
    grid, points = hexahedra(1), pyvista.PolyData(np.array([(1.5, 0.5, 0.5)]))
    made = exact.LocateCells()
    made.SetInputDataObject(0, grid)
    made.SetInputDataObject(1, points)
    made.Update()
    kept = made._kept
    assert pyvista.wrap(made.GetOutputDataObject(0))["CellId"].tolist() == [-1]
    points.points[0] = (0.5, 0.5, 0.5)
    points.Modified()
    made.Update()
    assert made._kept is kept and pyvista.wrap(made.GetOutputDataObject(0))["CellId"].tolist() == [0]
    grid.points = grid.points + np.array((5.0, 0, 0), np.float32)
    made.Update()
    assert pyvista.wrap(made.GetOutputDataObject(0))["CellId"].tolist() == [-1]

    said: list[str] = []
    window: Any = vtkOutputWindow.GetInstance()
    number = window.AddObserver("ErrorEvent", lambda *_: said.append("told"))
    made.SetInputDataObject(0, pyvista.Sphere())
    made.Update()
    window.RemoveObserver(number)
    assert said and pyvista.wrap(made.GetOutputDataObject(0)).n_points == 0
    with pytest.raises(ds.MeshError, match="no volumes"):
        exact.Mesh(pyvista.Sphere())


def test_options_of_parts_that_touch() -> None:
    two = pyvista.merge([hexahedra(1), hexahedra(1).translate((1, 0, 0))], merge_points=False)
    with pytest.raises(ds.MeshError, match="lie on"):
        exact.Mesh(two)
    assert locate(two, [(0.5, 0.5, 0.5), (1.5, 0.5, 0.5)], inner_walls=True).tolist() == [0, 1]
    assert exact.Mesh(two, merge_points=0.0).environment.cast((0.5, 0.5, 0.5), (1.5, 0.5, 0.5)).outcome == ds.Outcome.REACHED


def test_plugin_of_paraview(monkeypatch: pytest.MonkeyPatch) -> None:
    """ParaView's decorators are stood in for: a property is called by the name of its function, and a function is one property."""
    commands: dict[Any, str] = {}

    class Decorators:
        def __getattr__(self, name: str) -> Any:
            return lambda *given, **named: lambda made: self.note(name, made)

        def note(self, name: str, made: Any) -> Any:
            if name.endswith("vector"):
                assert made not in commands
                commands[made] = made.__name__
            return made

    module = types.ModuleType("paraview.util.vtkAlgorithm")
    for name in ("smproxy", "smproperty", "smdomain", "smhint"):
        setattr(module, name, Decorators())
    for name, each in (("paraview", types.ModuleType("paraview")), ("paraview.util", types.ModuleType("paraview.util")), (module.__name__, module)):
        monkeypatch.setitem(sys.modules, name, each)
    path = pathlib.Path(ds.__file__).with_name("paraview_plugin.py")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None and spec.loader is not None
    plugin = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(plugin)
    for made in (plugin.DartsweepLocateCells, plugin.DartsweepCastSegments, plugin.DartsweepFindNearestWalls):
        for name in ("SetConform", "SetInnerWalls", "SetMergeDistance"):
            assert commands[vars(made)[name]] == name
    found = plugin.DartsweepLocateCells()
    found.SetInputDataObject(0, pyvista.merge([hexahedra(1), hexahedra(1).translate((1, 0, 0))], merge_points=False))
    found.SetInputDataObject(1, pyvista.PolyData(np.array([(1.5, 0.5, 0.5)])))
    found.SetInnerWalls(1)
    found.Update()
    assert pyvista.wrap(found.GetOutputDataObject(0))["CellId"].tolist() == [1]
