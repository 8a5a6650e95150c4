"""Closed surfaces, filled with tetrahedra (the extra `surfaces`): trimesh and PyVista read files, MeshFix closes open ends, finds triangles
that cross and repairs them, TetGen fills.

The inside of the surface is the lumen; outside there is nothing, or a box of tissue. dartsweep.from_surface makes an environment of
what `fill` makes. This module needs nothing of the compiled library, so tools can use it without the package.
"""

from __future__ import annotations

import dataclasses
import importlib.util
import math
import os
import pickle
import subprocess
import sys
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Indices = NDArray[np.int64]

LUMEN = 1
"""The region of cells inside the surface."""

TISSUE = 2
"""The region of cells outside the surface: tissue, or free space."""

_ENDINGS = (".obj", ".ply", ".stl", ".vtk", ".vtp")

_START = """
import importlib.util, sys
sys.path[:] = sys.argv[2:]
spec = importlib.util.spec_from_file_location("dartsweep_filling", sys.argv[1])
package = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(package)
package.answer()
"""
"""The program that fills: the package _filling without dartsweep, which may not be there."""


try:
    from .errors import MeshError
except ImportError:  # this file alone, without the package
    MeshError = ValueError  # type: ignore[misc, assignment]


class SurfaceError(MeshError):
    """A surface can't be read or filled. The text names the surface and tells what is wrong and where."""

    def __init__(self, found: str, file: str = "surface") -> None:
        ValueError.__init__(self, found, file)
        self.file, self.found, self.way_on = file, found, found.partition("; ")[2]

    def __str__(self) -> str:
        return f"{self.file}: {self.found}"


@dataclasses.dataclass(frozen=True)
class FilledSurface:
    """Tetrahedra that fill a surface, as Environment takes them."""

    points: Points
    """(n, 3): those of the surface in their order, then those of caps, then those within the lumen and the tissue."""
    cells: Indices
    """(m, 4) indices of points: those of the lumen, then those of the tissue, numbered as in VTK."""
    regions: NDArray[np.int32]
    """(m,) LUMEN or TISSUE."""
    wall: Indices
    """(k, 3) indices of points: the triangles of the surface in their order, then those of caps. They are faces of cells, and their
    normals point out of the lumen."""
    is_cap: NDArray[np.bool_]
    """(k,) whether a triangle of the wall closes an open end, or was put in by a repair."""
    hole_count: int
    """How many open ends were closed."""
    part_count: int
    """How many connected parts the surface has, also those that were left out."""
    notes: tuple[str, ...] = ()
    """What a repair has changed, a sentence each."""


def fill(
    surface: Any,
    outside: str = "nothing",
    *,
    size: float | None = None,
    thickness: float | None = None,
    largest_hole: float = math.inf,
    parts: str = "one",
    scale: float = 1.0,
    repair: bool = False,
) -> FilledSurface:
    """Fills a surface with tetrahedra. Triangles of the surface stay as they are: they are the wall. Lengths are those after `scale`.

    surface: path of an STL, OBJ, PLY, VTP or VTK file; or a pair of points (n, 3) and triangles (m, 3); or an object with `vertices` and
    `faces`, such as one of trimesh; or a PolyData of PyVista or VTK. Triangles may be turned either way, and normals do not count. Polygons
    are divided into triangles. Points at the same place become one.
    outside: "nothing"; or "tissue" or "space": a box round the surface, filled as well.
    size: length of edges within the lumen, about; by default 0.8 of its width, which is 4 volumes over the area. The triangles of the surface
    are not divided, so cells beside them are about as large as they. Cells of tissue grow with their distance.
    thickness: least distance from the surface to the sides of the box of tissue; by default twice the width of the lumen.
    largest_hole: open ends that are wider are an error; 0 allows none. Smaller ones get a cap, which is wall, too.
    parts: what to do with a surface of several connected parts. "one": it is an error. "largest": the part of largest area is filled.
    "all": all are; what two of them enclose is outside, so the two surfaces of a thick wall give the wall.
    scale: all points are multiplied by it, such as 0.001 for a file in millimetres and an environment in metres.
    repair: a surface that can't be filled is mended. Points nearer than a millionth of its extent become one; if that is not enough, MeshFix
    takes away triangles that cross, edges of three triangles and slivers, and closes the openings. `notes` say what was changed. What MeshFix
    closes may not be wider than largest_hole. A surface that can be filled stays as it is.

    Raises SurfaceError with the name of the surface if it has no triangles, indices out of range, points that are not finite, an edge of
    three triangles, triangles that cross, one side only, no volume, or an open end or parts that are not allowed. Raises OSError if there
    is no such file, and ImportError without the extra `surfaces`.

    TetGen takes most of the time: some seconds for 100,000 tetrahedra. MeshFix and TetGen run in a process of their own, a Python that
    `sys.executable` starts: their crash is a SurfaceError.
    """
    if outside not in ("nothing", "tissue", "space"):
        raise ValueError(f"outside is 'nothing', 'tissue' or 'space', not {outside!r}")
    if parts not in ("one", "largest", "all"):
        raise ValueError(f"parts is 'one', 'largest' or 'all', not {parts!r}")
    for name, value in (("size", size), ("thickness", thickness), ("scale", scale)):
        if value is not None and not 0 < value < math.inf:
            raise ValueError(f"{name} is positive and finite, not {value}")
    if not largest_hole >= 0:
        raise ValueError(f"largest_hole is not negative, not {largest_hole}")
    try:
        points, triangles = _arrays(surface)
        return FilledSurface(*_in_own_process(points, triangles, scale, parts, largest_hole, "nothing" if outside == "nothing" else "tissue", size, thickness, repair))
    except SurfaceError as error:
        is_path = isinstance(surface, (str, os.PathLike))
        raise SurfaceError(error.found, f"surface '{os.fspath(surface)}'" if is_path else "surface") from error.__cause__


