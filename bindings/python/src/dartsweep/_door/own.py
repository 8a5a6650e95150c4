"""What `dartsweep.plot.grid` writes beside cells, so that a file of it is read as the same environment."""

from __future__ import annotations

import dataclasses
import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .._names import PlaneFrame
from ..enums import CellKind
from ..errors import MeshError, NotFound
from .mesh import Indices, Mesh

if TYPE_CHECKING:
    from ..environment import Environment

NAMES = "dartsweep"
"""A field of a file: names as JSON in UTF-8, as bytes because not every format has text."""
TAGS = "dartsweep:tags"
"""Tags of cells, which only a file of our own has."""
INPUT = "dartsweep:input"
"""Which cell of a data set each cell is, where dartsweep.vtk asks for it: the tag of its volume."""
_FACES, _MARKED_FACES, _MARKED_EDGES, _MARKED_VERTICES = (f"dartsweep:{name}" for name in ("faces", "marked_faces", "marked_edges", "marked_vertices"))
_EXITS, _EXIT_PATCHES = "dartsweep:exits", "dartsweep:exit_patches"


def fields_of(environment: Environment) -> dict[str, NDArray[Any]]:
    """Names of regions and surfaces, and marks of faces, edges and vertices, by the indices of vertices."""
    names = environment._names
    ids = names.surfaces.ids(environment) if names.surfaces.members else np.empty(0, np.int64)
    there = np.flatnonzero(ids["generation"] != 0) if len(ids) else np.empty(0, np.int64)
    place = np.full(len(ids), -1, np.int64)
    place[there] = np.arange(len(there))
    members = {name: place[faces][place[faces] >= 0].tolist() for name, faces in names.surfaces.members.items()}
    text = {
        "regions": {name: list(labels) for name, labels in names.regions.items()},
        "surfaces": [[name, names.surfaces.tags[name], faces] for name, faces in members.items()],
        "plane": None if names.plane is None else [names.plane.origin.tolist(), names.plane.axes.tolist()],
    }
    offsets, corners = names.surfaces.offsets, names.surfaces.vertices
    made: dict[str, NDArray[Any]] = {
        NAMES: np.frombuffer(json.dumps(text).encode(), np.uint8),
        _FACES: _stream([corners[offsets[i] : offsets[i + 1]] for i in there]),
        _MARKED_FACES: _stream(_marked(environment, CellKind.FACE)),
        _MARKED_EDGES: _stream(_marked(environment, CellKind.EDGE)),
        _MARKED_VERTICES: _marked_vertices(environment),
        _EXITS: _stream([environment.vertices(face)["index"].astype(np.int64) for face in environment.exit_faces()]),
        _EXIT_PATCHES: np.array([environment.exit_of(face) for face in environment.exit_faces()], np.int64),
    }
    return {name: array for name, array in made.items() if len(array)}  # PyVista has no empty arrays


def _stream(rows: list[Indices]) -> Indices:
    """The number of vertices of each row among them."""
    return np.concatenate([np.empty(0, np.int64), *([len(row), *row] for row in rows)]).astype(np.int64)


def _rows(stream: Any) -> tuple[Indices, Indices]:
    """Offsets and vertices of a stream."""
    offsets, rows, at = [0], [np.empty(0, np.int64)], 0
    stream = np.asarray(stream, np.int64)
    while at < len(stream):
        rows.append(stream[at + 1 : at + 1 + stream[at]])
        offsets.append(offsets[-1] + len(rows[-1]))
        at += 1 + int(stream[at])
    return np.array(offsets, np.int64), np.concatenate(rows)


def volumes_of(environment: Environment) -> Any:
    """Ids of all volumes, by index."""
    for index in range(environment.info.volume_index_count):
        try:
            yield environment.volume_id(index)
        except NotFound:  # removed
            continue


