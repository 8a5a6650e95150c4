#!/bin/sh
# meshio and hexahedra of 20 and 27 nodes in Exodus II files (.e, .exo).
# One would guess that a straight hexahedron with volume 1 has that volume in VTK after meshio has written it as Exodus, and that meshio reads one
# of Cubit or MOOSE into the order of its own types, which it says are VTK's.
# What happens: Exodus has the middles of the four sides upwards before those of the top, and meshio renumbers neither when it writes nor when
# it reads. VTK finds volumes of 0.08 and -0.02 in what meshio writes, and in a file in Exodus's order that meshio has converted to .vtu. Its own round
# trip hides this, since it makes the same fault twice. Tetrahedra of 10 nodes are right. No warning is given.
# Who meets it: whoever brings second-order hexahedra from Cubit, MOOSE or libMesh to VTK or FEniCS by meshio, or back.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile meshio==5.3.5 netCDF4==1.7.4 vtk==9.7.2 numpy==2.2.6
cd "$folder"
venv/bin/python - <<'PY'
import meshio
import netCDF4
import numpy as np
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkGenericCell
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOExodus import vtkExodusIIReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

TYPES = {"tetra10": 24, "hexahedron20": 25, "hexahedron27": 29}
IN_EXODUS = {"tetra10": list(range(10)), "hexahedron20": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15]}
IN_EXODUS["hexahedron27"] = [*IN_EXODUS["hexahedron20"], 26, 24, 25, 20, 21, 22, 23]


def straight(name):
    """Nodes of a cell in VTK's order, as VTK places them."""
    cell = vtkGenericCell.InstantiateCell(TYPES[name])
    return np.array([cell.GetParametricCoords()[i] for i in range(3 * cell.GetNumberOfPoints())]).reshape(-1, 3)


def by_vtk(reader, path):
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    while not data.IsA("vtkDataSet"):
        data = next(data.GetBlock(i) for i in range(data.GetNumberOfBlocks()) if data.GetBlock(i) is not None)
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(data)
    sizes.Update()
    return round(sizes.GetOutput().GetCellData().GetArray("Volume").GetValue(0), 4)


def write_exodus(path, name, points):
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        file.api_version = file.version = np.float32(5.1)
        file.floating_point_word_size, file.file_size, file.title = 8, 1, "one cell"
        for word, size in (("len_string", 33), ("num_dim", 3), ("num_nodes", len(points)), ("num_elem", 1), ("num_el_blk", 1), ("num_el_in_blk1", 1), ("num_nod_per_el1", len(points))):
            file.createDimension(word, size)
        file.createDimension("time_step", None)
        file.createVariable("time_whole", "f8", ("time_step",))
        for axis, column in zip("xyz", points.T):
            file.createVariable("coord" + axis, "f8", ("num_nodes",))[:] = column
        for word in ("eb_status", "eb_prop1"):
            file.createVariable(word, "i4", ("num_el_blk",))[:] = 1
        file["eb_prop1"].setncattr("name", "ID")
        connect = file.createVariable("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1"))
        connect.elem_type = {"tetra10": "TETRA10", "hexahedron20": "HEX20", "hexahedron27": "HEX27"}[name]
        connect[:] = [np.arange(1, len(points) + 1)]


found = {}
for name in TYPES:
    points = straight(name)
    meshio.write("by_meshio.e", meshio.Mesh(points, [(name, [np.arange(len(points))])]))
    write_exodus("exodus.e", name, points[IN_EXODUS[name]])
    read = meshio.read("exodus.e")
    meshio.write("converted.vtu", meshio.Mesh(read.points, read.cells))
    found[name] = by_vtk(vtkExodusIIReader(), "exodus.e"), by_vtk(vtkExodusIIReader(), "by_meshio.e"), by_vtk(vtkXMLUnstructuredGridReader(), "converted.vtu")
print("meshio", meshio.__version__, "VTK", vtkVersion.GetVTKVersion(), "volumes of a file in Exodus's order, of meshio's, and of the first behind meshio:", found)
assert found["tetra10"] == (0.1667, 0.1667, 0.1667) and found["hexahedron20"][0] == found["hexahedron27"][0] == 1, "the file is not as VTK reads Exodus"
assert all(abs(volume) < 0.2 for name in ("hexahedron20", "hexahedron27") for volume in found[name][1:]), "nodes are renumbered now"
PY
