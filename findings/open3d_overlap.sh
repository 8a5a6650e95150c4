#!/bin/sh
# Open3D's RaycastingScene with two closed cubes that overlap in a corner, each added by add_triangles of its own.
# One would guess that a place inside of both cubes is inside: the scene has two bodies, each of them closed and facing outwards.
# What happens: compute_occupancy gives 0 there and compute_signed_distance +0.25, as in the open. Both count the walls on a ray, and two bodies have two.
# More rays (nsamples=11) change nothing, for all of them agree. In one cube only, the signs are right. A small cube inside of a large one is outside, too.
# Who meets it: whoever fits, samples or pushes by the distance to a scene of several things, such as organs or parts of an assembly.
# Needs libusb-1.0-0 and libgl1.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile open3d==0.20.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import itertools

import numpy as np
import open3d

POINTS = np.array(list(itertools.product((0, 1), repeat=3)), np.float32)
FACES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)], np.uint32)
PLACES = {"overlap": (0.75, 0.75, 0.75), "first only": (0.25, 0.25, 0.25), "second only": (1.25, 1.25, 1.25), "neither": (2, 2, 2)}


def answers(second):
    """Occupancy and the sign of the distance at each place, for a cube and another one with the given points."""
    scene = open3d.t.geometry.RaycastingScene()
    for points in (POINTS, second):
        scene.add_triangles(open3d.core.Tensor(points.astype(np.float32)), open3d.core.Tensor(FACES))
    places = open3d.core.Tensor(np.array(list(PLACES.values()), np.float32))
    inside = scene.compute_occupancy(places, nsamples=11).numpy()
    distance = scene.compute_signed_distance(places, nsamples=11).numpy()
    return {name: (int(inside[i]), int(np.sign(distance[i]))) for i, name in enumerate(PLACES)}


overlapping, nested = answers(POINTS + 0.5), answers(0.4 + 0.5 * POINTS)
print("Open3D", open3d.__version__, "occupancy and sign, of cubes that overlap:", overlapping, "of a cube in the first one:", nested)
assert overlapping["first only"] == overlapping["second only"] == (1, -1) and overlapping["neither"] == (0, 1)
assert overlapping["overlap"] == nested["overlap"] == (0, 1), "places in both are inside now"
PY
