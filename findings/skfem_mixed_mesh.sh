#!/bin/sh
# scikit-fem and a mesh of several types of cells, as meshio has it: a hexahedron, a pyramid on it and a tetrahedron beside it.
# One would guess that the mesh has the three cells, or that a library whose meshes have one type of cells refuses it.
# What happens: it is a mesh of the hexahedron alone. The two others are left out without a warning or a word on the log, so their volume is missing, and
# where they were joined there is a free boundary. Of a hexahedron and a wedge, or a tetrahedron and a pyramid, one is left, too.
# Who meets it: whoever loads meshes with boundary layers, or with pyramids between hexahedra and tetrahedra, by Mesh.load.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile scikit-fem==12.0.2 meshio==5.3.5 numpy==2.4.6 scipy==1.17.1
"$folder/venv/bin/python" - "$folder/mixed.vtu" <<'PY'
import contextlib
import importlib.metadata
import io
import logging
import sys
import warnings

import meshio
import numpy as np
import skfem

POINTS = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)] + [(0.5, 0.5, 2)], float)
CELLS = {
    "hexahedron": [[0, 1, 4, 3, 6, 7, 10, 9]], "pyramid": [[6, 7, 10, 9, 12]], "tetra": [[1, 2, 4, 7]], "wedge": [[1, 2, 4, 7, 8, 10]],
}
log = io.StringIO()
logging.basicConfig(stream=log, level=logging.WARNING)
found = {}
for kinds in (("hexahedron", "pyramid", "tetra"), ("hexahedron", "wedge"), ("tetra", "pyramid")):
    meshio.write(sys.argv[1], meshio.Mesh(POINTS, [(kind, CELLS[kind]) for kind in kinds]))
    with warnings.catch_warnings(record=True) as told, contextlib.redirect_stderr(log), contextlib.redirect_stdout(log):
        warnings.simplefilter("always")
        mesh = skfem.Mesh.load(sys.argv[1])
    found[" ".join(kinds)] = type(mesh).__name__, mesh.nelements, len(told)
print("scikit-fem", importlib.metadata.version("scikit-fem"), "class, cells and warnings:", found, "log:", repr(log.getvalue()))
assert all(count == 1 for _, count, _ in found.values()), "all cells are kept now"
assert not any(told for *_, told in found.values()) and "pyramid" not in log.getvalue(), "this is told now"
PY
