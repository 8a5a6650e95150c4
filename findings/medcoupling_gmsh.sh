#!/bin/sh
# MEDCoupling (Salome's library of meshes) and Gmsh: files of MED 4.2.
# One would guess that the newest Gmsh reads a cube that the newest MEDCoupling writes, since .med is a format of both, or names what is wrong.
# What happens: MEDCoupling 9.15 writes version 4.2.0. Gmsh 4.15.2 is built with the MED library 4.1.0, which refuses newer files, so Gmsh says "Unable to
# read mesh information"; lines in French on stderr name the versions. Files of MEDFileUMesh.write41 and older kinds are read. meshio reads
# all of them, inside out, and stops with a KeyError at wedges and pyramids of second order, hexahedra of 27 nodes and polyhedra.
# Who meets it: whoever goes from Salome 9.15 or code_aster's tools to Gmsh.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile medcoupling==9.15.0 gmsh==4.15.2 meshio==5.3.5 h5py==3.16.0 numpy==2.4.6
cd "$folder"
venv/bin/python - 2> errors <<'PY' || { cat errors; exit 1; }
import importlib.metadata

import gmsh
import h5py
import medcoupling
import meshio
import numpy as np

line = medcoupling.DataArrayDouble([0.0, 1.0])
grid = medcoupling.MEDCouplingCMesh("cube")
grid.setCoords(line, line, line)
cube = grid.buildUnstructured()
cube.setName("cube")
file = medcoupling.MEDFileUMesh()
file[0] = cube
gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
print("medcoupling", importlib.metadata.version("medcoupling"), "says that the volume is", cube.getMeasureField(False).getArray()[0])
found = {}
for name in ("write", "write41", "write40", "write33"):
    getattr(file, name)(name + ".med", 2)
    with h5py.File(name + ".med") as data:
        version = ".".join(str(int(data["INFOS_GENERALES"].attrs[key])) for key in ("MAJ", "MIN", "REL"))
    gmsh.clear()
    try:
        gmsh.merge(name + ".med")
        by_gmsh = sum(map(len, gmsh.model.mesh.getElements(3)[1]))
    except Exception as error:
        by_gmsh = str(error)
    mesh = meshio.read(name + ".med")
    a, b, _, d, e, *_ = mesh.points[mesh.cells_dict["hexahedron"][0]]
    found[version] = by_gmsh, float(np.linalg.det([b - a, d - a, e - a]))
print("by version, what Gmsh", gmsh.__version__, "reads, and the volume by meshio:", found)
gmsh.finalize()
assert found == {"4.2.0": ("Unable to read mesh information", -1.0), "4.1.1": (1, -1.0), "4.0.1": (1, -1.0), "3.3.0": (1, -1.0)}, "this has changed"
cube.convertAllToPoly()
cube.write("polyhedron.med")
try:
    meshio.read("polyhedron.med")
    raise SystemExit("meshio reads polyhedra now")
except KeyError as error:
    print("meshio and a polyhedron: KeyError", error)
PY
grep -q "_fversionMMR = 420" errors || { cat errors; exit 1; }
