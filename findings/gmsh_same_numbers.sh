#!/bin/sh
# Gmsh and a mesh in which elements have the same number.
# One would guess that both tetrahedra are there, or that reading fails.
# What happens: one tetrahedron is left. Gmsh says "2 elements" and gives no warning. meshio reads both.
# Who meets it: whoever reads .msh files of programs that write one number for all elements; such files are among SOFA's meshes.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q gmsh==4.15.2 meshio==5.3.5
cat > "$folder/two.msh" <<'MSH'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0 0 -1
$EndNodes
$Elements
2
4 4 2 0 1 1 2 3 4
4 4 2 0 1 1 3 2 5
$EndElements
MSH
"$folder/venv/bin/python" - "$folder/two.msh" <<'PY'
import sys
import gmsh
import meshio

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.merge(sys.argv[1])
count = sum(map(len, gmsh.model.mesh.getElements(3)[1]))
log = gmsh.logger.get()
print("gmsh", gmsh.__version__, "keeps", count, "and says", log)
assert count == 1 and not any(line.startswith(("Warning", "Error")) for line in log), "this has changed"
gmsh.finalize()
assert len(meshio.read(sys.argv[1]).cells_dict["tetra"]) == 2
PY
