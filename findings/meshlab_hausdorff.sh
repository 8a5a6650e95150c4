#!/bin/sh
# MeshLab (pymeshlab) and the Hausdorff distance of two cubes of side 1 beside each other.
# One would guess that `max` is the largest distance of a sampled vertex from the other cube: the gap and the side, so 1.1 for a gap of 0.1.
# What happens: `max` is 0.1, and for a gap of 2 it is 0, the answer for equal meshes. Samples that are farther away than `maxdist` are left out, whose
# default is half of the diagonal, and all that tells of it is `n_samples`, which is 4 and 0 of 8 vertices. No warning is given. A percentage above 100 is
# refused, but maxdist=PureValue(100) gives 1.1 and 3.
# Who meets it: whoever checks a registration, a simplification or a reconstruction by this number: the worse the fit, the smaller it is.
# Needs libgl1.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pymeshlab==2025.7.post1 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata
import itertools

import numpy as np
import pymeshlab

POINTS = np.array(list(itertools.product((0, 1), repeat=3)), float)
FACES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])


def distance(gap, **options):
    meshes = pymeshlab.MeshSet()
    for shift in (0, 1 + gap):
        meshes.add_mesh(pymeshlab.Mesh(POINTS + (shift, 0, 0), FACES))
    found = meshes.get_hausdorff_distance(sampledmesh=0, targetmesh=1, **options)
    return round(found["max"], 4), found["n_samples"]


by_default = {gap: distance(gap) for gap in (0.1, 2)}
far = {gap: distance(gap, maxdist=pymeshlab.PureValue(100)) for gap in (0.1, 2)}
print("pymeshlab", importlib.metadata.version("pymeshlab"), "largest distance and samples by gap:", by_default, "with maxdist 100:", far)
assert far == {0.1: (1.1, 8), 2: (3, 8)}
assert by_default == {0.1: (0.1, 4), 2: (0, 0)}, "far samples count now"
PY
