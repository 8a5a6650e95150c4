#!/bin/sh
# meshio and the option ELSET of an *ELEMENT block in an Abaqus file.
# One would guess that the set "tissue" of the second block, a wedge, holds that wedge.
# What happens: the set holds the hexahedron of the first block, and not the wedge, without a warning: numbers are local to the block that
# has the set, but are taken as those of all elements.
# Who meets it: whoever reads materials or regions from files of Abaqus, CalculiX or FreeCAD with more than one type of element.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q meshio==5.3.5
cat > "$folder/two.inp" <<'INP'
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 2, 0, 0
10, 2, 0, 1
*ELEMENT, TYPE=C3D8
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D6, ELSET=tissue
2, 2, 9, 3, 6, 10, 7
INP
"$folder/venv/bin/python" - "$folder/two.inp" <<'PY'
import sys
import meshio

mesh = meshio.read(sys.argv[1])
members = [part.tolist() for part in mesh.cell_sets["tissue"]]
print("meshio", meshio.__version__, "blocks", [block.type for block in mesh.cells], "the set has", members)
assert [block.type for block in mesh.cells] == ["hexahedron", "wedge"]
assert members == [[0], []], "this has changed"
PY
