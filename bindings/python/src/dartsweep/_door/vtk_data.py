"""Data sets of VTK and PyVista. Wedges: VTK 9.7.0 turned its order over; arrays are read in the order of the VTK that is installed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from . import blocks, polyhedra
from .linear import Cells
from .mesh import Indices
from .ragged import offsets_of, positions, take
from .raw import Raw

_TURNED = {  # wedges of VTK before 9.7 in the order of Gmsh
    13: [0, 2, 1, 3, 5, 4],
    26: [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13],
    31: [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9],
    32: [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15],
}
_HIDDEN, _DUPLICATE = 32, 1
_GHOSTS = "vtkGhostType"


def wedges_are_as_in_gmsh() -> bool:
    """Whether wedges of the installed VTK have 3, 4 and 5 on the side to which 0, 1 and 2 turn counter-clockwise: since 9.7."""
    from vtkmodules.vtkCommonCore import vtkVersion

    return (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 7)


def wedge(corners: NDArray[Any]) -> NDArray[Any]:
    """A wedge of Environment in the order of the installed VTK."""
    return corners[_TURNED[13]] if wedges_are_as_in_gmsh() else corners


def raw_of(data: Any, source: str, reader: str, wedges_as_in_gmsh: bool | None = None) -> Raw:
    """Cells of any data set, or of all blocks of one. wedges_as_in_gmsh: how wedges are numbered; by default as in the installed VTK."""
    turned = not (wedges_are_as_in_gmsh() if wedges_as_in_gmsh is None else wedges_as_in_gmsh)
    every = list(leaves(data, ""))
    if not every:
        raise MeshError(source, "it has no cells", "a mesh of volumes, or of triangles, quads or polygons, is needed")
    raws = [(name, _raw_of_leaf(leaf, source, reader, turned)) for name, leaf in every]
    made = blocks.joined(raws) if len(raws) > 1 else raws[0][1]
    made.fields = {**_arrays(data.GetFieldData()), **made.fields}
    return made


def leaves(data: Any, name: str) -> Any:
    """Data sets with cells, with the names of their blocks."""
    if data is None:
        return
    if data.IsA("vtkDataSet"):
        if data.GetNumberOfCells():
            yield name, data
    elif data.IsA("vtkMultiBlockDataSet") or data.IsA("vtkMultiPieceDataSet") or data.IsA("vtkPartitionedDataSet"):
        for i in range(_count(data)):
            child, own = _child(data, i)
            is_group = child is not None and not child.IsA("vtkDataSet")
            is_same = own is None or own == "Internal" or (is_group and name == "" and _count(data) == 1)
            yield from leaves(child, name if is_same or own is None else own)
    elif data.IsA("vtkPartitionedDataSetCollection"):
        for i in range(data.GetNumberOfPartitionedDataSets()):
            yield from leaves(data.GetPartitionedDataSet(i), _name_in(data, i) or f"{i}")


def _count(data: Any) -> int:
    counts = ("GetNumberOfBlocks", "GetNumberOfPartitions", "GetNumberOfPieces")
    return int(next(getattr(data, count)() for count in counts if hasattr(data, count)))


def _child(data: Any, i: int) -> tuple[Any, str | None]:
    if data.IsA("vtkMultiBlockDataSet"):
        return data.GetBlock(i), _name_in(data, i) or f"{i}"
    return (data.GetPartition(i) if hasattr(data, "GetPartition") else data.GetPieceAsDataObject(i)), None


def _name_in(data: Any, i: int) -> str | None:
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

    if not data.HasMetaData(i):
        return None
    name = data.GetMetaData(i).Get(vtkCompositeDataSet.NAME())
    return name.strip() if name and name.strip() else None


def _raw_of_leaf(data: Any, source: str, reader: str, turned: bool) -> Raw:
    grid = _grid_of(data)
    cells = _cells_of(grid, source)
    if turned:
        _turn_wedges(cells)
    points = _array(grid.GetPoints().GetData())
    fields = _arrays(data.GetFieldData())
    raw = Raw(points, cells, _arrays(data.GetCellData()), fields=fields, source=source, reader=reader)
    ids = _array(data.GetPointData().GetArray("GlobalNodeId"))
    if ids is None and data.GetPointData().GetGlobalIds() is not None:
        ids = _array(data.GetPointData().GetGlobalIds())
    raw.point_ids = ids
    return _without_ghosts(raw)


def _grid_of(data: Any) -> Any:
    """An unstructured grid of the cells, in their order."""
    if data.IsA("vtkUnstructuredGrid"):
        return data
    from vtkmodules.vtkFiltersCore import vtkAppendFilter

    append = vtkAppendFilter()
    append.SetOutputPointsPrecision(0 if _is_single(data) else 1)
    append.AddInputDataObject(data)
    append.Update()
    return append.GetOutputDataObject(0)


def _is_single(data: Any) -> bool:
    points = data.GetPoints() if hasattr(data, "GetPoints") and data.IsA("vtkPointSet") else None
    return points is not None and points.GetDataType() == 10  # VTK_FLOAT


def _cells_of(grid: Any, source: str) -> Cells:
    types = _types_of(grid)
    array = grid.GetCells()
    offsets, flat = _integers(array.GetOffsetsArray()), _integers(array.GetConnectivityArray())
    if len(offsets) != len(types) + 1 or (len(types) and (offsets[-1] > len(flat) or np.any(np.diff(offsets) < 0))):
        raise MeshError(source, f"{len(types)} cells have {len(offsets)} offsets of {len(flat)} points", "the file is damaged")
    if len(flat) and (flat.min() < 0 or flat.max() >= grid.GetNumberOfPoints()):
        raise MeshError(source, f"a cell names point {flat.max()} of {grid.GetNumberOfPoints()}", "the file is damaged")
    cells = Cells(types, offsets, flat)
    rows = np.flatnonzero(types == 42)
    return _with_streams(cells, rows, _polyhedra_of(grid, rows, source)) if len(rows) else cells


def _types_of(grid: Any) -> NDArray[np.uint8]:
    try:
        array = grid.GetCellTypes()
    except TypeError:  # before VTK 9.6
        array = grid.GetCellTypesArray()
    return np.asarray(_array(array), np.uint8)


def _polyhedra_of(grid: Any, rows: Indices, source: str) -> Cells:
    """Face streams of polyhedra: from cell arrays of faces since VTK 9.4, from streams before."""
    if hasattr(grid, "GetPolyhedronFaces"):
        faces, places = grid.GetPolyhedronFaces(), grid.GetPolyhedronFaceLocations()
        if faces is None or places is None:
            raise MeshError(source, f"{len(rows)} polyhedra have no faces", "the file is damaged, or VTK is older than its writer")
        face_offsets, face_points = _integers(faces.GetOffsetsArray()), _integers(faces.GetConnectivityArray())
        counts, chosen = take(_integers(places.GetOffsetsArray()), _integers(places.GetConnectivityArray()), rows)
        sizes, points = take(face_offsets, face_points, chosen)
        return polyhedra.cells_of_faces(counts, sizes, points)
    stream, starts = _integers(grid.GetFaces()), _integers(grid.GetFaceLocations())[rows]
    return streams_at(stream, starts)


def streams_at(stream: Indices, starts: Indices) -> Cells:
    """Polyhedra whose face streams start at given places."""
    at, counts = starts + 1, stream[starts]
    for k in range(int(counts.max(initial=0))):
        cell = np.flatnonzero(counts > k)
        at[cell] += stream[at[cell]] + 1
    sizes = at - starts
    return Cells(np.full(len(starts), 42, np.uint8), offsets_of(sizes), stream[positions(starts, sizes)])


def _with_streams(cells: Cells, rows: Indices, streams: Cells) -> Cells:
    if len(rows) == len(cells.types):
        return streams
    others = np.flatnonzero(cells.types != 42)
    sizes = np.diff(cells.offsets)
    sizes[rows] = np.diff(streams.offsets)
    offsets = offsets_of(sizes)
    flat = np.empty(int(offsets[-1]), np.int64)
    flat[positions(offsets[rows], sizes[rows])] = streams.flat
    flat[positions(offsets[others], sizes[others])] = take(cells.offsets, cells.flat, others)[1]
    return Cells(cells.types, offsets, flat)


def _turn_wedges(cells: Cells) -> None:
    for kind, order in _TURNED.items():
        rows = np.flatnonzero(cells.types == kind)
        if len(rows):
            cells.flat = cells.flat.copy() if not cells.flat.flags.writeable or cells.flat.base is not None else cells.flat
            starts = cells.offsets[rows][:, None]
            cells.flat[starts + np.arange(len(order))] = cells.flat[starts + np.array(order)]


def _without_ghosts(raw: Raw) -> Raw:
    """Cells that are copies of those of other pieces, or hidden, are left out, as in VTK's own filters."""
    ghosts = raw.data.pop(_GHOSTS, None)
    if ghosts is None or not np.any(ghosts & (_HIDDEN | _DUPLICATE)):
        return raw
    kept = np.flatnonzero((ghosts & (_HIDDEN | _DUPLICATE)) == 0)
    raw.notes.append(f"{len(ghosts) - len(kept)} cells are hidden or belong to another piece, and were left out")
    raw.cells = raw.cells.some(kept)
    raw.data = {name: values[kept] for name, values in raw.data.items()}
    return raw


