"""Filters of VTK (the extra `vtk`) that are exact: which cell of a mesh holds a point, what a segment meets, which wall is nearest.

A filter has a mesh of volumes at its first input and the places that it is asked for at its second one. Cells of the answers are those of
the first input, by their index. VTK's own locators find the cell of a point by rounded formulas, and take a polyhedron for its bounding
box; here a point lies in exactly one cell of those that touch it. Faces that are not flat are triangles about their means, as everywhere
in Dartsweep; VTK's cells curve them otherwise. paraview_plugin.py makes filters of ParaView of these.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData

from . import dtypes
from ._door import build, own, plane, vtk_data
from ._door.raw import mesh_of
from .enums import Location, Outcome
from .environment import Environment
from .errors import MeshError

_CELLS = "CellId"


class Mesh:
    """An environment of the volumes of a data set. `cells` gives the cell of the data set that a volume is, or that it is a part of.

    data: a vtkDataSet with volumes; its other cells are left out. options: as of from_pyvista; walls between parts that lie on each other
    are as for Environment. Errors: as of from_pyvista, and MeshError for a mesh of the plane or a surface.
    """

    def __init__(self, data: Any, **options: Any) -> None:
        numbered = data.NewInstance()
        numbered.ShallowCopy(data)
        numbered.GetCellData().AddArray(_ids(own.INPUT, np.arange(data.GetNumberOfCells())))
        mesh = mesh_of(vtk_data.raw_of(numbered, "the data set", "VTK"), options.pop("quadratic", "corners"))
        if plane.is_of_surface(mesh):
            raise MeshError(mesh.source, "it has no volumes", "these filters take meshes of volumes")
        self.environment: Environment = build.environment_of(mesh, options.pop("regions", None), options)
        self._cells = mesh.cell_data[own.INPUT].astype(np.int64)
        report = self.environment._core.build_report()
        if report.split_count or self.environment.info.volume_index_count != len(self._cells):
            self._cells = np.array([self.environment.tag(volume) for volume in own.volumes_of(self.environment)], np.int64)

    def cells(self, volumes: Any) -> NDArray[np.int64]:
        """Cells of the data set by ids of volumes; -1 for null ids."""
        found: NDArray[np.int64] = self._cells[volumes["index"]]
        found[volumes["generation"] == 0] = -1
        return found

    def locate(self, points: Any) -> NDArray[np.int64]:
        """The cell that contains each point of (n, 3), boundary included; -1 outside. On a common boundary it is one of the cells that
        touch the point, always the same one."""
        volumes, locations = self.environment.locate_points(points)
        cells = self.cells(volumes)
        outside = np.flatnonzero(locations == Location.OUTSIDE)  # by the shift that decides ties, a point of the boundary may be
        if len(outside):
            places = np.asarray(points, np.float64)[outside]
            touching = self.environment.find_nearest_to_points(places, 0.0)["distance"] == 0
            beside = np.empty(int(np.count_nonzero(touching)), dtypes.VOLUME_ID)
            self.environment.inside(places[touching], volumes=beside)
            cells[outside[touching]] = self.cells(beside)
        return cells


class _Filter(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """A mesh at port 0, of which the environment is kept until it changes, and places at port 1."""

    places = "vtkDataSet"

    def __init__(self, **options: Any) -> None:
        """options: as of Mesh."""
        super().__init__(nInputPorts=2, nOutputPorts=1, outputType="vtkPolyData")
        self._options = options
        self._kept: tuple[Any, int, Mesh] | None = None

    def set_option(self, name: str, value: Any) -> None:
        """Sets an option of Mesh; the environment is made again if that changes it."""
        if self._options.get(name) != value:
            self._options[name] = value
            self._kept = None
            self.Modified()

    def FillInputPortInformation(self, port: int, info: Any) -> int:
        """What VTK asks: the kinds of the inputs."""
        info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet" if port == 0 else self.places)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """What VTK asks: the output."""
        data, places = (vtkDataObject.GetData(inputs[port], 0) for port in (0, 1))
        try:
            if self._kept is None or self._kept[0] is not data or self._kept[1] != data.GetMTime():
                self._kept = None  # first, since its memory may be needed
                self._kept = (data, data.GetMTime(), Mesh(data, **self._options))
            self.answer(self._kept[2], places, vtkDataObject.GetData(outputs, 0))
        except Exception as error:  # VTK goes on, and would not say why the output is empty
            vtkOutputWindow.GetInstance().DisplayErrorText(f"{type(self).__name__}: {error}\n")
            return 0
        return 1

    def answer(self, mesh: Mesh, places: Any, output: Any) -> None:
        """Fills the output."""
        raise NotImplementedError


class LocateCells(_Filter):
    """Points of the second input as vertices, with `CellId`: the cell that contains each, boundary included, or -1. Arrays of the points
    are passed on."""

    def answer(self, mesh: Mesh, places: Any, output: Any) -> None:
        """Fills the output."""
        points = _points_of(places)
        _set_points(output, points)
        output.GetPointData().ShallowCopy(places.GetPointData())
        output.GetPointData().AddArray(_ids(_CELLS, mesh.locate(points)))


class CastSegments(_Filter):
    """Where segments end: each piece of a line of the second input, from its start to its end or to the first wall, which is the outer
    boundary of the mesh, or a gap between its parts.

    The output has a vertex for each segment, with `Hit` (1: a wall, 0: none, -1: the segment does not begin in the mesh), `Time` (the part of
    the segment that was gone: at a wall the largest double not later than the exact one), `Normal` (out of the wall; else 0), `CellId` (where
    it ended; -1 outside) and `LineId` (the cell of the second input).
    """

    places = "vtkPolyData"

    def answer(self, mesh: Mesh, places: Any, output: Any) -> None:
        """Fills the output."""
        lines = places.GetLines()
        offsets, corners = (vtk_to_numpy(array).astype(np.int64) for array in (lines.GetOffsetsArray(), lines.GetConnectivityArray()))
        first = np.ones(len(corners), np.bool_)
        first[offsets[1:][np.diff(offsets) > 0] - 1] = False  # the last point of a line begins no segment
        begin = np.flatnonzero(first)
        points = _points_of(places)
        flights = mesh.environment.cast_segments(points[corners[begin]], points[corners[begin + 1]])
        _set_points(output, flights["position"])
        hit = np.where(flights["outcome"] == Outcome.CONTACT, 1, np.where(flights["outcome"] == Outcome.REACHED, 0, -1))
        line = places.GetNumberOfVerts() + np.repeat(np.arange(len(offsets) - 1), np.maximum(np.diff(offsets) - 1, 0))
        answers = output.GetPointData()
        answers.AddArray(_named("Hit", hit.astype(np.int8)))
        answers.AddArray(_named("Time", flights["time"]))
        answers.AddArray(_named("Normal", flights["contact"]["normal"]))
        answers.AddArray(_ids(_CELLS, mesh.cells(flights["volume"])))
        answers.AddArray(_ids("LineId", line))


class FindNearestWalls(_Filter):
    """Points of the second input as vertices, with `Distance` to the nearest wall that can be seen from each (infinite outside of the mesh),
    `Nearest` (its place), `Normal` (towards the point) and `CellId` (the cell that contains the point, or -1). Arrays of the points are passed on."""

    def answer(self, mesh: Mesh, places: Any, output: Any) -> None:
        """Fills the output."""
        points = _points_of(places)
        nearest = mesh.environment.find_nearest_to_points(points)
        _set_points(output, points)
        answers = output.GetPointData()
        answers.ShallowCopy(places.GetPointData())
        for name, member in (("Distance", "distance"), ("Nearest", "point"), ("Normal", "normal")):
            answers.AddArray(_named(name, nearest[member]))
        answers.AddArray(_ids(_CELLS, mesh.locate(points)))


def _points_of(data: Any) -> NDArray[np.float64]:
    points = data.GetPoints() if data.IsA("vtkPointSet") else None
    if points is not None:
        return np.array(vtk_to_numpy(points.GetData()), np.float64)
    return np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())], np.float64).reshape(-1, 3)


def _set_points(output: vtkPolyData, places: NDArray[np.float64]) -> None:
    points, vertices = vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places), deep=True))
    count = len(places)
    vertices.SetData(_ids("", np.arange(count + 1)), _ids("", np.arange(count)))
    output.SetPoints(points)
    output.SetVerts(vertices)


def _named(name: str, values: NDArray[Any]) -> Any:
    made = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    made.SetName(name)
    return made


def _ids(name: str, values: NDArray[np.int64]) -> Any:
    made = numpy_to_vtk(np.ascontiguousarray(values, np.int64), deep=True, array_type=vtkIdTypeArray().GetDataType())
    made.SetName(name)
    return made
