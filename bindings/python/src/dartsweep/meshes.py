"""Meshes of files and of other libraries (the extras `vtk`, `mesh`, `gmsh`, `mfem`, `med`, `moab`, or all with `meshes`), surfaces by trimesh (the
extra `trimesh`), and closed surfaces that are filled with volumes (the extra `surfaces`).

Meshes are taken by their attributes, so that nothing is imported but where a library has to read or to make one.
"""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from . import surfaces
from ._core import Change
from ._door import build, files, gmsh_reader, linear, meshio_reader, plane, table, vtk_data
from ._door.mesh import Mesh
from ._door.raw import mesh_of
from .body import Body
from .environment import Environment
from .errors import MeshError
from .scene import Scene
from .trace import Trace

if TYPE_CHECKING:
    import trimesh

_FILLING = ("outside", "size", "thickness", "largest_hole", "parts", "scale", "repair")
"""Options of from_surface that fill the surface; the others are those of Environment."""


def read(path: str | os.PathLike[str], *, regions: str | None = None, quadratic: str = "corners", **options: Any) -> Environment:
    """An environment of a file: a mesh of volumes, a mesh of the plane, or a surface in space, whose inside is filled as by from_surface.

    bindings/docs/meshes.md says which library reads which files, and what is kept; a file may be compressed (.gz, .bz2, .xz), and an
    OpenFOAM case may be its folder. Cells stay in the order of the file. Types of which all cells are inside out are turned back; `notes`
    of the environment tells that, and all else that was changed. Options of from_surface, such as repair=True, go to it; but all parts of a
    surface are filled unless `parts` says otherwise.
    regions: name of the cell data that labels cells; by default what the format calls so. quadratic: "corners" takes cells of higher
    order by their corners, "split" divides quadratic ones so that they follow the curves. options: as of Environment. If parts of a mesh lie on
    each other, one of its options has to say what they are: merge_points, conform or inner_walls. Cells whose mean does not see all of their
    faces are split, which `notes` tell, but for split=False.

    Raises MeshError if the file can't be read, or has no such mesh; its text says why, and what to do. Raises OSError if there is no file.
    """
    if table.is_surface(path):
        try:
            return _of_file(path, options)
        except surfaces.SurfaceError as error:
            raise MeshError(f"mesh '{os.fspath(path)}'", str(error), "repair=True mends some faults, other programs mend more") from error
    return _environment(files.read(path, quadratic), regions, options)


def from_meshio(mesh: Any, *, regions: str | None = None, quadratic: str = "corners", **options: Any) -> Environment:
    """An environment of a meshio.Mesh. Its wedges are taken as Gmsh numbers them; arguments and errors: as of read."""
    return _environment(mesh_of(meshio_reader.raw_of(mesh, "the mesh"), quadratic), regions, options)


def from_pyvista(dataset: Any, *, regions: str | None = None, quadratic: str = "corners", **options: Any) -> Environment:
    """An environment of a data set of PyVista or VTK, also of one with blocks. Its wedges are taken as the installed VTK numbers them;
    arguments and errors: as of read."""
    return _environment(mesh_of(vtk_data.raw_of(dataset, "the data set", "VTK"), quadratic), regions, options)


def from_gmsh(*, regions: str | None = None, quadratic: str = "corners", **options: Any) -> Environment:
    """An environment of the mesh of the current model of the module `gmsh`; arguments and errors: as of read."""
    return _environment(mesh_of(gmsh_reader.raw_of_model("the model of Gmsh"), quadratic), regions, options)


