"""Fills a closed surface with tetrahedra: all of its inside becomes the lumen, its surface the wall.

usage: fill_surface.py SURFACE OUT.vtu

SURFACE is a .stl, .obj or .ply of triangles. Open ends, where a vessel was cut, get caps (MeshFix); TetGen fills it and keeps its
triangles. Exit code 2 with a message if that can't be done.
"""
import logging
import os
import sys
import warnings

import numpy as np
import pymeshfix
import pyvista
import tetgen

ENDINGS = {".stl", ".obj", ".ply"}
LARGEST_CELL = 0.06  # volume over the cube of the lumen's width: a few cells lie side by side across it


class Refused(Exception):
    """The surface can't be filled; the text says why."""


def read(path):
    if not os.path.isfile(path):
        raise Refused("no such file")
    if os.path.splitext(path)[1].lower() not in ENDINGS:
        raise Refused(f"only {', '.join(sorted(ENDINGS))} are read")
    pyvista.vtk_verbosity("off")
    logging.disable(logging.CRITICAL)  # VTK's own account of a bad file is long; ours is one line
    warnings.simplefilter("ignore")
    try:
        surface = pyvista.read(path).extract_surface(algorithm="dataset_surface").triangulate().clean()
    except Exception as error:
        raise Refused(f"it can't be read ({str(error) or type(error).__name__})") from error
    if surface.n_cells == 0 or not np.isfinite(surface.points).all():
        raise Refused("it has no triangles, or points that are no numbers")
    return surface


def part_to_fill(surface):
    """The largest connected part; what is left out is said."""
    parts = surface.connectivity("all")
    sizes = np.bincount(parts.cell_data["RegionId"])
    if len(sizes) == 1:
        return surface
    print(f"the surface has {len(sizes)} parts; the largest is taken, {100 * sizes.max() / sizes.sum():.0f} % of the triangles")
    return surface.connectivity("largest").extract_surface(algorithm="dataset_surface").clean()


def count_edges(surface, **kind):
    edges = dict(boundary_edges=False, non_manifold_edges=False, feature_edges=False, manifold_edges=False)
    return surface.extract_feature_edges(**{**edges, **kind}).n_cells


def close(surface):
    """Points and triangles of the surface with caps on its open ends, all triangles turned alike."""
    shared = count_edges(surface, non_manifold_edges=True)
    if shared > 0:
        raise Refused(f"{shared} of its edges have more than two triangles: it has no inside")
    tool = pymeshfix.PyTMesh()
    tool.set_quiet(True)
    tool.load_array(np.asarray(surface.points, float), surface.regular_faces.astype(np.int32))
    holes = tool.n_boundaries
    if holes > 0:
        tool.fill_small_boundaries(0, True)
        print(f"{holes} open ends were capped")
    points, triangles = tool.return_arrays()
    closed = pyvista.PolyData.from_regular_faces(points, triangles)
    if len(triangles) < 4 or count_edges(closed, boundary_edges=True) + count_edges(closed, non_manifold_edges=True) > 0:
        raise Refused("its open ends can't be closed")
    crossing = len(tool.select_intersecting_triangles())
    if crossing > 0:
        raise Refused(f"{crossing} of its triangles cross others; a tool that repairs surfaces (MeshFix, MeshLab) may help")
    return closed


def fill(closed):
    # Of a tube the volume is a quarter of surface times width.
    width = 4 * abs(closed.volume) / closed.area
    mesher = tetgen.TetGen(np.asarray(closed.points, float), closed.regular_faces.astype(np.int32))
    try:
        mesher.tetrahedralize(plc=True, nobisect=True, quality=True, minratio=1.5, mindihedral=5, steinerleft=-1, fixedvolume=True,
                              maxvolume=LARGEST_CELL * width**3, quiet=True)
    except RuntimeError as error:
        raise Refused(f"TetGen can't fill it ({error})") from error
    return mesher.grid


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        grid = fill(close(part_to_fill(read(sys.argv[1]))))
    except Refused as reason:
        print(f"demo: cannot use surface '{sys.argv[1]}': {reason}", file=sys.stderr)
        return 2
    grid.save(sys.argv[2])
    print(f"filled {os.path.basename(sys.argv[1])} with {grid.n_cells} tetrahedra")
    return 0


if __name__ == "__main__":
    sys.exit(main())
