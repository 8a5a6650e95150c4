"""Arrays and ids as calls take them: cells in rows, points in one block, entries of arrays of ids."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, dtypes
from ._core import Cell, EdgeId, FaceId, VertexId, VolumeId
from .enums import CellType

Records = NDArray[np.void]
Ids = Union[Records, Sequence[Any]]
IdOrIds = Union[Ids, np.void, VertexId, EdgeId, FaceId, VolumeId, Cell]

_TYPE_OF_WIDTH = {4: CellType.TETRA, 5: CellType.PYRAMID, 6: CellType.WEDGE, 8: CellType.HEXAHEDRON}
_PLANAR_TYPE_OF_WIDTH = {3: CellType.TRIANGLE, 4: CellType.QUAD}


def kind_of_rows(cells: NDArray[Any], dimension: int) -> tuple[CellType, ArrayLike | None, ArrayLike | None]:
    """The type of cells that are rows of points; if it does not tell their size, the type and offset of each."""
    count, width = cells.shape
    if dimension == 2 and width > 4:
        return CellType.NONE, np.full(count, CellType.POLYGON, np.uint8), np.arange(0, cells.size + 1, width).astype(cells.dtype)
    known = _PLANAR_TYPE_OF_WIDTH if dimension == 2 else _TYPE_OF_WIDTH
    if width not in known:
        hint = "; points of the plane have shape (n, 2)" if dimension == 3 and width == 3 else ""
        raise ValueError(f"cells of {width} points need `types`{hint}")
    return known[width], None, None


def rows_of(indices: ArrayLike, width: int, name: str) -> NDArray[Any]:
    """Indices as they are: of another width they would be read as other rows."""
    rows = np.asarray(indices)
    if rows.size and rows.shape[1:] != (width,):
        raise ValueError(f"{name} have shape (n, {width})")
    return rows


def contiguous(points: ArrayLike) -> NDArray[np.float64]:
    """The library takes one stride for all arrays of a call."""
    return np.ascontiguousarray(points, np.float64)


def cell_of(cell: Any) -> Any:
    """The cell that a Cell, an id, or an entry of an array of one of these names."""
    if isinstance(cell, Cell):
        return cell
    if isinstance(cell, np.ndarray) and cell.ndim == 0:
        cell = cell[()]
    if isinstance(cell, np.void):
        if cell.dtype == dtypes.CELL:
            made = Cell()
            for name, value in zip(("kind", "index", "generation", "local"), cell.item()):
                setattr(made, name, value)
            return made
        cell = _id(cell)
    if isinstance(cell, (VertexId, EdgeId, FaceId, VolumeId)):
        return _core.cell_of(cell)
    raise TypeError(f"a Cell, or the id of a vertex, edge, face or volume is needed, not {type(cell).__name__}")


def _id(entry: np.void) -> Any:
    """The id that an entry of an array is. Arrays that NumPy made of others do not tell."""
    metadata: Any = entry.dtype.metadata or {}
    kind = metadata.get("id")
    if kind is None:
        raise TypeError("this entry does not tell what it names: make an id of it, such as VolumeId(*entry)")
    return getattr(_core, kind)(*entry.item())
