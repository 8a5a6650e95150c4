"""Fills a surface with tetrahedra: all of its inside becomes the lumen, its surface the wall.

usage: fill_surface.py SURFACE OUT.vtu

SURFACE is a .stl, .obj or .ply file. Of several parts the largest is taken; open ends, where a vessel was cut, get caps. The work is done by
the Python package's module dartsweep.surfaces, which needs no compiled library. Exit code 2 with a message if SURFACE can't be filled.
"""
import importlib.util
import pathlib
import sys

import meshio

MODULE = pathlib.Path(__file__).resolve().parents[2] / "bindings/python/src/dartsweep/surfaces.py"


def load(path):
    """The module of a file, also without the package that it is in."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = sys.modules[path.stem] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    surface, out = sys.argv[1:]
    surfaces = load(MODULE)
    try:
        filled = surfaces.fill(surface, parts="largest")
    except surfaces.SurfaceError as reason:
        print(f"demo: cannot use {reason}", file=sys.stderr)
        return 2
    except OSError as reason:
        print(f"demo: cannot use surface '{surface}': {reason.strerror}", file=sys.stderr)
        return 2
    if filled.part_count > 1:
        print(f"the surface has {filled.part_count} parts; the largest is taken")
    if filled.hole_count > 0:
        print(f"open ends capped: {filled.hole_count}")
    meshio.write_points_cells(out, filled.points, [("tetra", filled.cells)])
    print(f"filled {pathlib.Path(surface).name} with {len(filled.cells)} tetrahedra")
    return 0


if __name__ == "__main__":
    sys.exit(main())
