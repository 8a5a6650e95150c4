"""Files that VTK reads. Its messages are caught: they are the reason in a MeshError."""

from __future__ import annotations

import contextlib
import os
import re
import xml.etree.ElementTree
from collections.abc import Callable
from typing import Any

import numpy as np

from .error import MeshError
from . import blocks, cgns_sides, cgns_tree, fluent_faces, vtk_data
from .mesh import Indices
from .raw import Raw

_WEDGES_AS_IN_GMSH = {"foam": False, "cgns": True, "exodus": True, "xdmf": True}  # readers that give one order with every VTK
_ZONES_OF_CELLS = ("fluid", "solid")
"""Types of Fluent's zones."""
_WAY_ON = "a program that reads the file can write it anew, such as ParaView or meshio"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file; format: a key of the table below."""
    if format == "pvd":
        return _collection(path, source)
    if format == "cgns":
        _refuse_coordinates(path, source)
    sides = _sides_of_cgns(path) if format == "cgns" else None
    data = _caught(source, lambda: _cgns(path, sides is None) if format == "cgns" else _READERS[format](path))
    raw = vtk_data.raw_of(data, source, "VTK", _WEDGES_AS_IN_GMSH.get(format))
    if sides is not None:
        _name_cgns(raw, *sides)
    if format == "exodus":
        _name_exodus(raw)
    if format == "fluent":
        _name_fluent(raw, [title for title, _ in vtk_data.leaves(data, "")], fluent_faces.sides_of(path, source))
    if format == "ucd":
        raw.regions = raw.data.get("Material Id")
    return raw


def _caught(source: str, run: Callable[[], Any]) -> Any:
    """What `run` gives; a MeshError with VTK's reason if VTK reports an error, even if it gives a part of the data."""
    from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

    window, before, verbosity = vtkStringOutputWindow(), vtkOutputWindow.GetInstance(), vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # it prints what the window gets
    try:
        data = run()
    finally:
        vtkOutputWindow.SetInstance(before)
        vtkLogger.SetStderrVerbosity(verbosity)
    reason = _reason(window.GetOutput() or "")
    if reason or data is None:
        raise MeshError(source, f"VTK can't read it ({reason or 'it gives no data'})", _WAY_ON)
    return data


def _reason(output: str) -> str:
    """The first error of VTK's output, without places in its source and addresses."""
    found = re.search(r"(?ms)^ERROR:(.*?)(?=^(?:ERROR|Warning|Generic)|\Z)", output)
    if found is None:
        return ""
    lines = [line.strip() for line in found.group(1).strip().splitlines() if line.strip()]
    lines = [line for line in lines if not line.startswith("In ")] or lines
    text = re.sub(r"^\w+ ?\(0x[0-9a-f]+\): *", "", " ".join(lines)).strip(" .|")
    return "".join(c if c.isprintable() and c.isascii() else "?" for c in text)[:300]


def _output(reader: Any) -> Any:
    reader.Update()
    return reader.GetOutputDataObject(0)


def _legacy(path: str) -> Any:
    from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader

    reader = vtkGenericDataObjectReader()
    reader.SetFileName(path)
    for kind in ("Scalars", "Vectors", "Normals", "Tensors", "ColorScalars", "TCoords", "Fields"):
        getattr(reader, f"ReadAll{kind}On")()  # by default only the first array of each kind
    return _output(reader)


def _xml(path: str) -> Any:
    from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader

    reader = vtkXMLGenericDataObjectReader()
    reader.SetFileName(path)
    return _output(reader)


def _hdf(path: str) -> Any:
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(path)
    return _output(reader)


def _exodus(path: str) -> Any:
    from vtkmodules.vtkIOExodus import vtkExodusIIReader

    reader = vtkExodusIIReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    reader.GenerateGlobalNodeIdArrayOn()
    for kind in (reader.ELEM_BLOCK, reader.FACE_BLOCK, reader.SIDE_SET, reader.FACE_SET, reader.ELEM_SET):
        for i in range(reader.GetNumberOfObjects(kind)):
            reader.SetObjectStatus(kind, i, 1)
    return _output(reader)


