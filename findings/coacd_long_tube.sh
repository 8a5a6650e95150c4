#!/bin/sh
# CoACD, which takes a mesh apart into convex parts for contacts, and a tube with radii 0.1 and 0.15, in several lengths.
# One would guess that the bore stays free in all of them: the threshold is a depth of hollows, and the bore has one depth, whatever the length.
# What happens: up to a length of 3.5 there are four or eight parts round the bore. From 4 on there is one part, the solid rod, with 1.8 times the volume of
# the wall, and no axis is free. The short tube, whose bore is free in eight parts, is filled, too, once a second one lies 20 away in the same mesh.
# Lengths are measured as parts of the size of the whole mesh, so the threshold 0.05, the default, forgives deeper hollows in larger things. No warning is
# given. With real_metric=True the bore stays free at all lengths, and longer tubes have more parts.
# Who meets it: whoever prepares vessels, pipes, cups or a whole scene for MuJoCo, PyBullet, Drake or Isaac: what was inside is thrown out, or is never let in.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile coacd==1.0.14 numpy==2.4.6 scipy==1.17.1
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata

import coacd
import numpy as np
from scipy.spatial import ConvexHull

coacd.set_log_level("error")
ROUND = 16
ANGLES = np.linspace(0, 2 * np.pi, ROUND, endpoint=False)


def tube(length, start=0.0):
    rings = ((0.1, 0), (0.1, length), (0.15, length), (0.15, 0))
    points = np.vstack([np.stack([r * np.cos(ANGLES), r * np.sin(ANGLES), np.full(ROUND, start + z)], axis=1) for r, z in rings])
    triangles = []
    for ring in range(4):
        for i in range(ROUND):
            a, b = ring * ROUND + i, ring * ROUND + (i + 1) % ROUND
            c, d = (a + ROUND) % len(points), (b + ROUND) % len(points)
            triangles += [(a, c, b), (b, c, d)]
    return points, np.array(triangles)


def volume(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def parts(points, triangles, height, **options):
    hulls = [ConvexHull(part[0]) for part in coacd.run_coacd(coacd.Mesh(points, triangles), **options)]
    place = np.array([0.003, 0.002, height])
    inside = any((hull.equations[:, :3] @ place + hull.equations[:, 3] < -1e-6).all() for hull in hulls)
    return len(hulls), round(sum(hull.volume for hull in hulls) / volume(points, triangles), 2), "filled" if inside else "free"


tubes = {length: parts(*tube(length), length / 2) for length in (1, 2, 3, 4, 8)}
real = {length: parts(*tube(length), length / 2, real_metric=True) for length in (1, 4, 16)}
(near, first), (far, second) = tube(1), tube(1, 20)
both = parts(np.vstack([near, far]), np.vstack([first, second + len(near)]), 0.5)
print("coacd", importlib.metadata.version("coacd"), "parts, their volume by that of the wall, and the bore, by length:", tubes, "of two short tubes:", both, "with real_metric:", real)
assert all(volume(*tube(length)) > 0 for length in tubes)
assert [tubes[length][2] for length in (1, 2, 3)] == ["free"] * 3
assert all(tubes[length][0] == 1 and tubes[length][1] > 1.7 and tubes[length][2] == "filled" for length in (4, 8)), "the bore of long tubes is free now"
assert both[::2] == (2, "filled"), "a mesh of two tubes has both free now"
assert all(made[2] == "free" for made in real.values())
PY
