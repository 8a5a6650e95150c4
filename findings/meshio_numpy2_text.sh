#!/bin/sh
# meshio 5.3.5 with NumPy 2, and files of text.
# One would guess that a file does not depend on the NumPy that is installed, because meshio asks for NumPy 1.20 or newer.
# What happens: since NumPy 2 a number's repr is "np.float64(5.0)", and meshio writes that word into .ugrid files, and with data into .msh as text
# (2.2 and 4.1), .mdpa and DOLFIN's .xml. Nothing is told when they are written. Gmsh refuses the .msh files, and meshio
# itself all but the .mdpa file, of which it never reads the data. With NumPy 1.26.4 the same call writes files that can be read.
# Who meets it: whoever writes fields or materials for Gmsh, Kratos, FEniCS or AFLR tools, and has updated NumPy.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/texts.py" <<'PY'
import contextlib
import io
import sys

import gmsh
import meshio
import numpy as np

points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
kinds = {"gmsh22": ("msh", {"binary": False}), "gmsh": ("msh", {"binary": False}), "mdpa": ("mdpa", {}), "dolfin-xml": ("xml", {}), "ugrid": ("ugrid", {})}
words, by_meshio, by_gmsh = {}, {}, {}
gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
for kind, (ending, options) in kinds.items():
    mesh = meshio.Mesh(points, [("tetra", np.array([[0, 1, 2, 3]]))], cell_data={"stiffness": [np.array([5.0])]})
    name = f"{sys.argv[1]}/{kind}.{ending}"
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        meshio.write(name, mesh, file_format=kind, **options)
        files = [name, name.replace(".xml", "_stiffness.xml")][: 2 if ending == "xml" else 1]
        words[kind] = any("np.float64(" in open(file).read() for file in files)
        try:
            found = meshio.read(name, file_format="gmsh" if ending == "msh" else kind)
            by_meshio[kind] = [float(values[0]) for data in found.cell_data.values() for values in data]
        except Exception as error:
            by_meshio[kind] = type(error).__name__
    if ending == "msh":
        try:
            gmsh.clear()
            gmsh.merge(name)
            by_gmsh[kind] = sum(map(len, gmsh.model.mesh.getElements(3)[1]))
        except Exception as error:
            by_gmsh[kind] = type(error).__name__
gmsh.finalize()
print("NumPy", np.__version__, "meshio", meshio.__version__, "the word is in", [kind for kind in kinds if words[kind]], "meshio reads", by_meshio, "Gmsh reads", by_gmsh)
if np.__version__.startswith("1."):
    assert not any(words.values()) and by_gmsh == {"gmsh22": 1, "gmsh": 1}, "NumPy 1 does this, too"
else:
    assert all(words.values()) and by_gmsh == {"gmsh22": "Exception", "gmsh": "Exception"}, "files are as with NumPy 1 now"
    assert all(isinstance(by_meshio[kind], str) for kind in kinds if kind != "mdpa") and by_meshio["mdpa"] == [], "files can be read now"
PY
for numpy in 1.26.4 2.4.6; do
  python3 -m venv "$folder/$numpy"
  "$folder/$numpy/bin/pip" install -q --no-compile "numpy==$numpy" meshio==5.3.5 gmsh==4.15.2
  mkdir "$folder/of-$numpy"
  "$folder/$numpy/bin/python" "$folder/texts.py" "$folder/of-$numpy"
done
