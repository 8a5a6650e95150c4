#!/bin/sh
# PyElastica and a ball beside a straight rod (RodSphereContact): a rod from x = 0 to x = 1 in four elements.
# One would guess that a ball that overlaps the rod feels the same force wherever it is along the rod, and none once it is past the end.
# What happens: each element reaches from its centre to half an element past its end. So at the start of the rod, for half an element less the reach of the
# ball, there is no contact, and past the end, for half an element, there is one with the full force where there is no rod. RodCylinderContact does the same;
# RodRodContact does not. No warning is given. Finer rods make both gaps smaller.
# Who meets it: whoever lets the tip of a rod, such as a catheter or an arm, touch a ball or a post, or takes few elements. What meets the base end passes
# through it.
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
PLACES = (-0.2, 0.01, 0.06, 0.5, 0.99, 1.11, 1.3)
OPTIONS = dict(base_radius=0.05, density=1000.0, youngs_modulus=1e6)


def rod(start, direction, normal, length, elements):
    return ea.CosseratRod.straight_rod(elements, start, direction, normal, length, **OPTIONS)


def force(other, contact, **options):
    arm = rod(np.zeros(3), X, Y, 1.0, 4)
    contact(k=1e4, nu=0.0, **options).apply_contact(arm, other)
    return round(float(-arm.external_forces[1].sum()), 1)


# the line of the rod is 0.12 from the ball and from the post, and the two radii are 0.05 and 0.1
ball = [force(ea.Sphere(np.array((x, 0.12, 0.0)), 0.1, 1000.0), ea.RodSphereContact) for x in PLACES]
post = [force(ea.Cylinder(np.array((x, 0.12, -1.0)), Z, X, 2.0, 0.1, 1000.0), ea.RodCylinderContact) for x in PLACES]
cord = [force(rod(np.array((x, 0.07, -0.1)), Z, X, 0.2, 2), ea.RodRodContact) for x in PLACES]
print("PyElastica", importlib.metadata.version("pyelastica"), "forces with the other thing at x =", PLACES, "on a rod from 0 to 1: a ball", ball, "a post", post, "another rod", cord)
inside = [0 <= x <= 1 for x in PLACES]
assert [value > 0 for value in cord] == inside
for forces in (ball, post):
    assert forces[3] > 100 and forces[0] == forces[6] == 0
    assert forces[1] == 0 and forces[5] >= 0.99 * forces[3], "the rod is where it should be now"
PY
