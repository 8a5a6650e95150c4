"""Reads a volume mesh and writes it as the plain arrays that the demo's C program takes.

usage: read_mesh.py MESH OUT

The readers are those of the Python package, which need no compiled library here: every kind of file of bindings/docs/meshes.md
is taken, also packed. Regions come from groups of volumes by name, or from labels such as the cell array `region`. Exit code 2
with a message if the mesh can't be used.
"""
import os
import pathlib
import struct
import sys
import types

import numpy as np

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "bindings/python/src/dartsweep"
TETRA, HEXAHEDRON, WEDGE, PYRAMID, POLYHEDRON = 10, 12, 13, 14, 42
LUMEN_NAMES = {"lumen", "fluid", "blood"}


class Refused(Exception):
    """The mesh can't be used; the text says why."""


class Mesh:
    """What the C program takes: points, cells, a region label for each cell, and what the groups name."""

    def __init__(self, source, regions):
        self.points = np.ascontiguousarray(source.points, dtype="<f8")
        self.types = source.types
        self.offsets = source.offsets.astype("<i8")
        self.connectivity = source.connectivity.astype("<i8")
        self.regions = np.asarray(regions, dtype="<i4")
        self.lumen = 0
        self.inlet = None
        self.walls = []
        self.notes = list(source.notes)


def door():
    """The package's readers and labels, without the modules that need the compiled library."""
    if "dartsweep" not in sys.modules:
        package = types.ModuleType("dartsweep")
        package.__path__ = [str(PACKAGE)]
        sys.modules["dartsweep"] = package
    from dartsweep._door import files, labels

    return files, labels


def faces_of(source, name):
    """The points of each face of a group, whatever the case of its name."""
    key = next((known for known in source.face_groups if known.lower() == name), None)
    chosen = [] if key is None else source.face_groups[key]
    return [source.face_vertices[source.face_offsets[i] : source.face_offsets[i + 1]] for i in chosen]


def read(path):
    if not os.path.isfile(path):
        raise Refused("no such file")
    files, labels = door()
    try:
        source = files.read(path)
        found, names = labels.regions_of(source, None)
    except ValueError as error:  # a MeshError; it names the file itself
        raise Refused(f"{getattr(error, 'found', error)}; {getattr(error, 'way_on', '')}") from error
    if source.types[0] < TETRA:
        raise Refused("it holds no volume cells")
    values = np.ones(len(source.types), np.int64) if found is None else np.asarray(found, np.int64)
    lumen = {label for name, of_name in names.items() if name.lower() in LUMEN_NAMES for label in np.ravel(of_name).tolist()}
    # Labels 1 .. n, the lumen first; without names label 1 is the lumen.
    order = sorted(set(values.tolist()), key=lambda label: (label not in (lumen or ({1} if not names else set())), label))
    place = {label: i + 1 for i, label in enumerate(order)}
    regions = np.vectorize(place.get, otypes=[np.int64])(values)
    regions[np.isin(values, sorted(lumen))] = 1
    mesh = Mesh(source, regions)
    mesh.lumen = int(bool(lumen) or (not names and len(order) > 1 and order[0] == 1))
    mesh.walls = [] if mesh.lumen else faces_of(source, "wall")
    inlet = faces_of(source, "inlet")
    if inlet:
        mesh.inlet = mesh.points[np.unique(np.concatenate(inlet))].mean(axis=0)
    return mesh


def write(mesh, path):
    wall_offsets = np.concatenate([[0], np.cumsum([len(w) for w in mesh.walls])]).astype("<u8")
    wall_points = (np.concatenate(mesh.walls) if len(mesh.walls) else np.zeros(0)).astype("<u4")
    inlet = [0.0] * 3 if mesh.inlet is None else [float(x) for x in mesh.inlet]
    counts = len(mesh.points), len(mesh.types), len(mesh.connectivity), len(mesh.walls), len(wall_points)
    with open(path, "wb") as out:
        out.write(struct.pack("<8s5q2i3d", b"DSWMESH1", *counts, mesh.lumen, int(mesh.inlet is not None), *inlet))
        for array in (mesh.points, mesh.types, mesh.offsets, mesh.connectivity, mesh.regions, wall_offsets,
                      wall_points):
            out.write(array.tobytes())


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        mesh = read(sys.argv[1])
    except Refused as reason:
        print(f"demo: cannot use mesh '{sys.argv[1]}': {reason}", file=sys.stderr)
        return 2
    write(mesh, sys.argv[2])
    kinds = {TETRA: "tetrahedra", HEXAHEDRON: "hexahedra", WEDGE: "wedges", PYRAMID: "pyramids",
             POLYHEDRON: "polyhedra"}
    parts = [f"{np.count_nonzero(mesh.types == k)} {name}" for k, name in kinds.items() if k in mesh.types]
    print(f"read {os.path.basename(sys.argv[1])}: {', '.join(parts)}")
    for note in mesh.notes:
        print(f"note on {os.path.basename(sys.argv[1])}: {note}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
