#!/bin/sh
# pymadcad, a CAD library on meshes, and booleans of two bricks, of sides 3 and 1: one within the other, and side by side with a common face.
# One would guess 26, 27 and 1 for difference, union and what both share of the inner brick, and 27, 28 and 0 of the one beside: the help of the three calls
# speaks of volumes, and two bricks whose walls cross get what one would guess, closed.
# What happens: of the inner brick nothing is cut, so the difference is 27; the union is 28 and counts it twice, and nothing is shared. All are closed meshes.
# With the brick that touches, the difference is open: the square where they touch is missing in the wall, though nothing had to be cut. So it is with the
# union of a brick that is inside and touches a wall, and with two bricks of one size side by side. No error and no warning is given.
# The help of the module says that meshes are cut where they meet and that sides are told there. Of meshes that do not meet, or only touch, it says nothing.
# Who meets it: whoever cuts cavities, takes shared volume for a test of collision, or stacks parts: a part that is wholly inside another one does not collide.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile pymadcad==1.0.3 numpy==2.4.6
"$folder/venv/bin/python" -W ignore - <<'PY'
import importlib.metadata

from madcad import brick, difference, intersection, union, vec3


def both(side, x):
    """Volumes of difference, union and intersection of the brick of side 3 and one at x, or areas where the mesh is open."""
    large, small = brick(center=vec3(0), width=vec3(3)), brick(center=vec3(x, 0, 0), width=vec3(side))
    made = [way(large, small) for way in (difference, union, intersection)]
    return [round(mesh.volume(), 2) if mesh.isenvelope() else f"open, area {mesh.surface():.2f}" for mesh in made]


found = {
    "inside": both(1, 0), "through a wall": both(1, 1.5), "inside at a wall": both(1, 1), "beside": both(1, 2),
    "beside, with a gap": both(1, 2.001), "beside, of one size": both(3, 3),
}
print("pymadcad", importlib.metadata.version("pymadcad"), "volumes of difference, union and intersection:", found)
assert found["through a wall"] == [26.5, 27.5, 0.5]
assert found["beside, with a gap"] == [27, 28, 0]
assert found["inside"] == [27, 28, 0], "a brick within another is seen now"
# The whole area is 54.
assert found["beside"][0] == "open, area 53.00", "a brick that touches takes nothing away now"
assert found["inside at a wall"][1] == "open, area 53.00"
assert found["beside, of one size"][0] == "open, area 45.00"
PY
