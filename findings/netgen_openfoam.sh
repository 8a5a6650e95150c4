#!/bin/sh
# Netgen and the OpenFOAM cases that it writes.
# One would guess that such a case has the files points, faces, owner, neighbour and boundary, and that the normal of each face points away from its
# owner, as the format says.
# What happens: the list of neighbours is in a file `neighbor`, a name that neither OpenFOAM nor VTK looks for. The points of each face stand in ascending
# order, so about half of the normals point inwards: VTK, given the right name, makes tetrahedra that are inside out of such cells, and
# signs of fluxes and of normals at walls are those of chance. Nothing is said.
# Who meets it: whoever meshes by Netgen, renames the file, and goes on with OpenFOAM or ParaView.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile netgen-mesher==6.2.2608 numpy==2.4.6
cd "$folder"
venv/bin/python - <<'PY'
import importlib.metadata
import os
import re

import numpy as np
from netgen.csg import CSGeometry, OrthoBrick, Pnt


def body(path):
    """The rows of a list of OpenFOAM."""
    return open(path).read().partition("\n(\n")[2].rpartition("\n)")[0]


def rows(path):
    """The integers of each row."""
    return [[int(word) for word in re.findall(r"\d+", row)] for row in body(path).splitlines()]


geometry = CSGeometry()
geometry.Add(OrthoBrick(Pnt(0, 0, 0), Pnt(1, 1, 1)))
mesh = geometry.GenerateMesh(maxh=1)
mesh.Export("case", "OpenFOAM 1.5+ Format")
folder = "case/constant/polyMesh"
files = sorted(os.listdir(folder))
points = np.array([[float(word) for word in row.strip("()").split()] for row in body(f"{folder}/points").splitlines()])
faces, owners = [row[1:] for row in rows(f"{folder}/faces")], [cell for (cell,) in rows(f"{folder}/owner")]
neighbours = [cell for (cell,) in rows(f"{folder}/{'neighbor' if 'neighbor' in files else 'neighbour'}")]
corners = [set() for _ in range(len(mesh.Elements3D()))]
for cells in (owners, neighbours):
    for cell, face in zip(cells, faces):
        corners[cell].update(face)
turned = 0
for face, owner in zip(faces, owners):
    p, q, r = points[face]
    inside = points[list(corners[owner])].mean(axis=0)
    turned += bool(np.cross(q - p, r - p) @ (p - inside) < 0)
print("netgen", importlib.metadata.version("netgen-mesher"), "files", files, "with", turned, "of", len(faces), "faces turned")
assert all(len(own) == 4 for own in corners)
assert "neighbor" in files and "neighbour" not in files, "the file has its name now"
assert turned > len(faces) / 4, "normals point outwards now"
PY
