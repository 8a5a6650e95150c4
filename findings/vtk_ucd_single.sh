#!/bin/sh
# VTK and the coordinates of an AVS UCD file (.inp, .ucd).
# One would guess that points are read in double precision, as from VTK's own legacy and XML files.
# What happens: the reader has points in single precision only: 0.1 becomes 0.10000000149. Two points that are 1e-9 apart fall together,
# so thin cells get volume 0. There is no option, and no warning is given.
# Who meets it: whoever reads meshes of deal.II, LaGriT or OpenFOAM tools in geographic coordinates, or thin layers, by VTK or PyVista.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q vtk==9.7.2
printf '4 1 0 0 0\n1 0.1 0 0\n2 1.1 0 0\n3 0.1 1 0\n4 0.100000001 0 0.000000001\n1 1 tet 1 2 3 4\n' > "$folder/one.ucd"
"$folder/venv/bin/python" - "$folder/one.ucd" <<'PY'
import sys
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOGeometry import vtkAVSucdReader

reader = vtkAVSucdReader()
reader.SetFileName(sys.argv[1])
reader.Update()
points = reader.GetOutput().GetPoints()
first, last = points.GetPoint(0), points.GetPoint(3)
print("VTK", vtkVersion.GetVTKVersion(), "type of points:", points.GetData().GetDataTypeAsString(), first, last)
assert first[0] != 0.1 and first[0] == last[0], "points are kept now"
PY
