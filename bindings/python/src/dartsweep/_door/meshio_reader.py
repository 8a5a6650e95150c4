"""Files that meshio reads, and its meshes. Its wedges are taken as Gmsh numbers them, which most of its formats do."""

from __future__ import annotations

import contextlib
import io
import re
from typing import Any

import numpy as np

from .error import MeshError
from .mapped import mapped
from . import fluent_faces, linear, nastran_systems, polyhedra
from .linear import Cells
from .mesh import Indices
from .ragged import groups_by_number, offsets_of
from .raw import Raw

_TYPES = {
    **{"vertex": 1, "line": 3, "triangle": 5, "polygon": 7, "pixel": 8, "quad": 9, "tetra": 10, "voxel": 11, "hexahedron": 12},
    **{"wedge": 13, "pyramid": 14, "penta_prism": 15, "hexa_prism": 16, "line3": 21, "triangle6": 22, "quad8": 23, "tetra10": 24},
    **{"hexahedron20": 25, "wedge15": 26, "pyramid13": 27, "quad9": 28, "hexahedron27": 29, "quad6": 30, "wedge12": 31, "wedge18": 32},
    **{"hexahedron24": 33, "triangle7": 34, "line4": 35, "triangle10": 69, "quad16": 70, "tetra20": 71, "hexahedron64": 72},
    **{"wedge40": 73, "triangle15": 69, "quad25": 70, "tetra35": 71, "hexahedron125": 72, "wedge75": 73, "pyramid14": 37},
    **{"VTK_LAGRANGE_CURVE": 68, "VTK_LAGRANGE_TRIANGLE": 69, "VTK_LAGRANGE_QUADRILATERAL": 70, "VTK_LAGRANGE_TETRAHEDRON": 71},
    **{"VTK_LAGRANGE_HEXAHEDRON": 72, "VTK_LAGRANGE_WEDGE": 73, "VTK_LAGRANGE_PYRAMID": 74},
}
_GMSH, _FAMILIES = "gmsh:physical", "cell_tags"
_WAY_ON = "a program that reads the file can write it anew, such as ParaView or Gmsh"
_LOSES_CELLS = re.compile(
    r"cannot handle|Unsupported \S+ element|know (?:keyword |Gmf)?(?:Tetra|Hexa|Pri|Pyr|Wedge|Tri|Quad)|geomtype|[Ss]kipping (?:2D|those)|could not parse"
)
_MIRRORED_BY_FORMAT = {
    "med": {10: [0, 2, 1, 3], 12: [0, 3, 2, 1, 4, 7, 6, 5], 13: [0, 2, 1, 3, 5, 4], 14: [0, 3, 2, 1, 4]},
    "gmsh": {32: [*range(6), 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16], 37: [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12, 13]},
    "permas": {22: [0, 2, 4, 1, 3, 5], 24: [0, 2, 4, 9, 1, 3, 5, 6, 7, 8]},  # middles stand between the corners
}
_UNKNOWN_ORDERS = {"permas": (23, 25, 26, 27, 28, 29)}


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file; format: a name of meshio's."""
    import meshio

    if format == "ansys" and fluent_faces.has_faces(path):
        raise MeshError(source, "meshio would keep its faces and leave out its cells", _WAY_ON)
    if format == "nastran" and nastran_systems.has_any(path, source):
        raise MeshError(source, "meshio would take points of other coordinate systems for global ones", nastran_systems.WAY_ON)
    if format == "xdmf" and _has_other_numbers(path):
        raise MeshError(source, "meshio would leave out BaseOffset or Order of its topology", _WAY_ON)
    output = io.StringIO()
    try:
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            mesh = meshio.read(path, format)
    except (Exception, SystemExit) as error:  # it ends the program, or its readers stumble over what they do not expect
        printed = " ".join(output.getvalue().split())
        reason = str(error) if isinstance(error, Exception) and str(error) else printed
        raise MeshError(source, f"meshio can't read it ({reason or type(error).__name__})", _WAY_ON) from error
    printed = " ".join(output.getvalue().split())
    if _LOSES_CELLS.search(printed):
        raise MeshError(source, f"meshio would leave out a part ({printed})", _WAY_ON)
    raw = raw_of(mesh, source)
    if np.any(np.isin(raw.cells.types, _UNKNOWN_ORDERS.get(format, ()))):
        raise MeshError(source, "meshio does not know the order of the nodes of its quadratic cells", _WAY_ON)
    _mirror(raw.cells, _MIRRORED_BY_FORMAT.get(format, {}))
    return raw


def _has_other_numbers(path: str) -> bool:
    """Whether points of an XDMF file have numbers that do not begin with 0, or stand in an order of their own."""
    with mapped(path) as text:
        heads: list[bytes] = re.findall(rb"<Topology\b[^>]*>", text)
    return any(re.search(rb"""\bOrder\s*=|\bBaseOffset\s*=\s*["']\s*0*[1-9]""", head) for head in heads)


