#!/bin/sh
# Manifold (manifold3d) and one mesh of two cubes that overlap in an eighth, as CAD and Blender export parts in one file.
# One would guess that a union with anything, or with itself, makes one solid of the volume 1.875: the library is known for booleans that do not fail.
# What happens: the mesh has the volume 2 and the status NoError. A union with a cube far away leaves the overlap counted twice (3 in place of 2.875), and
# the union with itself takes it out twice (1.75): it is a hole there. decompose() and the union of its two parts give 1.875.
# Who meets it: whoever joins or cuts models of several shells by trimesh, OpenSCAD or this library, and prints or weighs the result.
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

POINTS = np.array(list(itertools.product((0, 1), repeat=3)), np.float32)
FACES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)], np.uint32)
both = manifold3d.Manifold(manifold3d.Mesh(vert_properties=np.concatenate([POINTS, POINTS + np.float32(0.5)]), tri_verts=np.concatenate([FACES, FACES + np.uint32(8)])))
far = manifold3d.Manifold.cube((1, 1, 1)).translate((9, 0, 0))
parts = both.decompose()
made = {"itself": both, "and a cube far away": both + far, "and itself": both + both, "its parts": parts[0] + parts[1]}
found = {name: round(one.volume(), 4) for name, one in made.items()}
print("manifold3d", importlib.metadata.version("manifold3d"), "volumes:", found)
assert all(one.status() == manifold3d.Error.NoError for one in made.values()) and found["its parts"] == 1.875
assert (found["itself"], found["and a cube far away"], found["and itself"]) == (2, 3, 1.75), "overlaps are resolved now"
PY
