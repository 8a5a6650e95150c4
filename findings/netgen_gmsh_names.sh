#!/bin/sh
# Netgen and the files that it writes for Gmsh: names of materials and boundaries, and which way round tetrahedra are.
# One would guess that the material 1, "tissue", becomes the physical group 1, "tissue", that the two boundary conditions are two
# groups, and that tetrahedra have positive volumes.
# What happens: with "Gmsh2 Format" materials become the groups 100001 and 100002 without names, and each of the faces of the geometry is a group, whatever
# its boundary condition. All tetrahedra are inside out, since Netgen numbers them the other way round. No warning is given. In its own .vol
# file names and numbers are there; "Abaqus Format" keeps the names.
# Who meets it: whoever meshes with Netgen or NGSolve and goes on by Gmsh, meshio or FEniCS, and asks for "tissue" or for material 1.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile netgen-mesher==6.2.2608 gmsh==4.15.2 numpy==2.4.6
cd "$folder"
venv/bin/python - <<'PY'
import importlib.metadata

from netgen.csg import CSGeometry, OrthoBrick, Pnt

geometry = CSGeometry()
for x, material, boundary in ((0, "tissue", "outer"), (1, "bone", "end")):
    geometry.Add(OrthoBrick(Pnt(x, 0, 0), Pnt(x + 1, 1, 1)).mat(material).bc(boundary))
mesh = geometry.GenerateMesh(maxh=1)
mesh.Export("two.msh", "Gmsh2 Format")
mesh.Save("two.vol")
conditions, text = set(mesh.GetRegionNames(codim=1)), open("two.vol").read()
print("netgen", importlib.metadata.version("netgen-mesher"), "has", [mesh.GetMaterial(1), mesh.GetMaterial(2)], sorted(conditions))
assert conditions == {"outer", "end"} and all(name in text for name in ("tissue", "bone", "outer", "end"))
PY
venv/bin/python - <<'PY'
import gmsh

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.merge("two.msh")
groups = {dimension: [(number, gmsh.model.getPhysicalName(dimension, number)) for _, number in gmsh.model.getPhysicalGroups(dimension)] for dimension in (2, 3)}
_, determinants, _ = gmsh.model.mesh.getJacobians(4, gmsh.model.mesh.getIntegrationPoints(4, "Gauss1")[0])
print("gmsh", gmsh.__version__, "has groups", groups, "and determinants of tetrahedra up to", determinants.max())
assert groups[3] == [(100001, ""), (100002, "")], "materials are kept now"
assert len(groups[2]) > 2 and not any(name for _, name in groups[2]), "boundaries are kept now"
assert determinants.max() < 0, "tetrahedra are the right way round now"
gmsh.finalize()
PY
