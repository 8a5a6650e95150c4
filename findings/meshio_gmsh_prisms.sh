#!/bin/sh
# meshio and wedges and pyramids of second order that Gmsh has written (.msh).
# One would guess that meshio brings all of Gmsh's cells of second order into VTK's order, as it does with tetrahedra and hexahedra, because it
# writes them to .vtu unchanged.
# What happens: wedges of 18 nodes keep Gmsh's order. As .vtu, one with volume 0.5 has another, and its sides run across it.
# Wedges of 15 and pyramids of 13 nodes, which Gmsh writes with Mesh.SecondOrderIncomplete, stop it with a KeyError, though it has tables for
# their order: no meshio.Mesh can hold these types. Pyramids of 14 nodes can be read, and not be written. Tetrahedra come through.
# Who meets it: whoever extrudes layers in Gmsh, sets order 2, and goes on by meshio to VTK, ParaView, PyVista or FEniCS.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile gmsh==4.15.2 meshio==5.3.5 vtk==9.7.2 numpy==2.4.6
"$folder/venv/bin/python" - "$folder" <<'PY'
import sys

import gmsh
import meshio
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
PRISM = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
CELLS = {"tetrahedron": (4, [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], 1 / 6), "wedge": (6, PRISM, 0.5), "pyramid": (7, [*PRISM[:2], (1, 1, 0), *PRISM[2:4]], 1 / 3)}


def volume(name, incomplete):
    """Measures one straight cell that Gmsh raises to order 2, behind meshio and a .vtu file; or tells what stopped it."""
    kind, corners, _ = CELLS[name]
    gmsh.clear()
    gmsh.model.addDiscreteEntity(3, 1)
    gmsh.model.mesh.addNodes(3, 1, list(range(1, len(corners) + 1)), [float(x) for corner in corners for x in corner])
    gmsh.model.mesh.addElementsByType(1, kind, [1], list(range(1, len(corners) + 1)))
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", incomplete)
    gmsh.model.mesh.setOrder(2)
    gmsh.write(sys.argv[1] + "/one.msh")
    try:
        mesh = meshio.read(sys.argv[1] + "/one.msh")
        meshio.write(sys.argv[1] + "/one.vtu", meshio.Mesh(mesh.points, mesh.cells))
    except KeyError as error:
        return f"KeyError {error}"
    reader, sizes = vtkXMLUnstructuredGridReader(), vtkCellSizeFilter()
    reader.SetFileName(sys.argv[1] + "/one.vtu")
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    return round(sizes.GetOutput().GetCellData().GetArray("Volume").GetValue(0), 4)


found = {(name, incomplete): volume(name, incomplete) for name in CELLS for incomplete in (0, 1)}
print("gmsh", gmsh.__version__, "meshio", meshio.__version__, "(cell, incomplete): volume", found)
gmsh.finalize()
assert found["tetrahedron", 0] == found["tetrahedron", 1] == 0.1667, "tetrahedra do not come through"
assert isinstance(found["wedge", 0], float) and abs(abs(found["wedge", 0]) - 0.5) > 0.05, "wedges of 18 nodes are renumbered now"
assert "KeyError" in str(found["wedge", 1]) and "KeyError" in str(found["pyramid", 1]), "these types are known now"
PY
