#!/bin/sh
# trimesh and surfaces whose faces are not all triangles, as Blender writes them.
# One would guess that a binary PLY file of triangles and quads is read, and that a polygon that is not convex is divided within itself.
# What happens: the binary PLY file is refused ("PLY is unexpected length!"), while the same file as text is read. In OBJ and PLY a polygon
# becomes a fan from its first corner, so an L folds over itself: the area is too large, and triangles cross. No warning is given.
# Who meets it: everybody who exports a mesh with quads from Blender, and reads it with trimesh.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q trimesh==5.2.0 numpy==2.2.6
cd "$folder"
venv/bin/python - <<'PY'
import struct

import numpy as np
import trimesh

print("trimesh", trimesh.__version__)
points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)], "<f4")
faces = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
head = "ply\nformat {} 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 5\nproperty list uchar int vertex_indices\nend_header\n"
with open("text.ply", "w") as file:
    file.write(head.format("ascii") + "".join("%g %g %g\n" % tuple(p) for p in points) + "".join(f"{len(f)} {' '.join(map(str, f))}\n" for f in faces))
with open("binary.ply", "wb") as file:
    file.write(head.format("binary_little_endian").encode() + points.tobytes() + b"".join(struct.pack(f"<B{len(f)}i", len(f), *f) for f in faces))
print("text: volume", trimesh.load_mesh("text.ply").volume)
try:
    print("binary: volume", trimesh.load_mesh("binary.ply").volume)
    raise SystemExit("the binary file is read now")
except ValueError as error:
    print("binary:", error)

corners = [(2, 0), (0, 0), (0, 2), (1, 2), (1, 1), (2, 1)]  # an L of area 3
with open("l.obj", "w") as file:
    file.write("".join(f"v {x} {y} 0\n" for x, y in corners) + "f 1 2 3 4 5 6\n")
area = trimesh.load_mesh("l.obj", process=False).area
print("area of an L of area 3:", area)
assert area > 3.5, "the polygon is divided within itself now"
PY
