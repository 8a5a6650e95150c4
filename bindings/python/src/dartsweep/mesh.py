"""Environments from mesh files, through meshio (the extra `mesh`)."""

from __future__ import annotations

from typing import Any

import numpy as np

from .enums import CellType
from .environment import Environment

_TYPES = {
    "tetra": CellType.TETRA,
    "hexahedron": CellType.HEXAHEDRON,
    "wedge": CellType.WEDGE,
    "pyramid": CellType.PYRAMID,
}
_REGION_NAMES = ("gmsh:physical", "region", "medit:ref", "cell_tags")


def from_meshio(mesh: Any, *, regions: str | None = None, **options: Any) -> Environment:
    """An environment of a meshio.Mesh: its linear volume cells, in their order; surfaces, lines and points are left out.

    regions: name of the cell data that labels cells; by default the usual names are looked for. options: as of Environment.
    """
    name = regions or next((known for known in _REGION_NAMES if known in mesh.cell_data), None)
    types, sizes, connectivity, labels = [], [], [], []
    for i, block in enumerate(mesh.cells):
        if block.type not in _TYPES:
            if getattr(block, "dim", 3) == 3:
                raise ValueError(f"cells of type '{block.type}' are not supported: linear volumes only")
            continue
        data = np.asarray(block.data, np.int64)
        types.append(np.full(len(data), _TYPES[block.type], np.uint8))
        sizes.append(np.full(len(data), data.shape[1], np.int64))
        connectivity.append(data.ravel())
        if name is not None:
            labels.append(np.asarray(mesh.cell_data[name][i], np.int32))
    if not types:
        raise ValueError("the mesh has no volume cells")
    return Environment(
        np.ascontiguousarray(mesh.points, np.float64),
        np.concatenate(connectivity),
        np.concatenate(types),
        np.concatenate([np.zeros(1, np.int64), np.cumsum(np.concatenate(sizes))]),
        regions=np.concatenate(labels) if labels else None,
        **options,
    )
