"""Cells that a file has several times, as Gmsh writes those of several groups in its version 2."""

from __future__ import annotations

import dataclasses

import numpy as np

from .blocks import once
from .linear import Cells
from .mesh import Mesh


def left_out(mesh: Mesh) -> Mesh | None:
    """The mesh with each cell once, in all groups of its copies; None if no cell is repeated."""
    cells = Cells(mesh.types, mesh.offsets, mesh.connectivity)
    place, kept = once(cells)
    if kept is None:
        return None
    own = cells.some(kept)
    note = f"{len(mesh.types) - len(kept)} cells are in the file again, such as once for each of their groups; each is kept once"
    return dataclasses.replace(
        mesh,
        types=own.types,
        offsets=own.offsets,
        connectivity=own.flat,
        regions=None if mesh.regions is None else np.asarray(mesh.regions)[kept],
        cell_data={name: values[kept] for name, values in mesh.cell_data.items()},
        cell_groups={name: np.unique(place[members]) for name, members in mesh.cell_groups.items()},
        notes=[*mesh.notes, note],
    )