def _cgns(path: str, with_patches: bool = True) -> Any:
    from vtkmodules.vtkIOCGNSReader import vtkCGNSReader

    reader = vtkCGNSReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    reader.SetLoadBndPatch(with_patches)
    reader.GetBaseSelection().EnableAllArrays()
    reader.EnableAllFamilies()
    return _output(reader)


def _ensight(path: str) -> Any:
    from vtkmodules.vtkIOEnSight import vtkGenericEnSightReader

    reader = vtkGenericEnSightReader()
    reader.SetCaseFileName(path)
    reader.ReadAllVariablesOn()
    return _output(reader)


def _foam(path: str) -> Any:
    from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader

    reader = vtkOpenFOAMReader()
    reader.SetFileName(path)
    if hasattr(reader, "SetDecomposePolyhedra"):  # before VTK 9.5
        reader.SetDecomposePolyhedra(0)
    reader.ReadZonesOn()
    reader.CacheMeshOff()
    reader.UpdateInformation()
    reader.EnableAllPatchArrays()
    reader.DisableAllCellArrays()
    return _output(reader)


def _ucd(path: str) -> Any:
    from vtkmodules.vtkIOGeometry import vtkAVSucdReader

    reader = vtkAVSucdReader()
    reader.SetFileName(path)
    return _output(reader)


def _tecplot(path: str) -> Any:
    from vtkmodules.vtkIOGeometry import vtkTecplotReader

    reader = vtkTecplotReader()
    reader.SetFileName(path)
    return _output(reader)


def _xdmf(path: str) -> Any:
    """The grids of the first time. A series of times that says its mesh once, for all of them, has it here twice."""
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

    reader = vtkXdmfReader()
    reader.SetFileName(path)
    data = _output(reader)
    every = [leaf for _, leaf in vtk_data.leaves(data, "")]
    sizes = {(leaf.GetNumberOfPoints(), leaf.GetNumberOfCells()) for leaf in every}
    return every[0] if len(every) > 1 and len(sizes) == 1 and _is_one_place(every) else data


def _is_one_place(every: list[Any]) -> bool:
    return all(leaf.GetBounds() == every[0].GetBounds() for leaf in every)


def _fluent(path: str) -> Any:
    """Zones of cells; they are called 'NAME:TYPE'. For a zone of faces VTK gives the cells beside them once more: it is left out. All blocks have
    the points of the whole file. They get their numbers, so that zones share them also where two points lie at one place."""
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
    from vtkmodules.vtkIOGeometry import vtkFLUENTReader

    reader = vtkFLUENTReader()
    reader.SetFileName(path)
    data = _output(reader)
    parts = {i: data.GetBlock(i) for i in range(data.GetNumberOfBlocks()) if data.GetBlock(i) is not None}
    zones = [i for i in parts if (data.GetMetaData(i).Get(data.NAME()) or "").rpartition(":")[2] in _ZONES_OF_CELLS]
    counts = {part.GetNumberOfPoints() for part in parts.values()}
    for i, part in parts.items():
        if zones and i not in zones:
            data.SetBlock(i, None)
        elif len(counts) == 1:
            part.GetPointData().SetGlobalIds(numpy_to_vtkIdTypeArray(np.arange(part.GetNumberOfPoints()), deep=True))
    return data


_READERS: dict[str, Callable[[str], Any]] = {
    "legacy": _legacy,
    "xml": _xml,
    "hdf": _hdf,
    "exodus": _exodus,
    "cgns": _cgns,
    "ensight": _ensight,
    "foam": _foam,
    "ucd": _ucd,
    "tecplot": _tecplot,
    "xdmf": _xdmf,
    "fluent": _fluent,
}


def _name_exodus(raw: Raw) -> None:
    """VTK writes 'Unnamed block ID: 2' for a block without a name."""
    def short(name: str) -> str:
        found = re.match(r"Unnamed (?:block|set) ID: (\d+)", name)
        return found.group(1) if found else name

    raw.groups = {short(name): members for name, members in raw.groups.items()}
    raw.region_names = {short(name): label for name, label in raw.region_names.items()}


