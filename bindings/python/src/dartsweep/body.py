"""Bodies: vertices joined by edges and, where they are surfaces, by triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, dtypes
from ._core import BodyCounts, BodyEdgeId, BodyEdit, BodyFaceId, BodyId, BodyVertexId, MoveOptions, MoveReport, NearOptions, RigidMotion, VolumeId
from .enums import Level, NearFlag
from .errors import Error
from .options import options as described

if TYPE_CHECKING:
    from ._shapes import Records


class _SparseRows(NamedTuple):
    data: NDArray[np.float64]
    indices: NDArray[np.int32]
    indptr: NDArray[np.int32]


class NearJacobian(_SparseRows):
    """Compressed sparse rows as SciPy takes them: csr_matrix(jacobian, shape=jacobian.shape). Row i has the entries
    indptr[i] to indptr[i + 1] - 1; a column is dimension * vertex + axis."""

    shape: tuple[int, int] = (0, 0)


class Body:
    """A body of a scene, made by Scene.create_body. The scene owns the body; destroy() removes it."""

    __slots__ = ("_core",)

    def __init__(self, scene: Any, body: BodyId) -> None:
        self._core: Any = _core.Body(scene, body)

    def __repr__(self) -> str:
        try:
            counts = self.counts
        except Error as error:
            return f"<dartsweep.Body: {error}>"
        return f"<dartsweep.Body: {counts.vertex_count} vertices, {counts.edge_count} edges, {counts.face_count} faces>"

    @property
    def id(self) -> BodyId:
        """The id of the body in its scene."""
        return self._core.id()  # type: ignore[no-any-return]

    def destroy(self) -> None:
        """Removes the body; any call then raises StaleId."""
        self._core.destroy()

    @property
    def counts(self) -> BodyCounts:
        """Numbers of vertices, edges and triangles, and upper bounds of their indices."""
        return self._core.get_counts()  # type: ignore[no-any-return]

    @property
    def level(self) -> Level:
        """The part of a move that is tested. A higher level raises Occupied if the body is not free at that level."""
        return Level(self._core.get_level())

    @level.setter
    def level(self, level: int) -> None:
        self._core.set_level(level)

    @property
    def filter(self) -> tuple[int, int]:
        """Category and mask, which decide the bodies that this body meets."""
        both = self._core.get_filter()
        return both.category, both.mask

    @filter.setter
    def filter(self, values: tuple[int, int]) -> None:
        self._core.set_filter(*values)

    @property
    def radius(self) -> float:
        """The distance that the body keeps from everything. A larger radius raises Occupied if something is too near."""
        return self._core.get_radius()  # type: ignore[no-any-return]

    @radius.setter
    def radius(self, radius: float) -> None:
        self._core.set_radius(radius)

    def least_gap(self, limit: float) -> float:
        """A lower bound of the least gap: distance less the radii, over all that the body must not touch; at most `limit`."""
        return self._core.find_least_gap(limit)  # type: ignore[no-any-return]

    # --- penetrations of a body that was created with BodyFlag.START_PENETRATING

    @property
    def is_penetrating(self) -> bool:
        """Whether the body was created where it is not free, and has not been freed yet. Nothing meets it until then."""
        return self._core.is_penetrating()  # type: ignore[no-any-return]

    def penetrations(self) -> Records:
        """What a penetrating body crosses where it lies (dtypes.PENETRATION): walls, and parts of bodies."""
        return self._core.find_penetrations()  # type: ignore[no-any-return]

    def depenetrate(self, inside: Any = None, max_distance: float = 0.0) -> float | None:
        """Moves a penetrating body to where it is exactly free; returns the distance of the vertex that moved farthest. None: it could not be freed,
        and stays where it is; Scene.offending_edges() gives what is left. inside: a volume on the side of the walls to go to, by default where most
        of the body is."""
        made = self._core.depenetrate(VolumeId(0, 0) if inside is None else inside, max_distance)
        return made.distance if made.freed else None

    # --- parts

    def positions(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Positions by vertex index; free slots have zeros."""
        positions = np.empty((self.counts.vertex_slots, self._core.dimension())) if out is None else out
        self._core.get_positions(positions, None)
        return positions

    def volumes(self) -> Records:
        """Volumes that hold the vertices, by index."""
        slots = self.counts.vertex_slots
        volumes = np.empty(slots, dtypes.VOLUME_ID)
        self._core.get_positions(np.empty((slots, self._core.dimension())), volumes)
        return volumes

    def vertex_ids(self) -> Records:
        """Ids of the vertices."""
        return self._core.get_vertex_ids()  # type: ignore[no-any-return]

    def edge_ids(self) -> Records:
        """Ids of the edges."""
        return self._core.get_edge_ids()  # type: ignore[no-any-return]

    def untested_edges(self) -> Records:
        """Ids of the edges that BodyFlag.LEAVE_BACK_EDGES has left untested where they are. All others are free."""
        return self._core.get_untested_edges()  # type: ignore[no-any-return]

    def face_ids(self) -> Records:
        """Ids of the triangles."""
        return self._core.get_face_ids()  # type: ignore[no-any-return]

    def vertex_id(self, index: int) -> BodyVertexId:
        """Id of the vertex with an index."""
        return self._core.get_vertex_id(index)  # type: ignore[no-any-return]

    def edge_ends(self, edge: Any) -> Records:
        """Ids of the two ends of an edge."""
        return self._core.get_edge_ends(edge)  # type: ignore[no-any-return]

    def face_corners(self, face: Any) -> Records:
        """Ids of the three corners of a triangle."""
        return self._core.get_face_corners(face)  # type: ignore[no-any-return]

    def edge_indices(self) -> NDArray[np.uint32]:
        """Indices of the ends of all edges, by index of the edge; 2**32 - 1 in free slots."""
        return self._core.get_edge_indices().reshape(-1, 2)  # type: ignore[no-any-return]

    def face_indices(self) -> NDArray[np.uint32]:
        """Indices of the corners of all triangles, by index of the triangle; 2**32 - 1 in free slots."""
        return self._core.get_face_indices().reshape(-1, 3)  # type: ignore[no-any-return]

    def add_vertex(self, position: ArrayLike, hint: Any = None) -> BodyVertexId:
        """Adds a vertex without edges; `hint` is a volume near the vertex."""
        return self._core.add_vertex(position, hint)  # type: ignore[no-any-return]

    def add_edge(self, a: Any, b: Any) -> BodyEdgeId:
        """Adds an edge between two vertices. Raises RepeatedVertex, DuplicatePart, or Occupied if the edge is not free."""
        return self._core.add_edge(a, b)  # type: ignore[no-any-return]

    def add_face(self, a: Any, b: Any, c: Any) -> BodyFaceId:
        """Adds a triangle and its missing edges. Raises NotManifold or NotOriented as well."""
        return self._core.add_face(a, b, c)  # type: ignore[no-any-return]

    def remove_vertex(self, vertex: Any) -> None:
        """Removes a vertex with its edges and faces."""
        self._core.remove_vertex(vertex)

    def remove_edge(self, edge: Any) -> None:
        """Removes an edge with its faces."""
        self._core.remove_edge(edge)

    def remove_face(self, face: Any) -> None:
        """Removes a triangle; its edges stay."""
        self._core.remove_face(face)

    def split_edge(self, edge: Any, edge_parameter: float = 0.5) -> BodyEdit:
        """Splits an edge and its triangles at a place on the edge, 0 to 1 from its first end; returns the new parts."""
        return self._core.split_edge(edge, edge_parameter)  # type: ignore[no-any-return]

    def collapse_edge(self, edge: Any, vertex: Any) -> BodyEdit:
        """Moves a vertex to the other end of an edge and merges it there; the way is swept."""
        return self._core.collapse_edge(edge, vertex)  # type: ignore[no-any-return]

    # --- moves

    def move(self, targets: ArrayLike, options: MoveOptions | None = None, order: ArrayLike | None = None) -> MoveReport:
        """Moves vertices to targets (by index), one after the other, each as far as it is free; `order` lists the vertices that move."""
        return self._core.move(targets, options, order)  # type: ignore[no-any-return]

    def move_rigid(
        self,
        translation: ArrayLike = (0.0, 0.0, 0.0),
        rotation: ArrayLike = (0.0, 0.0, 0.0, 1.0),
        centre: ArrayLike = (0.0, 0.0, 0.0),
        options: MoveOptions | None = None,
        order: ArrayLike | None = None,
    ) -> MoveReport:
        """Moves the whole body as far as it is free: rotated (quaternion x, y, z, w; in the plane x and y are 0) round a centre, then translated.
        With MoveFlag.SLIDE_WHOLE in the options it slides on along what it touches."""
        motion = described(RigidMotion, translation=_in_space(translation), rotation=rotation, centre=_in_space(centre))
        return self._core.move_rigid(motion, options, order)  # type: ignore[no-any-return]

    def motion_left(self) -> RigidMotion:
        """The motion from where the last move_rigid has left the body to where it should be."""
        return self._core.get_motion_left()  # type: ignore[no-any-return]

    def ways_left(self) -> NDArray[np.float64]:
        """By vertex index, the way from where Scene.move_together or Scene.deform has left a vertex to its target; empty after other moves."""
        return self._core.get_ways_left().reshape(-1, self._core.dimension())  # type: ignore[no-any-return]

    def find_free_fractions(
        self, poses: ArrayLike, paths: Any, centre: ArrayLike = (0.0, 0.0, 0.0), contacts: Records | None = None
    ) -> Records:
        """How far the body could go along paths through poses (dtypes.FREE_FRACTION), from each pose to the next as by move_rigid. Nothing moves.

        poses: of shape (n, 7): a quaternion x, y, z, w and a translation, from where the body is now, round a centre. paths: indices of poses, of
        shape (m, k), or a list of lists of any length but 0; a list of one only asks whether the pose is free. `contacts` (dtypes.BODY_CONTACT) is
        filled where it is given: with what stops each path, zeros for nothing.
        """
        places = np.ascontiguousarray(poses, np.float64)
        if places.ndim != 2 or places.shape[1] != 7:
            raise ValueError("poses are an array of shape (n, 7)")
        indices, offsets = _joined(paths)
        if (indices < 0).any() or (indices >= len(places)).any():
            raise IndexError(f"paths have indices of {len(places)} poses")
        fractions = np.empty(len(offsets) - 1, dtypes.FREE_FRACTION)
        about = np.asarray(centre, np.float64)[: self._core.dimension()]
        self._core.find_free_fractions(
            about, places.reshape(-1), indices.astype(np.uint32), offsets.astype(np.uint32), fractions, contacts
        )
        return fractions

    def contacts(self) -> Records:
        """Contacts of the last move (dtypes.BODY_CONTACT), in order."""
        return self._core.get_contacts()  # type: ignore[no-any-return]

    def contact_partners(self) -> Records:
        """The other bodies of these contacts, with Feature.BODY_CONTACTS."""
        return self._core.get_contact_partners()  # type: ignore[no-any-return]

    def previous_contacts(self) -> Records:
        """The previous contacts of the vertices of these contacts (dtypes.PREVIOUS_CONTACT)."""
        return self._core.get_previous_contacts()  # type: ignore[no-any-return]

    def edits(self) -> Records:
        """Vertices that responses inserted and removed in the last move."""
        return self._core.get_edits()  # type: ignore[no-any-return]

    def exits(self) -> Records:
        """Vertices that left in the last move with MoveFlag.LEAVE (dtypes.EXIT)."""
        return self._core.get_exits()  # type: ignore[no-any-return]

    # --- near rows

    def near_rows(self, margin: float, radius: float = 0.0, jacobian: bool = False) -> Records:
        """Parts of the body whose gap to something is at most the margin (dtypes.NEAR_ROW), in order of their keys. `radius` is added
        to the body's own."""
        flags = NearFlag.JACOBIAN if jacobian else 0
        self._core.find_near_rows(described(NearOptions, margin=margin, radius=radius, flags=flags))
        return self._core.get_near_rows()  # type: ignore[no-any-return]

    def near_jacobian(self) -> NearJacobian:
        """Derivatives of the gaps of the last near_rows(..., jacobian=True) by the coordinates of the vertices."""
        offsets = self._core.get_near_offsets().view(np.int32)
        columns = self._core.get_near_columns().view(np.int32)
        jacobian = NearJacobian(self._core.get_near_values(), columns, offsets)
        jacobian.shape = max(len(offsets) - 1, 0), self._core.dimension() * self.counts.vertex_slots
        return jacobian


def _joined(paths: Any) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The indices of all paths, one path after the other, and where each path begins."""
    if isinstance(paths, np.ndarray) and paths.ndim == 2:  # one array, whatever its length
        lengths, indices = np.full(len(paths), paths.shape[1], np.int64), paths.reshape(-1)
    else:
        ways = [np.asarray(path).reshape(-1) for path in paths]
        lengths = np.array([len(way) for way in ways], np.int64)
        indices = np.concatenate([way for way in ways if len(way) > 0] or [np.empty(0, np.int64)])
    if not np.issubdtype(indices.dtype, np.integer):
        raise TypeError(f"paths are of integers, not {indices.dtype}")
    return indices.astype(np.int64), np.concatenate([[0], np.cumsum(lengths)])


def _in_space(vector: ArrayLike) -> NDArray[np.float64]:
    """A vector of the plane has the third coordinate 0 there."""
    vector = np.asarray(vector, np.float64)
    return np.append(vector, 0.0) if vector.shape == (2,) else vector