def _marked(environment: Environment, kind: CellKind) -> list[Indices]:
    """Vertices of each face or edge that has a mark of its own."""
    found: dict[tuple[int, ...], Indices] = {}
    if (kind == CellKind.EDGE and environment.dimension == 2) or environment.mark_count(kind) == 0:  # there are no edges in the plane
        return []
    id_of = environment.face_id if kind == CellKind.FACE else environment.edge_id
    for volume in volumes_of(environment):
        counts = environment.volume_counts(volume)
        for local in range(counts.faces if kind == CellKind.FACE else counts.edges):
            cell = id_of(volume, local)
            if environment.is_marked(cell):
                corners = environment.vertices(cell)["index"].astype(np.int64)
                found.setdefault(tuple(sorted(corners.tolist())), corners)
    return list(found.values())


def _marked_vertices(environment: Environment) -> Indices:
    if environment.mark_count(CellKind.VERTEX) == 0:
        return np.empty(0, np.int64)
    marked = []
    for index in range(environment.info.vertex_index_count):
        try:
            if environment.is_marked(environment.vertex_id(index)):
                marked.append(index)
        except NotFound:  # removed
            continue
    return np.array(marked, np.int64)


def restored(mesh: Mesh) -> Mesh:
    """A mesh whose file plot.grid has made, with what it says of itself; any other as it is."""
    fields = mesh.fields
    if NAMES not in fields or not {"region", "tag", "marked"} <= set(mesh.cell_data):
        return mesh
    try:
        text = json.loads(np.asarray(fields[NAMES]).astype(np.uint8).tobytes())
        names: dict[str, Any] = {name: tuple(labels) for name, labels in text["regions"].items()}
        groups = {name: np.array(faces, np.int64) for name, _, faces in text["surfaces"]}
        tags = {name: int(tag) for name, tag, _ in text["surfaces"]}
        offsets, corners = _rows(fields.get(_FACES, ()))
        if max((int(faces.max(initial=-1)) for faces in groups.values()), default=-1) >= len(offsets) - 1:
            raise ValueError("surfaces name faces that there are not")
    except (KeyError, TypeError, ValueError) as error:
        raise MeshError(mesh.source, f"its field {NAMES!r} is damaged ({error})", "without this field the file is read without names") from error
    return dataclasses.replace(
        mesh,
        regions=mesh.cell_data["region"], region_names=names, cell_groups={}, cell_data={**mesh.cell_data, TAGS: mesh.cell_data["tag"]},
        face_offsets=offsets, face_vertices=corners, face_groups=groups, face_numbers=tags, face_data={},
    )  # fmt: skip


def mark(environment: Environment, mesh: Mesh) -> None:
    """Sets the marks that a file of plot.grid has, and says where its plane lay."""
    if TAGS not in mesh.cell_data:
        return
    fields: dict[str, Any] = mesh.fields
    for index in np.flatnonzero(mesh.cell_data["marked"]).tolist():
        environment.mark_volumes(environment.volume_id(index))
    if _MARKED_FACES in fields:
        environment.mark_faces(environment.find_faces(*_rows(fields[_MARKED_FACES])))
    if _MARKED_EDGES in fields:
        environment.mark_edges(environment.find_edges(_rows(fields[_MARKED_EDGES])[1].reshape(-1, 2)))
    if _MARKED_VERTICES in fields:
        environment.mark_vertices([environment.vertex_id(int(index)) for index in fields[_MARKED_VERTICES]])
    if _EXITS in fields:
        patches = np.asarray(fields[_EXIT_PATCHES])
        faces = environment.find_faces(*_rows(fields[_EXITS]))
        for patch in np.unique(patches).tolist():
            environment.mark_exits(faces[patches == patch], patch)
    plane = json.loads(np.asarray(fields[NAMES]).astype(np.uint8).tobytes()).get("plane")
    environment._names.plane = None if plane is None else PlaneFrame(np.array(plane[0]), np.array(plane[1]))