def _missing(name: str) -> ImportError:
    return ImportError(f"surfaces need the package {name}, which is in the extra `surfaces`: pip install dartsweep[surfaces]", name=name)


def _in_own_process(*arguments: Any) -> tuple[Any, ...]:
    """What the package _filling makes of arguments. MeshFix and TetGen can crash on surfaces in which no check finds a fault; the caller shall live."""
    for name in ("pymeshfix", "tetgen"):
        if importlib.util.find_spec(name) is None:
            raise _missing(name)
    program = os.path.join(os.path.dirname(__file__), "_filling", "__init__.py")
    command = [sys.executable, "-c", _START, program, *map(str, sys.path)]
    done = subprocess.run(command, input=pickle.dumps(arguments), capture_output=True, check=False)
    if done.returncode != 0:
        reason = done.stderr.decode(errors="replace").strip().rpartition("\n")[2] or "no message"
        raise SurfaceError(f"MeshFix or TetGen has crashed ({reason}, exit code {done.returncode}); a tool that repairs surfaces may help")
    answer = pickle.loads(done.stdout)
    if isinstance(answer, str):
        raise SurfaceError(answer)
    return answer  # type: ignore[no-any-return]


def _arrays(surface: Any) -> tuple[Points, NDArray[Any]]:
    if isinstance(surface, (str, os.PathLike)):
        points, triangles = _read(surface)
    elif hasattr(surface, "GetPolys"):
        points, triangles = _of_polydata(surface)
    elif hasattr(surface, "vertices") and hasattr(surface, "faces"):
        points, triangles = surface.vertices, surface.faces
    elif isinstance(surface, (tuple, list)) and len(surface) == 2:
        points, triangles = surface
    else:
        raise TypeError(f"a surface is a path, a pair of points and triangles, or has `vertices` and `faces`; not {type(surface).__name__}")
    try:
        return np.array(points, np.float64), np.array(triangles)
    except (TypeError, ValueError) as error:
        raise SurfaceError(f"its points or triangles make no array ({error})") from error


def _read(path: str | os.PathLike[str]) -> tuple[Any, Any]:
    with open(path, "rb"):  # an OSError names the path
        pass
    ending = os.path.splitext(path)[1].lower()
    if ending not in _ENDINGS:
        raise SurfaceError(f"files ending in '{ending}' are not read, {', '.join(_ENDINGS)} are; dartsweep.meshes.read reads volume meshes")
    if ending in (".vtk", ".vtp"):
        return _by_pyvista(path)
    try:
        import trimesh
    except ImportError as error:
        raise _missing("trimesh") from error
    try:
        mesh = trimesh.load_mesh(os.fspath(path), process=False, skip_materials=True)
    except Exception as error:  # of many kinds: the reader does not check what it reads
        if ending == ".ply" and _has_pyvista():  # trimesh reads no binary PLY of triangles and quads
            try:
                return _by_pyvista(path)
            except SurfaceError:
                pass
        raise SurfaceError(f"trimesh can't read it ({error})") from error
    if len(getattr(mesh, "faces", ())) == 0:
        raise SurfaceError("trimesh finds no triangles in it")
    if ending != ".stl" and _has_polygons(path, mesh) and _has_pyvista():
        return _by_pyvista(path)  # trimesh makes a fan of each polygon, which folds over itself where the polygon is not convex
    return mesh.vertices, mesh.faces


def _has_pyvista() -> bool:
    return importlib.util.find_spec("pyvista") is not None


def _has_polygons(path: str | os.PathLike[str], mesh: Any) -> bool:
    """Whether a file has faces of more than three points."""
    if os.path.splitext(path)[1].lower() == ".obj":
        with open(path, "rb") as lines:
            return any(line.startswith(b"f ") and len(line.split()) > 4 for line in lines)
    faces = mesh.metadata.get("_ply_raw", {}).get("face", {}).get("data", {})
    rows = next(iter(faces.values()), ()) if isinstance(faces, dict) else ()
    return any(np.size(row) > 3 for row in rows)


def _by_pyvista(path: str | os.PathLike[str]) -> tuple[Any, Any]:
    try:
        import pyvista
    except ImportError as error:
        raise _missing("pyvista") from error
    try:
        with pyvista.VtkErrorCatcher(raise_errors=True, send_to_logging=False), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # they repeat the error
            return _of_polydata(pyvista.read(path))
    except SurfaceError:
        raise
    except Exception as error:  # of many kinds
        raise SurfaceError(f"PyVista can't read it ({error})") from error


def _of_polydata(data: Any) -> tuple[Any, Any]:
    """Points and triangles of a data set of PyVista or VTK. Strips and polygons are divided."""
    try:
        import pyvista
    except ImportError as error:
        raise _missing("pyvista") from error
    data = pyvista.wrap(data)
    if isinstance(data, pyvista.UnstructuredGrid) and any(cell not in (3, 5, 6, 7, 9) for cell in np.unique(data.celltypes)):
        raise SurfaceError("it has volume cells; dartsweep.meshes.read reads volume meshes")
    if not isinstance(data, pyvista.PolyData):
        data = data.extract_geometry()
    triangles = data.triangulate()
    if len(triangles.faces) == 0:
        raise SurfaceError("PyVista finds no triangles in it")
    return triangles.points, triangles.faces.reshape(-1, 4)[:, 1:]
