#!/bin/sh
# Gmsh and wedges and pyramids in LS-DYNA's keyword files (.key).
# One would guess that a hexahedron, a wedge, a pyramid and a tetrahedron are four solids after a .key file was written without a word, and that a
# wedge of volume 0.5 is a brick with two pairs of equal nodes whose volume is 0.5.
# What happens: the pyramid is left out. The wedge of the triangles a b c and d e f is written as a b c d e e f f, whose base a b c d is no side of it:
# the brick is twisted and has volume 1/3, and there are gaps between it and its neighbours. Ten nodes of a tetrahedron are broken over two
# rows, the first of which has eight nodes and is a brick for LS-DYNA; the second is taken for an element. There is no warning.
# Who meets it: whoever brings boundary layers or extrusions from Gmsh to LS-DYNA: mass is lost, and contacts at such layers are where no wall is.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile gmsh==4.15.2 numpy==2.4.6
"$folder/venv/bin/python" - "$folder" <<'PY'
import itertools
import sys

import gmsh
import numpy as np

BASE, TRIANGLE = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 0), (1, 0), (0, 1)]
CELLS = {  # Gmsh's types
    5: [(*p, z) for z in (0, 1) for p in BASE],
    6: [(*p, z) for z in (0, 1) for p in TRIANGLE],
    7: [*((*p, 0) for p in BASE), (0.5, 0.5, 1)],
    4: [*((*p, 0) for p in TRIANGLE), (0, 0, 1)],
}
SIGNS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])


def determinants(points):
    """The determinants of a brick's map at the eight points that integrate it."""
    found = []
    for place in itertools.product((-(3**-0.5), 3**-0.5), repeat=3):
        factors = 1 + SIGNS * place
        slopes = np.stack([SIGNS[:, i] * np.prod(np.delete(factors, i, axis=1), axis=1) / 8 for i in range(3)])
        found.append(np.linalg.det(slopes @ points))
    return np.array(found)


def written(kinds, order):
    """Points of nodes, and the rows of all solids of a file."""
    gmsh.clear()
    for tag, kind in enumerate(kinds, 1):
        gmsh.model.addDiscreteEntity(3, tag)
        nodes = np.arange(len(CELLS[kind])) + 10 * tag
        gmsh.model.mesh.addNodes(3, tag, nodes, np.ravel(CELLS[kind]))
        gmsh.model.mesh.addElementsByType(tag, kind, [tag], nodes)
    gmsh.model.mesh.setOrder(order)
    gmsh.write(f"{sys.argv[1]}/cells.key")
    blocks = [block.splitlines() for block in open(f"{sys.argv[1]}/cells.key").read().split("*")]
    nodes = {int(row.split(",")[0]): [float(word) for word in row.split(",")[1:4]] for block in blocks if block[:1] == ["NODE"] for row in block[1:]}
    return nodes, [[int(word) for word in row.split(",") if word.strip()] for block in blocks if block[:1] == ["ELEMENT_SOLID"] for row in block[1:] if row[0] != "$"]


gmsh.initialize(readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("Mesh.SaveAll", 1)
gmsh.logger.start()
nodes, rows = written([5, 6, 7, 4], 1)
wedge = next(row[2:] for row in rows if row[0] == 2)
turned = determinants(np.array([nodes[node] for node in wedge]))
right = determinants(np.array(CELLS[6])[[0, 1, 2, 2, 3, 4, 5, 5]])
_, split = written([4], 2)
print("gmsh", gmsh.__version__, "writes solids", [row[0] for row in rows], "the wedge as", wedge, "with volume", turned.sum(), "and ten nodes as", split)
assert right.min() > 0 and np.isclose(right.sum(), 0.5)
assert [row[0] for row in rows] == [1, 2, 4], "the pyramid is written now"
assert np.isclose(turned.sum(), 1 / 3), "the wedge is another one now"
assert [len(row) for row in split] == [11, 1], "ten nodes have another form now"
assert not any(line.startswith(("Warning", "Error")) for line in gmsh.logger.get()), "this is told now"
gmsh.finalize()
PY