def _name_fluent(raw: Raw, titles: list[str], sides: list[tuple[str, Indices, Indices]]) -> None:
    """Zones of cells, one in each block, and of faces."""
    zones = raw.groups or {title: np.arange(len(raw.cells.types)) for title in titles}
    raw.groups = {title.rpartition(":")[0] or title: members for title, members in zones.items()}
    raw.regions, raw.region_names = None, {}
    for name, offsets, points in sides:
        if len(points) and not 0 <= points.min() <= points.max() < len(raw.points):
            raise MeshError(raw.source, f"a face of zone '{name}' has a point that is not there, of {len(raw.points)}", _WAY_ON)
        raw.sides.append((name, offsets, points))


def _refuse_coordinates(path: str, source: str) -> None:
    """VTK knows points by CoordinateX, Y and Z only, and takes others for these without a word. HDF5 can be looked into where h5py is installed."""
    with contextlib.suppress(cgns_tree.NoTree):
        for _, zone in cgns_tree.zones(path):
            for grid in zone.all("GridCoordinates_t"):
                names = sorted(node.name for node in grid.all("DataArray_t"))
                if names and "CoordinateX" not in names:
                    raise MeshError(source, f"its points are given by {', '.join(names)}, which VTK leaves out", "its points have to be made rectangular")


def _sides_of_cgns(path: str) -> tuple[list[Any], list[str]] | None:
    """The surfaces of a file all of whose zones are unstructured; None: VTK's are taken."""
    try:
        return cgns_sides.sides_of(path)
    except cgns_tree.NoTree as error:
        return [], [f"{error}; VTK leaves out boundary conditions"]
    except (KeyError, ValueError, IndexError, TypeError, AttributeError, StopIteration) as error:
        return [], [f"its surfaces can't be read ({type(error).__name__} {error})"]


def _name_cgns(raw: Raw, zones: list[Any], notes: list[str]) -> None:
    """Surfaces of the zones. Points of one zone stay as they are in the file, those of several are found by their places."""
    raw.notes += notes
    for zone, sides in zones:
        if not sides:
            continue
        points = cgns_sides.points_of(zone)
        is_whole = len(zones) == 1 and len(points) == len(raw.points)
        index = np.arange(len(points)) if is_whole else _places_of(points, raw.points)
        for name, offsets, corners in sides:
            if len(corners) and not (0 <= corners.min() <= corners.max() < len(index) and index[corners].min() >= 0):
                raise MeshError(raw.source, f"a face of the surface '{name}' has a point that is not there, of {len(index)}", _WAY_ON)
            raw.sides.append((name, offsets, index[corners]))


def _places_of(points: Any, every: Any) -> Indices:
    """Which of all points stands where each point does; -1: none."""
    in_space = np.concatenate([points, np.zeros((len(points), 3 - points.shape[1]))], axis=1)
    place = np.ravel(np.unique(np.concatenate([every, in_space]) + 0.0, axis=0, return_inverse=True)[1])
    first = np.full(len(place), -1, np.int64)
    first[place[: len(every)][::-1]] = np.arange(len(every))[::-1]
    return first[place[len(every) :]]


def _collection(path: str, source: str) -> Raw:
    """The pieces of the first time of a .pvd file."""
    try:
        entries = [entry.attrib for entry in xml.etree.ElementTree.parse(path).iter("DataSet")]
    except xml.etree.ElementTree.ParseError as error:
        raise MeshError(source, f"its XML is damaged ({error})", _WAY_ON) from error
    chosen = [entry for entry in entries if entry.get("timestep", "0") == entries[0].get("timestep", "0")]
    if not chosen:
        raise MeshError(source, "it names no files", _WAY_ON)
    parts = []
    for entry in chosen:
        piece = os.path.join(os.path.dirname(path), entry["file"])
        parts.append((entry.get("name") or entry.get("part") or "0", read(piece, f"{source}, file '{entry['file']}'", "xml")))
    return blocks.joined(parts) if len(parts) > 1 else parts[0][1]
