#!/bin/sh
# Warp's sign of the distance by normals (mesh_query_point_sign_normal) beside a blade: a closed wedge with a sharp edge of 11 degrees.
# One would guess that a point outside has a positive sign, because the documentation calls the way robust for closed meshes that do not cross themselves.
# What happens: of points outside that are nearest to the edge, in the twentieth of it next to one end, 2 % have the sign of points inside at 0.01 from the
# edge, and 20 % at a distance of 1, the width of the blade. Distances that differ by less than a thousandth of a side count as equal, so far away
# the normal of the end decides for points beside it. With epsilon=0.0 it is half of the points. The signs of mesh_query_point and of the winding
# number are right. No warning is given.
# Who meets it: whoever pushes particles out of a blade, a needle or a thin plate by this sign. Newton 1.8 takes parity for closed meshes, and this
# sign for open ones.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/cache"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile warp-lang==1.19.0 numpy==2.4.6
cat > "$folder/signs.py" <<'PY'
import numpy as np
import warp as wp

POINTS = [(0, -0.1, 0), (0, 0.1, 0), (1, 0, 0), (0, -0.1, 1), (0, 0.1, 1), (1, 0, 1)]
FACES = np.array([(0, 1, 2), (3, 5, 4), (0, 3, 1), (1, 3, 4), (1, 4, 2), (2, 4, 5), (2, 5, 0), (0, 5, 3)])


@wp.kernel
def signs(mesh: wp.uint64, places: wp.array(dtype=wp.vec3), made: wp.array2d(dtype=float)):
    i = wp.tid()
    by_normal = wp.mesh_query_point_sign_normal(mesh, places[i], 1.0e6)
    by_exact_normal = wp.mesh_query_point_sign_normal(mesh, places[i], 1.0e6, 0.0)
    by_parity = wp.mesh_query_point(mesh, places[i], 1.0e6)
    by_winding = wp.mesh_query_point_sign_winding_number(mesh, places[i], 1.0e6)
    made[i, 0] = by_normal.sign
    made[i, 1] = by_exact_normal.sign
    made[i, 2] = by_parity.sign
    made[i, 3] = by_winding.sign


corners = np.array(POINTS)[FACES]
volume = float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6
order = FACES if volume > 0 else FACES[:, ::-1]
mesh = wp.Mesh(points=wp.array(POINTS, dtype=wp.vec3), indices=wp.array(order.ravel(), dtype=int), support_winding_number=True)
turns = np.radians(np.arange(-80, 81, 2))
wrong = {}
for distance in (0.01, 0.1, 1.0):
    places = [(1 + distance * np.cos(turn), distance * np.sin(turn), height) for turn in turns for height in np.arange(0.0005, 0.05, 0.0005)]
    made = wp.zeros((len(places), 4), dtype=float)
    wp.launch(signs, len(places), inputs=[mesh.id, wp.array(places, dtype=wp.vec3), made])
    wrong[distance] = [int(count) for count in np.sum(made.numpy() < 0, axis=0)]
print("Warp", wp.__version__, "of", len(places), "points outside that are called inside, by normal, by normal with epsilon 0, by parity, by winding:", wrong)
assert all(counts[2:] == [0, 0] for counts in wrong.values())
assert all(0 < counts[0] < counts[1] for counts in wrong.values()), "points outside are outside now"
PY
"$folder/venv/bin/python" "$folder/signs.py"
