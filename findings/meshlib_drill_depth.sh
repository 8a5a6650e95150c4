#!/bin/sh
# MeshLib's signed distance of two meshes (findSignedDistance): a bar that is pushed through a cube of side 1, and two such cubes that overlap by half.
# One would guess that the number is negative as long as the two are in one another, and no smaller in size as the bar goes on: it is called positive if
# meshes do not collide.
# What happens: with its end at 0.3 below the surface the bar has -0.3, at 0.9 only -0.1, and from the far side on, with a hole right through the cube, 0.
# What is measured are corners of either mesh within the other, each by its own way out, so for a bar that has the same form in finer triangles it
# is -0.48. A cube and its copy that is shifted by half along x have 0, too, and the status Touching, where their intersection has the volume 0.5. No warning is given.
# Who meets it: whoever limits, plans or displays the depth of drills, screws, needles and beams that cross, or checks parts on round coordinates: 0 reads
# like a touch.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile meshlib==3.1.4.297 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata
import itertools

import numpy as np
from meshlib import mrmeshnumpy
from meshlib import mrmeshpy as mr

CORNERS = np.array(list(itertools.product((-0.5, 0.5), repeat=3)))
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
TRIANGLES = np.array([corners for a, b, c, d in SIDES for corners in ((a, b, c), (a, c, d))], np.int32)


def box(size, place):
    return mrmeshnumpy.meshFromFacesVerts(TRIANGLES, CORNERS * size + place)


def ask(other):
    found = mr.findSignedDistance(mr.MeshPart(cube), mr.MeshPart(other))
    return round(found.signedDist, 3) + 0.0, str(found.status).partition(".")[2]


cube = box((1, 1, 1), (0, 0, 0))
assert abs(cube.volume() - 1) < 1e-6
bars = {depth: ask(box((3, 0.2, 0.2), (2 - depth, 0, 0))) for depth in (-0.1, 0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.5)}
finer, how = box((3, 0.2, 0.2), (0.5, 0, 0)), mr.SubdivideSettings()
how.maxEdgeLen, how.maxEdgeSplits = 0.1, 100000
mr.subdivideMesh(finer, how)
cubes = {}
for shift in (0.5, 0.9, 1.1):
    copy = box((1, 1, 1), (shift, 0, 0))
    cubes[shift] = *ask(copy), round(mr.boolean(cube, copy, mr.BooleanOperation.Intersection).mesh.volume(), 3)
print("meshlib", importlib.metadata.version("meshlib"), "signed distance by depth of the bar's end:", bars, "at 1.5, in finer triangles:", ask(finer), "two cubes by shift, with the volume of both:", cubes)
assert bars[-0.1] == (0.1, "BothOutside")
assert [bars[depth] for depth in (0.1, 0.3, 0.5, 0.7, 0.9)] == [(depth, "Colliding") for depth in (-0.1, -0.3, -0.4, -0.3, -0.1)]
assert bars[1.1] == bars[1.5] == (0, "Colliding"), "a bar right through the cube has a depth now"
assert ask(finer)[0] < -0.4
assert cubes == {0.5: (0, "Touching", 0.5), 0.9: (0, "Touching", 0.1), 1.1: (0.1, "BothOutside", 0)}, "cubes that share planes of sides are told apart now"
PY
