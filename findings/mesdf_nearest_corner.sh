#!/bin/sh
# mesdf (pysdf with wheels for newer Pythons), the signed distance of a mesh as a function, with places inside as positive ones.
# One would guess that the number is the distance to the nearest triangle: the package says nothing of an approximation, and its option robust is on.
# What happens: only triangles round the nearest corner are looked at. At 0.1 above the middle of a plate of 10 x 10, whose corners are far away, the number
# is -1.2: the distance from a small cube that hovers 1.3 above it. The plate alone gives -0.1. A cube whose triangles have points of their own, as STL files
# have them, gives wrong numbers for more than half of the places round it, too large by up to 1.2 for a side of 2, and without robust the sign is wrong for
# a third of them. The cube with shared points is right. No warning is given.
# Who meets it: whoever keeps particles, hairs or grippers out of large flat triangles, such as floors, boxes and CAD parts, next to finer things.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile mesdf==0.1.10 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata
import itertools

import mesdf
import numpy as np

CORNERS = np.array(list(itertools.product((-0.5, 0.5), repeat=3)))
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
TRIANGLES = np.array([corners for a, b, c, d in SIDES for corners in ((a, b, c), (a, c, d))])


def distances(points, triangles, places, robust=True):
    function = mesdf.SDF(np.ascontiguousarray(points, np.float32), np.ascontiguousarray(triangles, np.uint32), robust)
    return function(np.ascontiguousarray(places, np.float32)).astype(float)


plate, above = CORNERS * (10, 0.2, 10), CORNERS * 0.2 + (0, 1.5, 0)
heights = np.array([0.2, 0.4, 0.6, 1.2])
column = np.stack([0 * heights, heights, 0 * heights], axis=1)
alone = distances(plate, TRIANGLES, column)
both = distances(np.vstack([plate, above]), np.vstack([TRIANGLES, TRIANGLES + 8]), column)
right = -np.minimum(heights - 0.1, 1.4 - heights)

places = np.random.default_rng(0).uniform(-2, 2, (20000, 3))
out = np.abs(places) - 1
true = -np.linalg.norm(np.maximum(out, 0), axis=1) - np.minimum(out.max(axis=1), 0)
shared, apart = (2 * CORNERS, TRIANGLES), (2 * CORNERS[TRIANGLES].reshape(-1, 3), np.arange(36).reshape(-1, 3))
cubes = {}
for name, mesh in (("shared", shared), ("apart", apart)):
    given, plain = distances(*mesh, places), distances(*mesh, places, robust=False)
    errors = np.abs(np.abs(given) - np.abs(true))
    cubes[name] = [round(float(number), 2) for number in ((errors > 0.001).mean(), errors.max(), (np.sign(given) != np.sign(true)).mean(), (np.sign(plain) != np.sign(true)).mean())]
print("mesdf", importlib.metadata.version("mesdf"), "above a plate:", alone.round(2).tolist(), "with a cube above:", both.round(2).tolist(), "true:", right.round(2).tolist())
print("cube of side 2, wrong distances, largest error, wrong signs, and those without robust, by points:", cubes)
assert np.abs(alone - (0.1 - heights)).max() < 1e-5
assert abs(both[0] + 1.2) < 1e-3 and right[0] == -0.1, "the plate is found now"
assert cubes["shared"] == [0, 0, 0, 0]
assert cubes["apart"][0] > 0.5 and cubes["apart"][1] > 1 and cubes["apart"][3] > 0.3, "triangles with points of their own are found now"
PY
