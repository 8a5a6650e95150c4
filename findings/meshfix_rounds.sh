#!/bin/sh
# MeshFix (pymeshfix) and the unit of a surface.
# One would guess that a repair does not depend on the unit of length, and that triangles far from a fault keep their points.
# What happens: clean() rounds all coordinates to six digits behind the point, then to single precision, as soon as triangles cross anywhere. So a
# vessel in metres is moved by up to half a micrometre, and a surface of a few micrometres vanishes, while the same surface in millimetres
# is mended with care.
# Who meets it: everybody who repairs a surface in metres, or compares the repaired triangles with those from before.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q pymeshfix==0.18.1 numpy==2.2.6
"$folder/venv/bin/python" - <<'PY'
import itertools

import numpy as np
import pymeshfix

count = 16
angles = 2 * np.pi * np.arange(count) / count
rings = [[(np.sin(t) * np.cos(a), np.sin(t) * np.sin(a), np.cos(t)) for a in angles] for t in np.linspace(0, np.pi, 10)[1:-1]]
points = np.array([(0, 0, 1), *itertools.chain(*rings), (0, 0, -1)], float)
faces = [(0, 1 + i, 1 + (i + 1) % count) for i in range(count)]
for r in range(7):
    for i in range(count):
        a, b = 1 + r * count + i, 1 + r * count + (i + 1) % count
        faces += [(a, a + count, b), (b, a + count, b + count)]
faces += [(len(points) - 1, len(points) - 1 - count + (i + 1) % count, len(points) - 1 - count + i) for i in range(count)]
points[20] = -1.5 * points[20]  # this corner goes out through the other side
moved = {}
for unit in (1000.0, 1.0, 1e-3, 1e-6):
    tool = pymeshfix.PyTMesh()
    tool.set_quiet(True)
    tool.load_array(points * unit, np.array(faces, np.int32))
    tool.clean(10, 3)
    its, triangles = tool.return_arrays()
    distances = np.linalg.norm(its[:, None] / unit - points[None], axis=2).min(axis=1) if len(its) else np.array([np.inf])
    moved[unit] = np.sort(distances)[len(distances) // 2]
    print(f"radius {unit:g}: {len(triangles)} triangles are left, the middle point has moved by {moved[unit]:.1e} of the radius")
assert moved[1000.0] < 1e-7 < 1e-5 < moved[1e-3], "coordinates are not rounded any more"
PY
