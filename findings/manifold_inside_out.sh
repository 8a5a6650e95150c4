#!/bin/sh
# Manifold (manifold3d), whose promise is that booleans of manifold input are manifold, and a tool whose triangles face inwards.
# One would guess that a mesh that is inside out is an error, as an open one is (NotManifold), or that it is turned.
# What happens: its status is NoError and its volume is -1. A block of 27 less this cube has the volume 28: the cut adds a second layer, where it should
# leave 26. The union is 27, and what both share is -1. No error is raised at any step.
# Who meets it: whoever cuts by tools of STL or scans that face inwards, or that were mirrored, without a look at the sign of volume().
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile manifold3d==3.5.4 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata
import itertools

import manifold3d
import numpy as np

POINTS = np.array(list(itertools.product((-0.5, 0.5), repeat=3)), np.float32)
FACES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)], np.uint32)


def solid(faces):
    return manifold3d.Manifold(manifold3d.Mesh(vert_properties=POINTS, tri_verts=np.ascontiguousarray(faces)))


block, found = manifold3d.Manifold.cube((3, 3, 3), True), {}
for name, tool in (("outwards", solid(FACES)), ("inwards", solid(FACES[:, ::-1]))):
    made = tool, block - tool, block + tool, block ^ tool
    assert all(one.status() == manifold3d.Error.NoError for one in made), "this is an error now"
    found[name] = [round(one.volume(), 4) for one in made]
print("manifold3d", importlib.metadata.version("manifold3d"), "volumes of the tool, of the block less it, of both, of what they share:", found)
assert solid(FACES[1:]).status() == manifold3d.Error.NotManifold and found["outwards"] == [1, 26, 27, 1]
assert found["inwards"] == [-1, 28, 27, -1], "it is turned now"
PY
