#!/bin/sh
# PyElastica and a rod of radius 0.05 that comes down on the flat top of an upright cylinder of radius 0.5 (RodCylinderContact).
# One would guess that the force begins where the rod touches the top, grows with the depth, and points upwards, wherever on the top the rod is.
# What happens: with a gap of 0.01 left there is a force of 55,000, 14 times that of a rod 0.03 deep in the side. The top acts like a half ball of radius 0.5 round
# the end of the axis, cut off where bounding boxes end. So the force falls as the rod goes down, and at 0.3 beside the axis it points sideways. At a gap of
# 0.15 it is 0. The side of the cylinder is right. No warning is given.
# Who meets it: whoever lays a rod, an arm or a catheter on a table, a stub or a disk that is a cylinder: it is shot away as it arrives.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pyelastica==1.0.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'PY'
import importlib.metadata

import elastica as ea
import numpy as np

X, Y, Z = np.eye(3)


def force(y, z):
    """The force on a rod along x at y and z; the axis of the cylinder ends at the origin, and its top is at z = 0."""
    rod = ea.CosseratRod.straight_rod(20, np.array((-0.2, y, z)), X, Y, 0.4, base_radius=0.05, density=1000.0, youngs_modulus=1e6)
    cylinder = ea.Cylinder(np.array((0.0, 0.0, -1.0)), Z, X, 1.0, 0.5, 1000.0)
    ea.RodCylinderContact(k=1e4, nu=0.0).apply_contact(rod, cylinder)
    return [round(float(value)) for value in rod.external_forces.sum(axis=1)]


side = force(0.52, -0.5)
top = {z: force(0.0, z) for z in (0.2, 0.06, 0.04)}
beside = force(0.3, 0.04)
print("PyElastica", importlib.metadata.version("pyelastica"), "forces 0.03 deep in the side:", side, "above the middle of the top:", top, "0.3 beside the middle, 0.01 deep:", beside)
assert 3000 < side[1] < 5000 and side[2] == 0
assert top[0.2] == [0, 0, 0]
assert top[0.06][2] > 10 * side[1] and top[0.06][2] > top[0.04][2], "the top is flat now"
assert beside[1] > 5 * abs(beside[2]), "the top pushes upwards now"
PY
