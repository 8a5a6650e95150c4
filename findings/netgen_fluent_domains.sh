#!/bin/sh
# Netgen and the Fluent files (.msh) that it writes of a mesh of two materials.
# One would guess that a section of faces has as many faces as its head says, and that the two materials are two zones of cells.
# What happens: the wall between the materials is in no zone of its own: its faces are written among the interior ones, but counted among those of the
# boundary. So the section of the boundary ends before its last number, by as many faces as the wall has, and that of the interior goes on
# beyond it. There is one zone of cells for both materials. A mesh of one material is counted rightly.
# Who meets it: whoever has fluid beside solid, or lumen beside tissue, in Netgen or NGSolve and goes on to Fluent.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile netgen-mesher==6.2.2608 numpy==2.4.6
"$folder/venv/bin/python" - "$folder/boxes.msh" <<'PY'
import importlib.metadata
import re
import sys

from netgen.csg import CSGeometry, OrthoBrick, Pnt


def written(count):
    """Faces that each section has beyond what its head says, faces of the wall between, and zones of cells, for boxes in a row."""
    geometry = CSGeometry()
    for i in range(count):
        geometry.Add(OrthoBrick(Pnt(i, 0, 0), Pnt(i + 1, 1, 1)).mat(f"material {i}"))
    mesh = geometry.GenerateMesh(maxh=1)
    mesh.Export(sys.argv[1], "Fluent Format")
    text = open(sys.argv[1]).read()
    beyond = []
    for first, last, rows in re.findall(r"\(13 \([1-9a-f]+ (\w+) (\w+) \w+ \w+\)\(\s([^()]*)\)\)", text):
        beyond.append(len(rows.split("\n")) - 1 - (int(last, 16) - int(first, 16) + 1))
    between = sum(all(abs(mesh[node].p[0] - 1) < 1e-9 for node in face.vertices) for face in mesh.Elements2D()) if count == 2 else 0
    return beyond, between, len(re.findall(r"\(12 \([1-9a-f]", text))


one, two = written(1), written(2)
print("netgen-mesher", importlib.metadata.version("netgen-mesher"), "faces beyond those told, of the wall between, zones of cells; one box:", one, "two boxes:", two)
assert one == ([0, 0], 0, 1)
assert two[0][0] > 0 and two[0][1] == -two[1] < 0 and two[2] == 1, "the counts are right now"
PY
