#!/bin/sh
# Gmsh and polyhedra in MED files, as Salome's and code_saturne's tools write them.
# One would guess that a reader which has no polyhedra stops at them, or says that it leaves them out, as it does with cells of other kinds.
# What happens: of eight cubes, two of them polyhedra, Gmsh has six, and of a boundary of polygons nothing. It ends without an error or a
# warning, so the mesh has two holes and the group "lumen", which had three cells, has one.
# Who meets it: whoever brings cut or refined meshes, or those of code_saturne's preprocessor, to Gmsh, or converts them by it.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile medcoupling==9.15.0 gmsh==4.15.2 numpy==2.4.6
cd "$folder"
venv/bin/python - <<'PY'
import importlib.metadata

import gmsh
import medcoupling

line = medcoupling.DataArrayDouble([0.0, 1.0, 2.0])
grid = medcoupling.MEDCouplingCMesh("cubes")
grid.setCoords(line, line, line)
cubes = grid.buildUnstructured()
cubes.convertToPolyTypes(medcoupling.DataArrayInt([6, 7]))
cubes.setName("cubes")
sides = cubes.buildDescendingConnectivity()[0]
sides.convertAllToPoly()
sides.setName("cubes")
file = medcoupling.MEDFileUMesh()
file[0], file[-1] = cubes, sides
lumen = medcoupling.DataArrayInt([5, 6, 7])
lumen.setName("lumen")
file.setGroupsAtLevel(0, [lumen])
file.write41("cubes.med", 2)

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.merge("cubes.med")
log = [line for line in gmsh.logger.get() if line.startswith(("Warning", "Error"))]
cells, faces = (sum(map(len, gmsh.model.mesh.getElements(dimension)[1])) for dimension in (3, 2))
groups = {}
for dimension, number in gmsh.model.getPhysicalGroups(3):
    entities = gmsh.model.getEntitiesForPhysicalGroup(dimension, number)
    groups[gmsh.model.getPhysicalName(dimension, number).strip()] = sum(len(own) for entity in entities for own in gmsh.model.mesh.getElements(3, int(entity))[1])
print("medcoupling", importlib.metadata.version("medcoupling"), "wrote", cubes.getNumberOfCells(), "cells and", sides.getNumberOfCells(), "sides; gmsh", gmsh.__version__, "has", cells, "and", faces, groups, log)
gmsh.finalize()
assert cubes.getNumberOfCells() == 8 and cells == 6 and faces == 0 and groups.get("lumen") == 1, "polyhedra are read now"
assert not log, "this is told now"
PY