def from_surface(
    surface: Any,
    outside: str = "nothing",
    *,
    size: float | None = None,
    thickness: float | None = None,
    largest_hole: float = math.inf,
    parts: str = "one",
    scale: float = 1.0,
    repair: bool = False,
    **options: Any,
) -> Environment:
    """An environment of a surface, filled with tetrahedra: the path of an STL, OBJ, PLY, VTP or VTK file, points (n, 3) and triangles (m, 3) as
    a pair or as `vertices` and `faces` of an object, or a PolyData. Open ends are closed. The triangles of the surface are the wall of the
    lumen. They are the environment's surface "wall" (tag 1), caps are its surface "caps" (tag 2).

    outside: "nothing", or "tissue", with which a box round the surface is filled, too. Tissue is impassable. Or "space": the box is free
    space, and the surface is that of an object in it, which is impassable. Regions are "lumen" (1) and "tissue" (2), or "object" (1) and
    "space" (2), and tags the same numbers, so the tag of a contact tells what is behind the wall. size, thickness, largest_hole, parts,
    scale, repair, errors and cost: as of dartsweep.surfaces.fill; `notes` of the environment say what a repair has changed. options: as of
    Environment.
    """
    filled = surfaces.fill(
        surface, outside, size=size, thickness=thickness, largest_hole=largest_hole, parts=parts, scale=scale, repair=repair
    )
    return _of_filled(filled, outside, options)


def _of_filled(filled: surfaces.FilledSurface, outside: str, options: dict[str, Any]) -> Environment:
    names = dict(zip(("object", "space") if outside == "space" else ("lumen", "tissue"), (surfaces.LUMEN, surfaces.TISSUE)))
    made = Environment(filled.points, filled.cells, regions=filled.regions, tags=filled.regions, region_names=names, **options)
    made._names.notes = filled.notes
    groups = {"wall": np.flatnonzero(~filled.is_cap), "caps": np.flatnonzero(filled.is_cap)}
    offsets = np.arange(0, filled.wall.size + 1, 3)
    made._names.surfaces.add(offsets, filled.wall.ravel(), {name: faces for name, faces in groups.items() if len(faces)}, {})
    if outside != "nothing":
        made.mark_region("tissue" if outside == "tissue" else "object")
    return made


def _of_file(surface: Any, options: dict[str, Any]) -> Environment:
    """A surface that a file has: all of its parts."""
    own = {name: value for name, value in options.items() if name in _FILLING}
    filled = surfaces.fill(surface, **{"parts": "all", **own})
    made = _of_filled(filled, own.get("outside", "nothing"), {name: value for name, value in options.items() if name not in own})
    if filled.part_count > 1 and "parts" not in own:
        made._names.notes += (f"its {filled.part_count} parts were all filled; a part that lies within another is a hole in it",)
    return made


def _environment(mesh: Mesh, regions: str | None, options: dict[str, Any]) -> Environment:
    if not (plane.is_of_surface(mesh) and not plane.is_flat(mesh)):
        return build.environment_of(mesh, regions, options)
    triangles = linear.triangles(mesh.offsets, mesh.connectivity)
    try:
        made = _of_file((mesh.points, triangles), options)
    except surfaces.SurfaceError as error:
        raise MeshError(mesh.source, f"it is a surface in space that can't be filled: {error.found}", "from_surface tells what it needs") from error
    made._names.notes = (*mesh.notes, "it is a surface in space: its inside was filled with tetrahedra", *made.notes)
    return made


def body_from_trimesh(scene: Scene, mesh: Any, **options: Any) -> Body:
    """A body of a surface with `vertices` and `faces`, in their order; options: as of Scene.create_body."""
    return scene.create_body(mesh.vertices, triangles=mesh.faces, **options)


def carve_trimesh(environment: Environment, mesh: Any, **options: Any) -> Change:
    """Makes the inside of a closed surface passable, with `vertices` and `faces`; options: as of Environment.carve."""
    return environment.carve(mesh.vertices, mesh.faces, **options)


def to_trimesh(surface: Body | Trace) -> trimesh.Trimesh:
    """The triangles of a body, where it is now, or of a trace. Vertices keep their indices. In the plane there are none: dartsweep.plot has
    its lines."""
    import trimesh

    if isinstance(surface, Body):
        points, triangles = surface.positions(), surface.face_indices()
        if points.shape[1] == 2:
            raise ValueError("bodies in the plane have no triangles")
        triangles = triangles[triangles[:, 0] < len(points)]  # not those of free slots
    else:
        points, triangles = surface.points, surface.triangles[0]
    return trimesh.Trimesh(points, triangles.astype(np.int64), process=False)
