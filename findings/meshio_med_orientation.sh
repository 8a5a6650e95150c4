#!/bin/sh
# meshio and tetrahedra of MED files.
# One would guess that a mesh by Gmsh has positive volumes after meshio has read its .med file, as after reading its .msh file, and that
# Gmsh finds positive volumes in what meshio writes as .med.
# What happens: MED numbers cells the other way round, and meshio neither reads nor writes them so. All volumes are negative, both ways.
# Who meets it: whoever exchanges meshes with Salome or code_aster through meshio and needs signs: Jacobians, normals, inside tests.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q gmsh==4.15.2 meshio==5.3.5 h5py==3.16.0
"$folder/venv/bin/python" - "$folder" <<'PY'
import sys
import gmsh
import meshio
import numpy as np


def volumes(points, cells):
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
gmsh.model.occ.synchronize()
gmsh.model.addPhysicalGroup(3, [1], 1, "box")
gmsh.model.mesh.generate(3)
negative = {}
for ending in ("msh", "med"):
    gmsh.write(f"{sys.argv[1]}/box.{ending}")
    mesh = meshio.read(f"{sys.argv[1]}/box.{ending}")
    found = volumes(mesh.points, mesh.cells_dict["tetra"])
    negative[ending] = float(np.mean(found < 0))
one = meshio.Mesh(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float), [("tetra", [[0, 1, 2, 3]])])
one.write(f"{sys.argv[1]}/one.med")
gmsh.clear()
gmsh.merge(f"{sys.argv[1]}/one.med")
tags, places, _ = gmsh.model.mesh.getNodes()
place = dict(zip(tags.tolist(), places.reshape(-1, 3)))
(nodes,) = gmsh.model.mesh.getElements(3)[2]
written = volumes(np.array([place[int(node)] for node in nodes]), np.array([[0, 1, 2, 3]]))[0]
print("meshio", meshio.__version__, "gmsh", gmsh.__version__, "share of negative volumes after", negative, "and in Gmsh after meshio:", written)
gmsh.finalize()
assert negative == {"msh": 0.0, "med": 1.0} and written < 0, "this has changed"
PY
