#!/bin/sh
# trimesh and its two ways to ask whether a place is in a mesh: contains, and the sign of proximity.signed_distance (positive inside).
# One would guess that they agree: both are for closed meshes, and is_watertight is true for all meshes here.
# What happens: where two cubes of one mesh overlap, contains says outside and signed_distance says inside by 0.5. So it is in a small cube within a large
# one. The first counts the walls on a ray, the second looks at the normal of the nearest triangle. In a single cube they agree. No warning is given.
# Who meets it: whoever samples or labels points of assemblies, organs in organs, or scans by one of the two, and compares with someone who took the other.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile trimesh==5.2.0 numpy==2.4.6 scipy==1.17.1 rtree==1.4.1
"$folder/venv/bin/python" - <<'PY'
import trimesh


def cube(side, *place):
    """A closed cube that faces outwards."""
    return trimesh.creation.box((side, side, side), transform=trimesh.transformations.translation_matrix(place))


meshes = {
    "plain": cube(2, 0, 0, 0),
    "overlapping": trimesh.util.concatenate([cube(2, -0.5, -0.5, -0.5), cube(2, 0.5, 0.5, 0.5)]),
    "nested": trimesh.util.concatenate([cube(2, 0, 0, 0), cube(1, 0, 0, 0)]),
}
place = [(0.01, 0.02, 0.03)]  # near the middle of each of them
found = {name: (bool(mesh.contains(place)[0]), bool(trimesh.proximity.signed_distance(mesh, place)[0] > 0)) for name, mesh in meshes.items()}
print("trimesh", trimesh.__version__, "inside by contains and by the signed distance:", found)
assert all(mesh.is_watertight for mesh in meshes.values()) and found.pop("plain") == (True, True)
assert set(found.values()) == {(False, True)}, "the two agree now"
PY
