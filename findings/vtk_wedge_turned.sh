#!/bin/sh
# VTK and the wedge of one file, before and since 9.7.0.
# One would guess that a .vtu file has one meaning, so that the volume of its wedge keeps its sign, and that readers of other formats follow
# the installed VTK.
# What happens: the volume is 0.5 with VTK 9.6.2 and -0.5 with 9.7.2, without a word in the file's version. The reader of OpenFOAM still
# gives the old order, so a prism of a case has volume -0.5 with 9.7.2.
# Who meets it: whoever reads wedges (boundary layers, extrusions) that an older VTK wrote, or cases of OpenFOAM, and uses volumes or normals.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/wedge.vtu" <<'XML'
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="6" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 0 1 0 1 0 0 0 0 1 0 1 1 1 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">6</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">13</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
XML
mesh="$folder/case/constant/polyMesh"
mkdir -p "$mesh" "$folder/case/system"
foam() { # CLASS NAME TEXT
  printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n%s\n' "$1" "$2" "$3"
}
foam vectorField points '6 ((0 0 0) (1 0 0) (0 1 0) (0 0 1) (1 0 1) (0 1 1))' > "$mesh/points"
foam faceList faces '5 (4(1 2 5 4) 3(0 2 1) 3(3 4 5) 4(0 3 5 2) 4(0 1 4 3))' > "$mesh/faces"
foam labelList owner '5 (0 0 0 0 0)' > "$mesh/owner"
foam labelList neighbour '0 ()' > "$mesh/neighbour"
foam polyBoundaryMesh boundary '1 (all { type wall; nFaces 5; startFace 0; })' > "$mesh/boundary"
foam dictionary controlDict 'startFrom startTime; startTime 0; endTime 1; deltaT 1; writeInterval 1;' > "$folder/case/system/controlDict"
cat > "$folder/volumes.py" <<'PY'
import sys
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def volume(grid):
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    return sizes.GetOutput().GetCellData().GetArray("Volume").GetValue(0)


file, case = vtkXMLUnstructuredGridReader(), vtkOpenFOAMReader()
file.SetFileName(sys.argv[1] + "/wedge.vtu")
case.SetFileName(sys.argv[1] + "/case/case.foam")
file.Update()
case.Update()
found = volume(file.GetOutput()), volume(case.GetOutput().GetBlock(0))
print("VTK", vtkVersion.GetVTKVersion(), "wedge of the file:", found[0], "prism of OpenFOAM:", found[1])
assert found == (float(sys.argv[2]), float(sys.argv[2])), "this has changed"
PY
for pair in 9.6.2:0.5 9.7.2:-0.5; do
  python3 -m venv "$folder/venv-${pair%:*}"
  "$folder/venv-${pair%:*}/bin/pip" install -q "vtk==${pair%:*}"
  "$folder/venv-${pair%:*}/bin/python" "$folder/volumes.py" "$folder" "${pair#*:}"
done
