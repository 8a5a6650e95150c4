#!/bin/sh
# Gmsh, meshio and points of Nastran that are given in a coordinate system of the file.
# One would guess that a quarter of a cylinder, with points by radius, degrees and height (CORD2C, field CP of GRID), comes out as one, or that a
# reader says that it can not.
# What happens: both take the three numbers as x, y and z, so 90 degrees become y = 90, and the volume of a plain hexahedron is 60 times too
# large. The field CP, the default of GRDSET and the CORD cards are left out without a warning.
# Who meets it: whoever has .bdf files of shafts, pipes or vessels of Patran, Femap or by hand, where cylindrical systems are usual.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile gmsh==4.15.2 meshio==5.3.5 numpy==2.4.6
"$folder/venv/bin/python" - "$folder/quarter.bdf" <<'PY'
import sys

import gmsh
import meshio
import numpy as np

places = [(r, angle, z) for z in (0.0, 1.0) for r, angle in ((1.0, 0.0), (2.0, 0.0), (2.0, 90.0), (1.0, 90.0))]
with open(sys.argv[1], "w") as file:
    file.write("BEGIN BULK\nCORD2C,7,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRDSET,,7\n")
    file.writelines(f"GRID,{i},7,{r},{angle},{z}\n" if i % 2 else f"GRID,{i},,{r},{angle},{z}\n" for i, (r, angle, z) in enumerate(places, 1))
    file.write("CHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\nMAT1,1,1.,,.3\nENDDATA\n")

gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.merge(sys.argv[1])
log = gmsh.logger.get()
by_gmsh = gmsh.model.mesh.getNodes()[1].reshape(-1, 3)
_, determinants, _ = gmsh.model.mesh.getJacobians(5, *[gmsh.model.mesh.getIntegrationPoints(5, "Gauss4")[0]])
volume = float(np.abs(determinants) @ gmsh.model.mesh.getIntegrationPoints(5, "Gauss4")[1])
gmsh.finalize()
by_meshio = meshio.read(sys.argv[1]).points
x, y = np.array([(r * np.cos(np.radians(a)), r * np.sin(np.radians(a))) for r, a, _ in places[:4]]).T
expected = float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)
print("gmsh", gmsh.__version__, "meshio", meshio.__version__, "point 3 is", by_gmsh[2], by_meshio[2], "volume", volume, "of", expected)
assert np.allclose(by_gmsh, places) and np.allclose(by_meshio, places), "systems are read now"
assert not any(line.startswith(("Warning", "Error")) for line in log), "this is told now"
PY
