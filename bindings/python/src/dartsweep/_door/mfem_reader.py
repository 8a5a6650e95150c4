"""Files that MFEM reads: its own formats, also curved, periodic, NURBS and refined ones, and Netgen's."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from . import linear
from .linear import Cells
from .ragged import groups_by_number
from .raw import Raw

_TYPES = {0: (1, 1), 1: (3, 2), 2: (5, 3), 3: (9, 4), 4: (10, 4), 5: (12, 8), 6: (13, 6), 7: (14, 5)}  # of Geometry: VTK's, corners
_SQUARE = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]
_TRIANGLE = [_SQUARE[0], _SQUARE[1], _SQUARE[3]]
_TOP = (0.0, 0.0, 1.0)
_REFERENCE = {  # corners of the reference elements
    **{0: _SQUARE[:1], 1: _SQUARE[:2], 2: _TRIANGLE, 3: _SQUARE, 4: [*_TRIANGLE, _TOP], 7: [*_SQUARE, _TOP]},
    **{5: [*_SQUARE, *((x, y, 1.0) for x, y, _ in _SQUARE)], 6: [*_TRIANGLE, *((x, y, 1.0) for x, y, _ in _TRIANGLE)]},
}
_WAY_ON = "a program of MFEM can write it anew"


def read(path: str, source: str, format: str, quadratic: str = "corners") -> Raw:
    """The cells and boundary elements of a file. Attributes are labels; their names are groups."""
    import mfem.ser as mfem

    try:
        mesh = mfem.Mesh(path, 1, 0, False)  # cells stay as they are turned, and nothing is printed
    except Exception as error:
        reason = str(error).partition("MFEM abort:")[2].partition("...")[0].strip() or str(error)
        raise MeshError(source, f"MFEM can't read it ({' '.join(reason.split())})", _WAY_ON) from error
    if mesh.SpaceDimension() < 2:
        raise MeshError(source, "it is a mesh of lines in one dimension", "a mesh of volumes, or of triangles, quads or polygons, is needed")
    notes: list[str] = []
    if mesh.GetNodes() is not None:
        mesh, notes = _linear(mfem, mesh, quadratic)
    if mesh.Nonconforming():
        notes.append("cells were refined beside others: faces between cells of different size are split, unless an option says otherwise")
    points, cells, boundary = _places(mfem, mesh)
    raw = Raw(points, linear.joined([cells, boundary]), source=source, reader="MFEM", notes=notes, hangs=bool(mesh.Nonconforming()))
    attributes = [mesh.GetAttribute(i) for i in range(mesh.GetNE())], [mesh.GetBdrAttribute(i) for i in range(mesh.GetNBE())]
    raw.regions = np.array(attributes[0] + attributes[1], np.int64)
    _add_names(mesh, raw, len(attributes[0]))
    return raw


def _linear(mfem: Any, mesh: Any, quadratic: str) -> tuple[Any, list[str]]:
    """The mesh with straight sides: with its corners, or divided."""
    order = mesh.GetNodes().FESpace().GetMaxElementOrder()
    if order <= 1:
        return mesh, []
    if quadratic == "split":
        return mfem.Mesh.MakeRefined(mesh, order, mfem.BasisType.ClosedUniform), []
    return mesh, [f'{mesh.GetNE()} cells of degree {order} were taken by their corners; quadratic="split" follows their curves']


def _places(mfem: Any, mesh: Any) -> tuple[NDArray[np.float64], Cells, Cells]:
    elements = [(mesh.GetElementGeometry(i), mesh.GetElementVertices(i)) for i in range(mesh.GetNE())]
    sides = [(mesh.GetBdrElementGeometry(i), mesh.GetBdrElementVertices(i)) for i in range(mesh.GetNBE())]
    cells, boundary = _cells(elements), _cells(sides)
    if mesh.GetNodes() is None:
        vertices = mfem.Vector()
        mesh.GetVertices(vertices)
        return vertices.GetDataArray().reshape(mesh.SpaceDimension(), -1).T.copy(), cells, boundary
    own = [_corners(mfem, mesh.GetElementTransformation(i), elements[i][0]) for i in range(len(elements))]
    points = np.concatenate(own) if own else np.empty((0, 3))
    known = np.full((mesh.GetNV(), points.shape[1]), np.nan)
    known[cells.flat] = points
    if np.array_equal(known[cells.flat], points):
        return known, cells, boundary
    return _periodic(mfem, mesh, points, cells, boundary)


def _periodic(mfem: Any, mesh: Any, points: Any, cells: Cells, boundary: Cells) -> tuple[NDArray[np.float64], Cells, Cells]:
    """A vertex of a periodic mesh is at several places; each becomes a point."""
    keys = np.concatenate([points, cells.flat[:, None]], axis=1)
    different, inverse = np.unique(keys + 0.0, axis=0, return_inverse=True)
    cells = Cells(cells.types, cells.offsets, np.ravel(inverse))
    index = {tuple(key): i for i, key in enumerate(different.tolist())}
    own = [_corners(mfem, mesh.GetBdrElementTransformation(i), mesh.GetBdrElementGeometry(i)) for i in range(len(boundary.types))]
    if own:
        side_keys = np.concatenate([np.concatenate(own), boundary.flat[:, None]], axis=1) + 0.0
        found = np.array([index.get(tuple(key), -1) for key in side_keys.tolist()], np.int64)
        is_known = np.minimum.reduceat(found, boundary.offsets[:-1]) >= 0
        boundary = Cells(np.where(is_known, boundary.types, 0).astype(np.uint8), boundary.offsets, np.maximum(found, 0))
    return np.ascontiguousarray(different[:, :-1]), cells, boundary


def _cells(found: list[tuple[int, Any]]) -> Cells:
    types = np.array([_TYPES[kind][0] for kind, _ in found], np.uint8)
    sizes = np.array([_TYPES[kind][1] for kind, _ in found], np.int64)
    flat = np.concatenate([np.empty(0, np.int64), *(np.asarray(vertices, np.int64) for _, vertices in found)])
    return Cells(types, np.concatenate([np.zeros(1, np.int64), np.cumsum(sizes)]), flat)


def _corners(mfem: Any, transformation: Any, geometry: int) -> NDArray[np.float64]:
    point = mfem.IntegrationPoint()
    made = np.empty((_TYPES[geometry][1], transformation.GetSpaceDim()))
    for i, corner in enumerate(_REFERENCE[geometry]):
        point.Set3(*corner)
        made[i] = transformation.Transform(point)
    return made


def _add_names(mesh: Any, raw: Raw, count: int) -> None:
    """Attributes of boundary elements are groups by number; sets of attributes are groups by name."""
    of_number = [groups_by_number(raw.regions[:count]), groups_by_number(raw.regions[count:])]
    for number, members in of_number[1].items():
        raw.groups[str(number)], raw.numbers[str(number)] = count + members, number
    for sets, groups, shift in ((mesh.attribute_sets, of_number[0], 0), (mesh.bdr_attribute_sets, of_number[1], count)):
        for name in sorted(sets.GetAttributeSetNames()):
            numbers = [int(number) for number in sets.GetAttributeSet(name).ToList()]
            raw.groups[name] = shift + np.concatenate([np.empty(0, np.int64), *(groups[i] for i in numbers if i in groups)])
            if shift == 0 and len(numbers) == 1:
                raw.region_names[name] = numbers[0]
            elif len(numbers) == 1:
                raw.numbers[name] = numbers[0]
                raw.groups.pop(str(numbers[0]), None)