def _integers(array: Any) -> Indices:
    return np.asarray(_array(array), np.int64)


def _array(array: Any) -> Any:
    """An array of VTK as one of NumPy, without a copy where VTK has the numbers in memory."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if array is None:
        return None
    try:
        return vtk_to_numpy(array)
    except (AttributeError, TypeError, AssertionError):  # arrays that compute their values
        plain = array.NewInstance() if array.IsA("vtkAOSDataArrayTemplate") else _plain(array)
        plain.DeepCopy(array)
        return vtk_to_numpy(plain)


def _plain(array: Any) -> Any:
    from vtkmodules.vtkCommonCore import vtkDataArray

    return vtkDataArray.CreateDataArray(array.GetDataType())


def _arrays(attributes: Any) -> dict[str, Any]:
    """Named arrays: numbers as arrays, texts as lists."""
    made: dict[str, Any] = {}
    for i in range(0 if attributes is None else attributes.GetNumberOfArrays()):
        array = attributes.GetAbstractArray(i)
        if array.GetName() and array.IsA("vtkStringArray"):
            made[array.GetName()] = [array.GetValue(j) for j in range(array.GetNumberOfValues())]
        elif array.GetName() and array.IsA("vtkDataArray"):
            made[array.GetName()] = _array(array)
    return made
