"""A plugin of ParaView: the filters of dartsweep.vtk in its menu Filters > Dartsweep.

Install dartsweep for ParaView's Python, and load this file by Tools > Manage Plugins > Load New. ParaView gives the module
paraview.util.vtkAlgorithm, so nothing else can import this file. ParaView finds properties in a class itself, not in its bases, and
registers this file under its name without the folder.
"""

from __future__ import annotations

from typing import Any

from dartsweep import vtk
from paraview.util.vtkAlgorithm import smdomain, smhint, smproperty, smproxy

_MENU = smhint.xml('<ShowInMenu category="Dartsweep"/>')


def _mesh(made: Any) -> Any:
    return smproperty.input(name="Mesh", port_index=0)(smdomain.datatype(dataTypes=["vtkDataSet"], composite_data_supported=False)(made))


def _places(kind: str, name: str) -> Any:
    return lambda made: smproperty.input(name=name, port_index=1)(smdomain.datatype(dataTypes=[kind], composite_data_supported=False)(made))


def _with_options(made: Any) -> Any:
    """Properties that all filters have. ParaView calls a property by the name of its function, and takes each function once."""

    def SetConform(self: Any, on: int) -> None:
        """Whether faces that lie on faces of other cells are sewn to them."""
        self.set_option("conform", bool(on))

    def SetInnerWalls(self: Any, on: int) -> None:
        """Whether such faces are walls; else they are an error, where they are not sewn."""
        self.set_option("inner_walls", bool(on))

    def SetMergeDistance(self: Any, distance: float) -> None:
        """Points that lie within this distance count as one; a negative one leaves all as they are."""
        self.set_option("merge_points", None if distance < 0 else distance)

    switch = smdomain.xml('<BooleanDomain name="bool"/>')
    made.SetConform = smproperty.intvector(name="Conform", default_values=0)(switch(SetConform))
    made.SetInnerWalls = smproperty.intvector(name="InnerWalls", default_values=0)(switch(SetInnerWalls))
    made.SetMergeDistance = smproperty.doublevector(name="MergeDistance", default_values=-1.0)(SetMergeDistance)
    return made


@smproxy.filter(name="DartsweepLocateCells", label="Locate Cells")
@_MENU
@_places("vtkDataSet", "Points")
@_mesh
@_with_options
class DartsweepLocateCells(vtk.LocateCells):
    """The cell of a mesh that contains each point."""


@smproxy.filter(name="DartsweepCastSegments", label="Cast Segments")
@_MENU
@_places("vtkPolyData", "Lines")
@_mesh
@_with_options
class DartsweepCastSegments(vtk.CastSegments):
    """Where lines in a mesh meet its boundary."""


@smproxy.filter(name="DartsweepFindNearestWalls", label="Find Nearest Walls")
@_MENU
@_places("vtkDataSet", "Points")
@_mesh
@_with_options
class DartsweepFindNearestWalls(vtk.FindNearestWalls):
    """The nearest place of the boundary of a mesh from each point."""
