#!/bin/sh
# PyElastica and a rod that lies on a drum (RodCylinderContact), and the vector "normal" that a Cylinder is made with.
# One would guess that this vector, which only says where round its axis the frame of the cylinder starts, has no part in contacts, for a drum is round.
# What happens: with the frame along the axes of the world a rod of short elements that is 0.05 deep in a drum of radius 1 feels the force. With the
# frame turned by 45 degrees round the axis there is none, and none down to a depth of 0.8; at 0.9 the whole force is there at once.
# A first test with boxes adds the sides of the turned cylinder with their signs, so the box can have no height. No warning is given.
# Who meets it: whoever lets a rod fall on, wind round or squeeze past a thick cylinder, if the elements are shorter than its radius; a cylinder that
# rolls gets and loses its contacts as it turns.
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
RADII = 1.05
DEPTHS = (0.05, 0.2, 0.4, 0.6, 0.8, 0.9)


def force(turn, depth):
    rod = ea.CosseratRod.straight_rod(
        20, np.array((-1.0, 0.0, RADII - depth)), X, Y, 2.0, base_radius=0.05, density=1000.0, youngs_modulus=1e6)
    normal = np.cos(np.radians(turn)) * X + np.sin(np.radians(turn)) * Z
    drum = ea.Cylinder(np.array((0.0, -1.0, 0.0)), Y, normal, 2.0, 1.0, 1000.0)
    ea.RodCylinderContact(k=1e4, nu=0.0).apply_contact(rod, drum)
    return round(float(rod.external_forces[2].sum()))


plain, turned = [[force(turn, depth) for depth in DEPTHS] for turn in (0, 45)]
print("PyElastica", importlib.metadata.version("pyelastica"), "upward forces at depths", DEPTHS, "with the frame along the axes", plain, "and turned by 45 degrees", turned)
assert all(value > 0 for value in plain)
assert turned[:5] == [0] * 5 and turned[5] == plain[5], "the frame has no part in contacts now"
PY
