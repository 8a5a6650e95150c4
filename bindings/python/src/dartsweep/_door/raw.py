"""Cells of all dimensions, as a reader finds them, and the Mesh that is made of them."""

from __future__ import annotations

import dataclasses
import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from . import linear, polyhedra
from .linear import Cells
from .mesh import Indices, Mesh
from .ragged import take


@dataclasses.dataclass
class Raw:
    """What a reader has found. Cells have VTK's type numbers and its orders of points, but wedges of every degree are numbered as in
    Gmsh: 3, 4 and 5 are on the side to which 0, 1 and 2 turn counter-clockwise. Polyhedra are face streams."""

    points: NDArray[np.float64]
    cells: Cells
    data: dict[str, NDArray[Any]] = dataclasses.field(default_factory=dict)
    """One row for each cell, of any dimension."""
    regions: Any = None
    """Labels of cells of any dimension that the format itself gives, or None."""
    region_names: dict[str, int] = dataclasses.field(default_factory=dict)
    groups: dict[str, Indices] = dataclasses.field(default_factory=dict)
    """Named groups of cells of any dimension."""
    numbers: dict[str, int] = dataclasses.field(default_factory=dict)
    """Numbers of some groups."""
    point_ids: Any = None
    """Ids of points that several blocks share, or None."""
    sides: list[tuple[str, Indices, Indices]] = dataclasses.field(default_factory=list)
    """Named groups of faces that are no cells: name, offsets and points of each."""
    fields: dict[str, Any] = dataclasses.field(default_factory=dict)
    hangs: bool = False
    """Whether the mesh is said to have hanging nodes."""
    notes: list[str] = dataclasses.field(default_factory=list)
    source: str = "the mesh"
    reader: str = ""


def free_name(name: str, kind: str, taken: Any) -> str:
    """A name of a set that no other one has."""
    if name not in taken:
        return name
    return next(new for i in itertools.count(1) if (new := f"{name} ({kind.lower()} set{'' if i == 1 else f' {i}'})") not in taken)


def mesh_of(raw: Raw, quadratic: str = "corners") -> Mesh:
    """The cells of the highest dimension as Environment takes them, with all that the file says of them and of their faces."""
    points = np.ascontiguousarray(raw.points, np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise MeshError(raw.source, f"its points have shape {points.shape}", "points have two or three coordinates")
    made = linear.Made(points, raw.source, quadratic, list(raw.notes))
    cells, parents = linear.supported(made, raw.cells)
    cells, turned = polyhedra.consistent(made.points, cells, raw.source)
    if turned:
        made.notes.append(f"faces of {turned} polyhedra were turned: they were not all counter-clockwise seen from outside")
    dimensions = linear.DIMENSION[cells.types]
    dimension = int(dimensions.max(initial=0))
    if dimension < 2:
        raise MeshError(raw.source, _what_there_is(cells), "a mesh of volumes, or of triangles, quads or polygons, is needed")
    mesh = Mesh(made.points, *_of_dimension(cells, dimensions, dimension), source=raw.source, reader=raw.reader, notes=made.notes)
    mesh.fields, mesh.hangs = dict(raw.fields), raw.hangs
    _add_data(mesh, raw, parents, dimensions, dimension)
    _add_faces(mesh, raw, cells, parents, dimensions, dimension)
    return mesh


def _what_there_is(cells: Cells) -> str:
    if len(cells.types) == 0:
        return "it has no cells"
    return f"it has {len(cells.types)} lines and points, but no cells that fill space or the plane"


def _of_dimension(cells: Cells, dimensions: NDArray[np.int8], dimension: int) -> tuple[NDArray[np.uint8], Indices, Indices]:
    if bool(np.all(dimensions == dimension)):
        return cells.types, cells.offsets, cells.flat
    chosen = cells.some(np.flatnonzero(dimensions == dimension))
    return chosen.types, chosen.offsets, chosen.flat


def _add_data(mesh: Mesh, raw: Raw, parents: Indices | None, dimensions: NDArray[np.int8], dimension: int) -> None:
    cells = _parents_of(parents, dimensions, dimension)
    faces = _parents_of(parents, dimensions, dimension - 1)
    mesh.region_names = dict(raw.region_names)
    if raw.regions is not None:
        mesh.regions = _rows(np.asarray(raw.regions), cells)
    for name, values in raw.data.items():
        mesh.cell_data[name] = _rows(values, cells)
        mesh.face_data[name] = _rows(values, faces)
    for name, members in raw.groups.items():
        kept = _children(members, cells, len(raw.cells.types))
        if len(kept):
            mesh.cell_groups[name] = kept


def _parents_of(parents: Indices | None, dimensions: NDArray[np.int8], dimension: int) -> Indices | None:
    """Cells of the file, of which the cells of a dimension are; None: all of them, in order."""
    if parents is None and bool(np.all(dimensions == dimension)):
        return None
    chosen = np.flatnonzero(dimensions == dimension)
    return chosen if parents is None else parents[chosen]


def _rows(values: NDArray[Any], rows: Indices | None) -> NDArray[Any]:
    return values if rows is None else values[rows]


def _children(members: Any, parents: Indices | None, count: int) -> Indices:
    """Indices of the cells that come from members."""
    if parents is None:
        chosen = np.asarray(members, np.int64)
        return np.sort(chosen) if np.any(chosen[1:] < chosen[:-1]) else chosen
    is_member = np.zeros(count, np.bool_)
    is_member[members] = True
    return np.flatnonzero(is_member[parents])


def _add_faces(mesh: Mesh, raw: Raw, cells: Cells, parents: Indices | None, dimensions: NDArray[np.int8], dimension: int) -> None:
    rows = np.flatnonzero(dimensions == dimension - 1)
    sizes, vertices = take(cells.offsets, cells.flat, rows)
    parts, part_sizes, count = [vertices], [sizes], len(rows)
    of_file = rows if parents is None else parents[rows]
    for name, members in raw.groups.items():
        kept = _children(members, of_file, len(raw.cells.types))
        if len(kept):
            mesh.face_groups[name] = kept
    for name, offsets, side_vertices in raw.sides:
        parts.append(side_vertices)
        part_sizes.append(np.diff(offsets))
        own = np.arange(count, count + len(offsets) - 1)
        mesh.face_groups[name] = np.concatenate([mesh.face_groups[name], own]) if name in mesh.face_groups else own
        count += len(offsets) - 1
    for name, values in mesh.face_data.items():  # faces of `sides` have no data
        if count != len(values):
            mesh.face_data[name] = _padded(values, count)
    mesh.face_vertices = np.concatenate(parts)
    mesh.face_offsets = np.concatenate([np.zeros(1, np.int64), np.cumsum(np.concatenate(part_sizes))])
    mesh.face_numbers = {name: number for name, number in raw.numbers.items() if name in mesh.face_groups}


def _padded(values: NDArray[Any], count: int) -> NDArray[Any]:
    made = np.zeros((count, *values.shape[1:]), values.dtype)
    made[: len(values)] = values
    return made
