"""Reads a volume mesh and writes it as the plain arrays that the demo's C program takes.

usage: read_mesh.py MESH OUT

Gmsh files are read by meshio, VTK's own by VTK (general polyhedra too), either may be gzipped. Regions come from
Gmsh's volume groups by name, or from the cell array `region`. Exit code 2 with a message if the mesh can't be used.
"""
import gzip
import logging
import os
import shutil
import struct
import sys
import tempfile
import warnings

import numpy as np

TETRA, VOXEL, HEXAHEDRON, WEDGE, PYRAMID, POLYHEDRON = 10, 11, 12, 13, 14, 42
MESHIO_TYPES = {"tetra": TETRA, "hexahedron": HEXAHEDRON, "wedge": WEDGE, "pyramid": PYRAMID}
LUMEN_NAMES = {"lumen", "fluid", "blood"}
VOXEL_ORDER = [0, 1, 3, 2, 4, 5, 7, 6]


class Refused(Exception):
    """The mesh can't be used; the text says why."""


class Mesh:
    """Points, cells (type and point stream of each), a region label for each cell, and what the groups name."""

    def __init__(self, points, types, streams, regions):
        self.points = np.ascontiguousarray(points, dtype="<f8")
        self.types = np.asarray(types, dtype="u1")
        sizes = [len(s) for s in streams]
        self.offsets = np.concatenate([[0], np.cumsum(sizes)]).astype("<i8")
        self.connectivity = np.concatenate(streams).astype("<i8") if streams else np.zeros(0, "<i8")
        self.regions = np.asarray(regions, dtype="<i4")
        self.lumen = 0
        self.inlet = None
        self.walls = []


def read_gmsh(path):
    import meshio

    try:
        source = meshio.gmsh.read(path)
    except Exception as error:
        raise Refused(f"no Gmsh file that meshio can read ({str(error) or type(error).__name__})") from error
    names = {(int(v[0]), int(v[1])): name.lower() for name, v in source.field_data.items()}
    labels = source.cell_data.get("gmsh:physical")
    types, streams, groups, surfaces = [], [], [], {}
    for i, block in enumerate(source.cells):
        tags = labels[i] if labels is not None else np.zeros(len(block.data), int)
        if block.type in MESHIO_TYPES:
            types += [MESHIO_TYPES[block.type]] * len(block.data)
            streams += list(block.data)
            groups += list(tags)
        elif block.type in ("triangle", "quad"):
            for tag in np.unique(tags):
                surfaces.setdefault(names.get((int(tag), 2), ""), []).extend(block.data[tags == tag])
        elif block.type not in ("vertex", "line"):
            raise Refused(f"cells of type '{block.type}' are not supported: linear volumes only")
    if not streams:
        raise Refused("it holds no volume cells")
    # Labels 1 .. n, the lumen first.
    order = sorted(set(int(g) for g in groups), key=lambda g: (names.get((g, 3), "") not in LUMEN_NAMES, g))
    mesh = Mesh(source.points, types, streams, [order.index(int(g)) + 1 for g in groups])
    if names.get((order[0], 3), "") in LUMEN_NAMES:
        mesh.lumen = 1
    else:
        mesh.walls = surfaces.get("wall", [])
    if "inlet" in surfaces:
        mesh.inlet = source.points[np.unique(np.concatenate(surfaces["inlet"]))].mean(axis=0)
    return mesh


def read_vtk(path):
    import pyvista

    pyvista.vtk_verbosity("off")
    logging.disable(logging.CRITICAL)  # VTK's own account of a bad file is long; ours is one line
    warnings.simplefilter("ignore")
    try:
        grid = pyvista.read(path)
        if not isinstance(grid, pyvista.UnstructuredGrid):
            grid = grid.cast_to_unstructured_grid()
    except Exception as error:
        raise Refused(f"no VTK file that PyVista can read ({str(error) or type(error).__name__})") from error
    types, streams, kept = [], [], []
    ids = pyvista._vtk.vtkIdList()
    offset, connectivity = grid.cell_offsets, grid.cell_connectivity
    for i, kind in enumerate(grid.celltypes):
        if kind == POLYHEDRON:
            grid.GetFaceStream(i, ids)
            stream = np.array([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
        elif kind in (TETRA, VOXEL, HEXAHEDRON, WEDGE, PYRAMID):
            stream = connectivity[offset[i] : offset[i + 1]]
            if kind == VOXEL:
                stream, kind = stream[VOXEL_ORDER], HEXAHEDRON
        elif kind < TETRA:  # vertices, lines and polygons
            continue
        else:
            raise Refused(f"cells of VTK type {kind} are not supported: 10, 11, 12, 13, 14 and 42 are")
        types.append(kind)
        streams.append(stream)
        kept.append(i)
    if not streams:
        raise Refused("it holds no volume cells")
    values = np.asarray(grid.cell_data["region"])[kept] if "region" in grid.cell_data else np.ones(len(kept))
    order = sorted(set(int(v) for v in values), key=lambda v: (v != 1, v))
    mesh = Mesh(grid.points, types, streams, [order.index(int(v)) + 1 for v in values])
    mesh.lumen = 1 if len(order) > 1 and order[0] == 1 else 0
    return mesh


def read(path):
    if not os.path.isfile(path):
        raise Refused("no such file")
    name = path[:-3] if path.endswith(".gz") else path
    suffix = os.path.splitext(name)[1].lower()
    readers = {".msh": read_gmsh, ".vtk": read_vtk, ".vtu": read_vtk}
    if suffix not in readers:
        raise Refused(f"files ending in '{suffix}' are not read: .msh, .vtk, .vtu are, also with .gz behind")
    if name == path:
        return readers[suffix](path)
    with tempfile.TemporaryDirectory() as folder:
        unpacked = os.path.join(folder, "mesh" + suffix)
        try:
            with gzip.open(path) as packed, open(unpacked, "wb") as out:
                shutil.copyfileobj(packed, out)
        except (OSError, EOFError) as error:
            raise Refused(f"not a whole gzip file ({error})") from error
        return readers[suffix](unpacked)


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
    return 0


if __name__ == "__main__":
    sys.exit(main())
