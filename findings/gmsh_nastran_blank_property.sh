#!/bin/sh
# Gmsh and Nastran elements whose property is left blank, which means that it has the element's number.
# One would guess that all 16 tetrahedra are read; meshio writes such files, and reads all 16 back.
# What happens: Gmsh reads 8, every other one, without a warning.
# Who meets it: whoever converts a mesh to .bdf by meshio and opens it in Gmsh, or converts it on.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q gmsh==4.15.2 meshio==5.3.5
"$folder/venv/bin/python" - "$folder/cells.bdf" <<'PY'
import sys
import gmsh
import meshio
import numpy as np

corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
points = np.concatenate([corners + (2 * i, 0, 0) for i in range(16)])
meshio.write(sys.argv[1], meshio.Mesh(points, [("tetra", np.arange(64).reshape(16, 4))]))
print("".join(line for line in open(sys.argv[1]) if line.startswith("CTETRA"))[:150])
gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.merge(sys.argv[1])
count = sum(map(len, gmsh.model.mesh.getElements(3)[1]))
log = gmsh.logger.get()
print("gmsh", gmsh.__version__, "reads", count, "of 16 and says", log)
assert count == 8 and not any(line.startswith(("Warning", "Error")) for line in log), "this has changed"
gmsh.finalize()
assert len(meshio.read(sys.argv[1]).cells_dict["tetra"]) == 16
PY
