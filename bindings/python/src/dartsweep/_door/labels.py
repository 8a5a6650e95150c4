"""Regions of the cells of a Mesh: labels of the format, of cell data with a usual name, or of groups."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import MeshError
from .mesh import Mesh

_USUAL = ("gmsh:physical", "region", "medit:ref", "cell_tags")


def regions_of(mesh: Mesh, name: str | None) -> tuple[Any, dict[str, int]]:
    """A label for each cell, or None, and names of labels. name: of the cell data that has them; by default what there is."""
    if name is not None:
        if name not in mesh.cell_data:
            known = ", ".join(f"'{key}'" for key in mesh.cell_data) or "none"
            raise MeshError(mesh.source, f"it has no cell data '{name}'", f"its cell data: {known}")
        return mesh.cell_data[name], mesh.region_names
    if mesh.regions is not None:
        return mesh.regions, mesh.region_names
    usual = next((known for known in _USUAL if known in mesh.cell_data), None)
    if usual is not None:
        return mesh.cell_data[usual], mesh.region_names
    return _of_groups(mesh)


def _of_groups(mesh: Mesh) -> tuple[Any, dict[str, int]]:
    """The number of each cell's group, from 1 on; None where groups overlap: no label could tell them."""
    taken = np.zeros(len(mesh.types), np.int32)
    for members in mesh.cell_groups.values():
        taken[members] += 1
    if not mesh.cell_groups or np.any(taken > 1):
        return None, mesh.region_names
    names = {name: label for label, name in enumerate(mesh.cell_groups, 1)}
    labels = np.zeros(len(mesh.types), np.int32)
    for name, label in names.items():
        labels[mesh.cell_groups[name]] = label
    return labels, names
