"""A mesh as every reader gives it: cells as Environment takes them, and all that the file says about them."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.int64]


def _none() -> Indices:
    return np.empty(0, np.int64)


@dataclasses.dataclass
class Mesh:
    """Cells of the highest dimension that the file has are `cells`; those one dimension lower, which name the boundary, are `faces`.

    If there are volumes, cells are volumes and faces are polygons. Otherwise cells are triangles, quads and polygons, which may lie
    anywhere in space, and faces are lines of two points.
    """

    points: NDArray[np.float64]
    """(n, 3), or (n, 2) where the file has two coordinates."""
    types: NDArray[np.uint8]
    """(m,) CellType of each cell, only types that Environment takes."""
    offsets: Indices
    """(m + 1,): cell i has connectivity[offsets[i] : offsets[i + 1]]."""
    connectivity: Indices
    """Indices of points in the order of Environment; face streams for polyhedra."""
    regions: Any = None
    """(m,) labels that the format itself gives to cells (blocks, zones, families), not yet checked; or None."""
    region_names: dict[str, int] = dataclasses.field(default_factory=dict)
    """Names of labels."""
    cell_data: dict[str, NDArray[Any]] = dataclasses.field(default_factory=dict)
    """Arrays of the file with one row for each cell, unchanged: labels may be among them."""
    cell_groups: dict[str, Indices] = dataclasses.field(default_factory=dict)
    """Named groups of cells by index. Groups may overlap."""
    face_offsets: Indices = dataclasses.field(default_factory=lambda: np.zeros(1, np.int64))
    """(k + 1,): face i has face_vertices[face_offsets[i] : face_offsets[i + 1]]."""
    face_vertices: Indices = dataclasses.field(default_factory=_none)
    """Indices of points, each face turned either way."""
    face_groups: dict[str, Indices] = dataclasses.field(default_factory=dict)
    """Named groups of faces by index: inlets, patches, side sets, boundary conditions. Groups may overlap."""
    face_numbers: dict[str, int] = dataclasses.field(default_factory=dict)
    """Numbers that the file gives to some groups of faces."""
    face_data: dict[str, NDArray[Any]] = dataclasses.field(default_factory=dict)
    """Arrays of the file with one row for each face, unchanged."""
    fields: dict[str, Any] = dataclasses.field(default_factory=dict)
    """What the file says of the mesh as a whole: arrays, or lists of texts."""
    hangs: bool = False
    """Whether the format itself says that faces lie on several smaller ones, and that these are no walls."""
    notes: list[str] = dataclasses.field(default_factory=list)
    """What was changed or left out on the way, one sentence each."""
    source: str = "the mesh"
    """What messages call the mesh, such as "mesh 'tube.vtu'"."""
    reader: str = ""
    """The library that read it."""
