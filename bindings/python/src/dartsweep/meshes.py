"""Meshes of other libraries: volumes by meshio (the extra `mesh`), surfaces by trimesh (the extra `trimesh`), and closed surfaces that are
filled with volumes (the extra `surfaces`).

Meshes are taken by their attributes, so that nothing is imported but where a library has to read or to make one.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from . import surfaces
from ._core import Change
from .body import Body
from .enums import CellType
from .environment import Environment
from .scene import Scene
from .trace import Trace

if TYPE_CHECKING:
    import trimesh

_TYPES = {
    "tetra": CellType.TETRA,
    "hexahedron": CellType.HEXAHEDRON,
    "wedge": CellType.WEDGE,
    "pyramid": CellType.PYRAMID,
}
_PLANAR_TYPES = {"triangle": CellType.TRIANGLE, "quad": CellType.QUAD, "polygon": CellType.POLYGON}
_REGION_NAMES = ("gmsh:physical", "region", "medit:ref", "cell_tags")


def read(path: str, *, regions: str | None = None, **options: Any) -> Environment:
    """An environment of a file in any format that meshio knows; see from_meshio. from_surface reads files of surfaces."""
    import meshio

    try:
        mesh = meshio.read(path)
    except SystemExit as error:  # so meshio ends; it has printed why
        raise ValueError(f"meshio can't read mesh '{path}'") from error
    return _environment(mesh, f"mesh '{path}'", regions, options)


def from_meshio(mesh: Any, *, regions: str | None = None, **options: Any) -> Environment:
    """An environment of a meshio.Mesh: its linear volume cells, in their order; surfaces, lines and points are left out. A mesh without
    volumes in two dimensions, or with z = 0 everywhere, is one of the plane: of its triangles, quads and polygons.

    regions: name of the cell data that labels cells; by default the usual names are looked for, then groups of cells that do not overlap.
    Names of groups can be used in place of labels. options: as of Environment.
    """
    return _environment(mesh, "the mesh", regions, options)


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

    outside: "nothing", or "tissue", with which a box round the surface is filled, too. Tissue is impassable. Regions are "lumen" (1) and
    "tissue" (2), and tags the same numbers, so the tag of a contact tells what is behind the wall. size, thickness, largest_hole, parts,
    scale, repair, errors and cost: as of dartsweep.surfaces.fill; `notes` of the environment say what a repair has changed. options: as of
    Environment.
    """
    filled = surfaces.fill(
        surface, outside, size=size, thickness=thickness, largest_hole=largest_hole, parts=parts, scale=scale, repair=repair
    )
    names = {"lumen": surfaces.LUMEN, "tissue": surfaces.TISSUE}
    made = Environment(filled.points, filled.cells, regions=filled.regions, tags=filled.regions, region_names=names, **options)
    made._names.notes = filled.notes
    groups = {"wall": np.flatnonzero(~filled.is_cap), "caps": np.flatnonzero(filled.is_cap)}
    offsets = np.arange(0, filled.wall.size + 1, 3)
    made._names.surfaces.add(offsets, filled.wall.ravel(), {name: faces for name, faces in groups.items() if len(faces)}, {})
    if outside == "tissue":
        made.mark_region("tissue")
    return made


def _environment(mesh: Any, title: str, regions: str | None, options: dict[str, Any]) -> Environment:
    name = regions or next((known for known in _REGION_NAMES if known in mesh.cell_data), None)
    groups = {} if name is not None else _disjoint_groups(mesh)
    types, sizes, connectivity, labels = [], [], [], []
    points = np.ascontiguousarray(mesh.points, np.float64)
    is_planar = not np.any(points[:, 2:]) and not any(getattr(block, "dim", 3) == 3 for block in mesh.cells)
    known = _PLANAR_TYPES if is_planar else _TYPES
    for i, block in enumerate(mesh.cells):
        if block.type not in known:
            if getattr(block, "dim", 3) == (2 if is_planar else 3):
                kinds = "triangles, quads and polygons" if is_planar else "linear volumes"
                raise ValueError(f"{title} has cells of type '{block.type}': {kinds} are supported")
            continue
        data = np.asarray(block.data, np.int64)
        types.append(np.full(len(data), known[block.type], np.uint8))
        sizes.append(np.full(len(data), data.shape[1], np.int64))
        connectivity.append(data.ravel())
        if name is not None:
            labels.append(np.asarray(mesh.cell_data[name][i], np.int32))
        elif groups:
            labels.append(_labels_of(groups, i, len(data)))
    if not types:
        hint = "; dartsweep.from_surface fills a surface of triangles" if any(block.type == "triangle" for block in mesh.cells) else ""
        raise ValueError(f"{title} has no volume cells, and no triangles, quads or polygons with z = 0{hint}")
    return Environment(
        np.ascontiguousarray(points[:, :2]) if is_planar else points,
        np.concatenate(connectivity),
        np.concatenate(types),
        np.concatenate([np.zeros(1, np.int64), np.cumsum(np.concatenate(sizes))]),
        regions=np.concatenate(labels) if labels else None,
        region_names=_names_of(mesh, 2 if is_planar else 3) if name is not None else {key: i for i, key in enumerate(groups, 1)},
        **options,
    )


def _names_of(mesh: Any, dimension: int) -> dict[str, int]:
    """Names of labels as Gmsh has them: (label, dimension) of each."""
    pairs = {name: np.ravel(data) for name, data in getattr(mesh, "field_data", {}).items()}
    return {name: int(pair[0]) for name, pair in pairs.items() if len(pair) == 2 and pair[1] == dimension}


def _disjoint_groups(mesh: Any) -> dict[str, Any]:
    """Named groups of cells: for each an array of cells of each block, or None. Empty where groups overlap: no label could tell them."""
    groups = {name: blocks for name, blocks in getattr(mesh, "cell_sets", {}).items() if not name.startswith("gmsh:")}
    for i, block in enumerate(mesh.cells):
        taken = np.zeros(len(block.data), np.int32)
        for blocks in groups.values():
            if blocks[i] is not None:
                np.add.at(taken, np.asarray(blocks[i], np.int64), 1)
        if np.any(taken > 1):
            return {}
    return groups


def _labels_of(groups: dict[str, Any], block: int, count: int) -> Any:
    """The number of each cell's group, from 1 on; 0 for cells of none."""
    labels = np.zeros(count, np.int32)
    for label, blocks in enumerate(groups.values(), 1):
        if blocks[block] is not None:
            labels[np.asarray(blocks[block], np.int64)] = label
    return labels


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
