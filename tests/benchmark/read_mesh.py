#!/usr/bin/env python3
"""Converts a tetrahedral .msh (or .msh.gz) for the benchmark: read_mesh.py IN OUT.

OUT is little endian: two int64 (points, cells), then 3 doubles a point, 4 int32 a cell, one int32 region a cell
(1 lumen, 2 tissue, by the names of the groups)."""
import gzip
import os
import shutil
import sys
import tempfile

import meshio
import numpy


def read(path):
    if not path.endswith(".gz"):
        return meshio.read(path)
    with tempfile.TemporaryDirectory() as folder:
        plain = os.path.join(folder, "mesh.msh")
        with gzip.open(path, "rb") as packed, open(plain, "wb") as out:
            shutil.copyfileobj(packed, out)
        return meshio.read(plain)


def main():
    mesh = read(sys.argv[1])
    region_of_group = {int(mesh.field_data[name][0]): number
                       for number, name in ((1, "lumen"), (2, "tissue"))}
    cells, regions = [], []
    for block, groups in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        if block.type == "tetra":
            cells.append(block.data)
            regions.append([region_of_group[int(group)] for group in groups])
    cells = numpy.concatenate(cells)
    with open(sys.argv[2], "wb") as out:
        numpy.array([len(mesh.points), len(cells)], dtype="<i8").tofile(out)
        numpy.asarray(mesh.points, dtype="<f8").tofile(out)
        cells.astype("<i4").tofile(out)
        numpy.concatenate(regions).astype("<i4").tofile(out)


main()
