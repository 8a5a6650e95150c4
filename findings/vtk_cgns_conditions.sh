#!/bin/sh
# VTK and the boundary conditions of an unstructured CGNS zone.
# One would guess that a reader that is told to load boundary patches, and all families, gives one for each BC_t node of the file.
# What happens: the block "Patches" of the zone is empty. For the types BCInflow, BCOutflow and UserDefined a line on the log says that they are
# not supported, which filters and PyVista do not show; for BCWall there is not even that. The cells are read.
# Who meets it: whoever takes inlets and outlets of an unstructured CGNS mesh by VTK, PyVista or ParaView.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q vtk==9.7.2 h5py==3.16.0
"$folder/venv/bin/python" - "$folder/one.cgns" <<'PY'
import sys
import h5py
import numpy as np
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOCGNSReader import vtkCGNSReader


def node(parent, name, label, data=None, kind="MT"):
    made = parent.create_group(name, track_order=True)
    for key, value, width in (("name", name, 33), ("label", label, 33), ("type", kind, 3)):
        made.attrs.create(key, np.bytes_(value), dtype=f"S{width}")
    made.attrs["flags"] = np.array([1], np.int32)
    if data is not None:
        made.create_dataset(" data", data=data)
    return made


def word(text):
    return np.frombuffer(text.encode(), np.int8)


KINDS = ["BCWall", "BCInflow", "BCOutflow", "UserDefined"]
with h5py.File(sys.argv[1], "w", libver=("earliest", "v108"), track_order=True) as file:
    for name, text, size in ((" format", "IEEE_LITTLE_32", 15), (" hdf5version", "HDF5 Version 1.14", 33)):
        file.create_dataset(name, data=np.frombuffer(text.encode().ljust(size, b"\0"), np.int8))
    for key, value, width in (("name", "HDF5 MotherNode", 33), ("label", "Root Node of HDF5 File", 33), ("type", "MT", 3)):
        file.attrs.create(key, np.bytes_(value), dtype=f"S{width}")
    node(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", np.array([3.4], np.float32), "R4")
    base = node(file, "Base", "CGNSBase_t", np.array([3, 3], np.int32), "I4")
    zone = node(base, "Zone", "Zone_t", np.array([[4], [1], [0]], np.int32), "I4")
    node(zone, "ZoneType", "ZoneType_t", word("Unstructured"), "C1")
    grid = node(zone, "GridCoordinates", "GridCoordinates_t")
    for k, axis in enumerate("XYZ"):  # a tetrahedron
        node(grid, "Coordinate" + axis, "DataArray_t", np.array([0.0, k == 0, k == 1, k == 2]), "R8")
    cells = node(zone, "Cells", "Elements_t", np.array([10, 0], np.int32), "I4")
    node(cells, "ElementRange", "IndexRange_t", np.array([1, 1], np.int32), "I4")
    node(cells, "ElementConnectivity", "DataArray_t", np.array([1, 2, 3, 4], np.int32), "I4")
    faces = node(zone, "Faces", "Elements_t", np.array([5, 0], np.int32), "I4")
    node(faces, "ElementRange", "IndexRange_t", np.array([2, 5], np.int32), "I4")
    node(faces, "ElementConnectivity", "DataArray_t", np.array([1, 3, 2, 1, 2, 4, 2, 3, 4, 3, 1, 4], np.int32), "I4")
    conditions = node(zone, "ZoneBC", "ZoneBC_t")
    for k, kind in enumerate(KINDS):
        condition = node(conditions, "face" + str(k), "BC_t", word(kind), "C1")
        node(condition, "PointRange", "IndexRange_t", np.array([[2 + k], [2 + k]], np.int32), "I4")
        node(condition, "GridLocation", "GridLocation_t", word("FaceCenter"), "C1")

reader = vtkCGNSReader()
reader.SetFileName(sys.argv[1])
reader.UpdateInformation()
reader.LoadBndPatchOn()
reader.GetBaseSelection().EnableAllArrays()
reader.EnableAllFamilies()
reader.Update()


def names(data, found):
    for i in range(data.GetNumberOfBlocks() if hasattr(data, "GetNumberOfBlocks") else 0):
        found.append(data.GetMetaData(i).Get(data.NAME()))
        names(data.GetBlock(i), found)
    return found


every = names(reader.GetOutput(), [])
print("VTK", vtkVersion.GetVTKVersion(), "of", KINDS, "has", [kind for k, kind in enumerate(KINDS) if "face" + str(k) in every], every)
assert "Internal" in every or "Zone" in every, "the file is not read"
assert not any("face" + str(k) in every for k in range(len(KINDS))), "conditions are given now"
PY