def raw_of(mesh: Any, source: str) -> Raw:
    """The cells of a meshio.Mesh, with its cell data and its sets."""
    parts = [_cells_of(block, source) for block in mesh.cells]
    starts = offsets_of([len(part.types) for part in parts])
    raw = Raw(np.asarray(mesh.points, np.float64), linear.joined(parts), source=source, reader="meshio")
    for name, arrays in mesh.cell_data.items():
        raw.data[name] = _data(name, arrays, starts, source)
    for name, blocks in getattr(mesh, "cell_sets", {}).items():
        if not name.startswith("gmsh:"):
            raw.groups[name] = _set(name, blocks, starts, source)
    raw.fields = dict(getattr(mesh, "field_data", {}) or {})
    if _GMSH in raw.data:
        _name_physical_groups(raw)
    _name_families(raw, getattr(mesh, "cell_tags", None) or {})
    return raw


def _cells_of(block: Any, source: str) -> Cells:
    if block.type.startswith("polyhedron"):
        faces = [[np.asarray(face, np.int64) for face in cell] for cell in block.data]
        every = [face for cell in faces for face in cell]
        points = np.concatenate(every) if every else np.empty(0, np.int64)
        return polyhedra.cells_of_faces([len(cell) for cell in faces], [len(face) for face in every], points)
    kind = 7 if block.type.startswith("polygon") else _TYPES.get(block.type)
    if kind is None:
        raise MeshError(source, f"{len(block.data)} cells have the type '{block.type}'", "its cells have to be divided into linear ones first")
    rows = block.data
    if isinstance(rows, list) and len({len(row) for row in rows}) > 1:
        sizes = [len(row) for row in rows]
        return Cells(np.full(len(rows), kind, np.uint8), offsets_of(sizes), np.concatenate([np.asarray(row, np.int64) for row in rows]))
    rows = np.asarray(rows)
    if rows.ndim != 2:
        return Cells(np.empty(0, np.uint8), np.zeros(1, np.int64), np.empty(0, np.int64))
    return linear.uniform(kind, rows)


def _data(name: str, arrays: Any, starts: Indices, source: str) -> Any:
    """Rows of all blocks; blocks without have 0."""
    values = [np.asarray(array) for array in arrays]
    sizes = np.diff(starts).tolist()
    for i, array in enumerate(values):
        if len(array) != sizes[i]:
            raise MeshError(source, f"cell data '{name}' has {len(array)} rows for the {sizes[i]} cells of block {i}", "the data has to be mended")
    return np.concatenate(values)


def _set(name: str, blocks: Any, starts: Indices, source: str) -> Indices:
    chosen = [np.empty(0, np.int64)]
    for i, members in enumerate(blocks):
        if members is None or len(members) == 0:
            continue
        members = np.asarray(members, np.int64)
        if members.max() >= starts[i + 1] - starts[i] or members.min() < 0:
            count = starts[i + 1] - starts[i]
            raise MeshError(source, f"the set '{name}' names cell {members.max()} of a block of {count} cells", "the set has to be mended")
        chosen.append(starts[i] + members)
    return np.concatenate(chosen)


def _name_physical_groups(raw: Raw) -> None:
    """Gmsh's physical groups: of volumes they are regions, all are groups. A name tells its number and dimension."""
    physical = raw.data[_GMSH]
    raw.regions = physical
    dimensions = linear.DIMENSION[raw.cells.types]
    highest = int(dimensions.max(initial=0))
    for name, pair in raw.fields.items():
        pair = np.ravel(pair)
        if len(pair) == 2 and pair.dtype.kind in "iu":
            members = np.flatnonzero((physical == pair[0]) & (dimensions == pair[1]))
            raw.groups[name] = np.union1d(raw.groups.get(name, members), members)
            if pair[1] == highest:
                raw.region_names[name] = int(pair[0])
            else:
                raw.numbers[name] = int(pair[0])


def _name_families(raw: Raw, names: dict[int, list[str]]) -> None:
    """MED's families: each cell is in one, which names its groups."""
    if not names or _FAMILIES not in raw.data:
        return
    for number, members in groups_by_number(raw.data[_FAMILIES]).items():
        for name in names.get(number, ()):
            raw.groups[name] = np.concatenate([raw.groups.get(name, np.empty(0, np.int64)), members])


def _mirror(cells: Cells, orders: dict[int, list[int]]) -> None:
    """Turns types that a format numbers in another way."""
    for kind, order in orders.items():
        rows = np.flatnonzero(cells.types == kind)
        starts = cells.offsets[rows][:, None]
        cells.flat[starts + np.arange(len(order))] = cells.flat[starts + np.array(order)]
