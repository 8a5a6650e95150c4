#!/bin/sh
# IPC Toolkit and a vertex that is in no edge and no triangle: a particle above a triangle.
# One would guess that CollisionMesh.build_from_full_mesh keeps it as a codimensional vertex, as the constructor does with the same arrays.
# What happens: the mesh has three vertices of four, and a step that carries the particle through the triangle is free of collisions, step size 1. The
# constructor keeps it, and the step is cut at the half. Nothing is said in either case.
# Who meets it: whoever has particles, beads or the free end points of rods beside surfaces, and leaves the choice of vertices to the toolkit.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile ipctk==1.6.1 numpy==2.4.6 scipy==1.17.1
"$folder/venv/bin/python" - <<'PY'
import ipctk
import numpy as np

start = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.2, 0.2, 1)], float)
end = start + [(0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, -2)]
faces = np.array([(0, 1, 2)], np.int32)
edges = ipctk.edges(faces)


def step(mesh):
    """Vertices that are kept, and how much of the step is free."""
    places = (np.asfortranarray(mesh.vertices(positions)) for positions in (start, end))
    return mesh.num_vertices, ipctk.compute_collision_free_stepsize(mesh, *places)


built, made = step(ipctk.CollisionMesh.build_from_full_mesh(start, edges, faces)), step(ipctk.CollisionMesh(start, edges, faces))
print("ipctk", ipctk.__version__, "vertices and step of build_from_full_mesh", built, "of the constructor", made)
assert made[0] == 4 and 0.4 < made[1] < 0.5
assert built == (3, 1.0), "the particle is kept now"
PY
