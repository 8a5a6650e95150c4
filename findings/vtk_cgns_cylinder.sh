#!/bin/sh
# VTK and CGNS files with cylindrical coordinates (CoordinateR, CoordinateTheta, CoordinateZ, names of the standard).
# One would guess that a quarter of a tube has volume 1.5 as a plain hexahedron, or that the reader says that it knows rectangular coordinates only.
# What happens: the angle becomes x, y is 0, the height becomes z, and the radius vanishes. All points lie in one plane, many at one place, and every cell
# has volume 0. There is no warning or error. With the names CoordinateX, Y and Z the same file is read.
# Who meets it: whoever takes grids of turbomachinery or pipes to VTK, ParaView or PyVista.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile vtk==9.7.2 h5py==3.16.0 numpy==2.4.6
"$folder/venv/bin/python" - "$folder/quarter.cgns" <<'PY'
import sys

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow, vtkVersion
from vtkmodules.vtkIOCGNSReader import vtkCGNSReader

places = np.array([(r, angle, z) for z in (0.0, 1.0) for r, angle in ((1.0, 0.0), (2.0, 0.0), (2.0, np.pi / 2), (1.0, np.pi / 2))])
window = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(window)


def node(parent, name, label, data=None, kind="MT"):
    made = parent.create_group(name, track_order=True)
    for key, value, width in (("name", name, 33), ("label", label, 33), ("type", kind, 3)):
        made.attrs.create(key, np.bytes_(value), dtype=f"S{width}")
    made.attrs["flags"] = np.array([1], np.int32)
    if data is not None:
        made.create_dataset(" data", data=data)
    return made


def points(names, columns):
    """What VTK has of a file with one hexahedron."""
    with h5py.File(sys.argv[1], "w", libver=("earliest", "v108"), track_order=True) as file:
        for name, text, size in ((" format", "IEEE_LITTLE_32", 15), (" hdf5version", "HDF5 Version 1.14", 33)):
            file.create_dataset(name, data=np.frombuffer(text.encode().ljust(size, b"\0"), np.int8))
        for key, value, width in (("name", "HDF5 MotherNode", 33), ("label", "Root Node of HDF5 File", 33), ("type", "MT", 3)):
            file.attrs.create(key, np.bytes_(value), dtype=f"S{width}")
        node(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", np.array([3.4], np.float32), "R4")
        base = node(file, "Base", "CGNSBase_t", np.array([3, 3], np.int32), "I4")
        zone = node(base, "Zone", "Zone_t", np.array([[8], [1], [0]], np.int32), "I4")
        node(zone, "ZoneType", "ZoneType_t", np.frombuffer(b"Unstructured", np.int8), "C1")
        grid = node(zone, "GridCoordinates", "GridCoordinates_t")
        for name, column in zip(names, columns):
            node(grid, "Coordinate" + name, "DataArray_t", np.ascontiguousarray(column), "R8")
        cells = node(zone, "Cells", "Elements_t", np.array([17, 0], np.int32), "I4")
        node(cells, "ElementRange", "IndexRange_t", np.array([1, 1], np.int32), "I4")
        node(cells, "ElementConnectivity", "DataArray_t", np.arange(1, 9, dtype=np.int32), "I4")
    reader = vtkCGNSReader()
    reader.SetFileName(sys.argv[1])
    reader.UpdateInformation()
    reader.GetBaseSelection().EnableAllArrays()
    reader.Update()
    data = reader.GetOutput()
    while not data.IsA("vtkDataSet"):
        data = data.GetBlock(0)
    assert data.GetNumberOfCells() == 1
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


radius, angle, height = places.T
plain = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=1)
assert np.allclose(points("XYZ", plain.T), plain), "the file is not read"
found = points(("R", "Theta", "Z"), places.T)
print("VTK", vtkVersion.GetVTKVersion(), "point 3 is", found[2], "and point 7", found[6], "of", plain[2], plain[6], "messages:", repr(window.GetOutput() or ""))
assert np.allclose(found, np.stack([angle, 0 * angle, height], axis=1)), "these coordinates are read otherwise now"
assert not window.GetOutput(), "this is told now"
PY
