"""Environments: a partition of a bounded part of space into volumes, some of them passable."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import TracebackType
from typing import Any
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, dtypes
from ._core import (
    BodyContact,
    CastOptions,
    Cell,
    CoarsenOptions,
    CrossCheck,
    DeformOptions,
    DeformReport,
    EdgeId,
    EnvironmentInfo,
    FaceId,
    Flight,
    Nearest,
    Neighbour,
    SweepOptions,
    VertexId,
    VolumeCounts,
    VolumeId,
)
from ._names import Labels, Named, Names
from ._names import PlaneFrame as PlaneFrame
from ._shapes import IdOrIds as IdOrIds
from ._shapes import Ids as Ids
from ._shapes import Records as Records
from ._shapes import cell_of, contiguous, kind_of_rows
from ._topology import Topology
from .enums import CastFlag, EnvironmentFlag, Location, Mark, Outcome
from .errors import TouchingParts
from .options import options as described


def _count_rows(rows: NDArray[np.int64]) -> int:
    weights = np.array([1, 0x1E3779B97F4A7C15, 0x3F58476D1CE4E5B9], dtype=np.int64)
    keys = np.sort(rows @ weights[: rows.shape[1]])  # products wrap round: a hash
    return 1 + int(np.count_nonzero(keys[1:] != keys[:-1]))


def _warn_of_gaps(points: NDArray[np.float64]) -> None:
    """Tells whether points of a mesh of several parts differ by rounding alone: parts would touch without that."""
    lower = points.min(axis=0)
    distance = 1e-9 * float(np.max(points.max(axis=0) / 2 - lower / 2)) * 2
    if not 0 < distance < np.inf:
        return
    places = _count_rows((points + 0.0).view(np.int64)) - _count_rows(np.rint((points - lower) / distance).astype(np.int64))
    if places > 0:
        warn(
            f"the mesh has several parts, and {places} points lie within {distance:.3g} of others: such a gap is a wall; "
            f"merge_points={distance:.3g} makes one of these points, inner_walls=True tells that walls are meant",
            stacklevel=3,
        )


class Environment(Named, Topology):
    """A volume mesh in which particles and bodies move, or a mesh of polygons in the plane. Close it, or use it in a `with` statement; scenes of it go on
    until they are closed, too.

    points: (n, 3) float64. cells: integers of shape (n, 4), (n, 5), (n, 6) or (n, 8), tetrahedra, pyramids, wedges or hexahedra
    in the orders that CellType tells, which are those of VTK but for its wedges from 9.7 on; or in one dimension, with `types` (CellType of each) and, but for face streams of polyhedra in `faces`,
    `offsets` as in VTK's unstructured grids. In the plane points are (n, 2), cells (n, 3) or more, triangles, quads or polygons; they are the
    "volumes" and their sides the "faces", and wherever points are asked for they have two coordinates. regions, tags: a label and a host's tag for each cell. flags: EnvironmentFlag.
    Faces of a mesh that lie on faces of other cells without having their points are walls, and mostly nobody means that: TouchingParts is raised
    if there are any, but for three arguments. merge_points: points within this distance count as one, 0.0: points at one place; then fewer
    faces touch. conform: faces that faces of other cells cover are split, too, so that both sides sew (merge_points then also tells how far a
    point may be from an edge or face that it lies on). inner_walls: they are walls. A mesh of several parts with points that differ by less
    than 1e-9 of its size gives a UserWarning: a gap of rounding is a wall, too.
    split: cells whose mean does not see all of their faces, such as an L, are split into parts; `parent` gives the cell of a part. Cells
    with repeated points are what is left of them.
    region_names: names of labels, which calls then take in place of these; a name may have several labels. threads: of batches, 0 for one per processor. log: called with (LogLevel, text) for each line of the library's log.
    """

    __slots__ = ("_core", "_log", "_names", "__weakref__")

    def __init__(
        self,
        points: ArrayLike,
        cells: ArrayLike,
        types: ArrayLike | None = None,
        offsets: ArrayLike | None = None,
        *,
        regions: ArrayLike | None = None,
        tags: ArrayLike | None = None,
        faces: ArrayLike | None = None,
        face_locations: ArrayLike | None = None,
        flags: int = 0,
        merge_points: float | None = None,
        conform: bool = False,
        split: bool = False,
        inner_walls: bool = False,
        region_names: Mapping[str, Labels] | None = None,
        threads: int = 0,
        log: Callable[[int, str], object] | None = None,
    ) -> None:
        points, cells = np.asarray(points), np.asarray(cells)
        dimension = 2 if points.ndim == 2 and points.shape[1] == 2 else 3
        flags = int(flags)
        if merge_points is not None:
            flags |= EnvironmentFlag.MERGE_POINTS
        if conform:
            flags |= EnvironmentFlag.CONFORM
        if split:
            flags |= EnvironmentFlag.SPLIT
        must_not_touch = not conform and not inner_walls
        if must_not_touch:
            flags |= EnvironmentFlag.FIND_TOUCHING
        desc = described(_core.EnvironmentDesc, flags=flags, dimension=dimension, merge_distance=merge_points or 0.0)
        if cells.ndim == 2 and types is None:
            kind, types, offsets = kind_of_rows(cells, dimension)
            desc.uniform_cell_type = int(kind)
        elif types is None:
            raise ValueError("cells in one dimension need `types`; rows, such as (n, 4) for tetrahedra, need none")
        self._names = Names(region_names)
        self._log = None if log is None else _core.Log(log)
        context = None if log is None and threads == 0 else _core.Context(threads, self._log)
        self._core: Any = _core.Environment(
            points, cells, offsets, types, regions, tags, faces, face_locations, desc, context
        )
        if must_not_touch:
            self._refuse_touching()
        if not inner_walls and self._core.build_report().part_count > 1:
            _warn_of_gaps(np.array(points, dtype=np.float64, order="C"))

    def _refuse_touching(self) -> None:
        report = self._core.build_report()
        if report.touching_face_count != 0:
            self.close()
            raise TouchingParts.of(report)

    @classmethod
    def _of(cls, core: Any, names: Names, log: Any = None) -> Environment:
        made = cls.__new__(cls)
        made._core, made._log, made._names = core, log, names
        return made

    @classmethod
    def load(cls, block: bytes, region_names: Mapping[str, Labels] | None = None) -> Environment:
        """Loads a snapshot that `save` made: the same cells, ids and bits. A snapshot has labels of regions, but no names. Pickling keeps
        all names."""
        return cls._of(_core.Environment.load(block), Names(region_names))

    def save(self) -> bytes:
        """A snapshot, which pickle and copy use as well. Threads and log are not saved."""
        return self._core.save()  # type: ignore[no-any-return]

    def __reduce__(self) -> tuple[Any, ...]:
        self._names.surfaces.ids(self)  # changes of the topology are not pickled
        return _loaded, (self.save(), self._names.copy())

    def close(self) -> None:
        """Closes the environment. A second close is allowed; any other call then raises Closed."""
        self._core.close()

    @property
    def closed(self) -> bool:
        """Whether close() has been called."""
        return self._core.is_closed()  # type: ignore[no-any-return]

    def __enter__(self) -> Environment:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        if self.closed:
            return "<dartsweep.Environment, closed>"
        info = self.info
        return f"<dartsweep.Environment: {info.volume_count} volumes, {info.vertex_count} vertices>"

    @property
    def dimension(self) -> int:
        """2 in the plane, else 3: how many coordinates points have."""
        return self._core.dimension()  # type: ignore[no-any-return]

    @property
    def info(self) -> EnvironmentInfo:
        """Counts, bounds and memory."""
        return self._core.info()  # type: ignore[no-any-return]

    def check(self) -> None:
        """Proves that the cells are a partition, and that the outer boundary does not pass through itself; raises an error if not."""
        self._core.check_all()

    def coarsen(self, options: CoarsenOptions | None = None) -> tuple[Environment, NDArray[np.uint32]]:
        """A coarser environment with the same obstacles and merged tetrahedra; and for each volume index the index of its new volume."""
        volume_map = np.empty(self.info.volume_index_count, np.uint32)
        self._names.surfaces.ids(self)
        return Environment._of(self._core.coarsen(options, volume_map), self._names.copy(), self._log), volume_map

    # --- cells

    def volume_id(self, index: int) -> VolumeId:
        """Id of the volume that was made from cell `index`, or that has this index now."""
        return self._core.get_volume_id(index)  # type: ignore[no-any-return]

    def vertex_id(self, index: int) -> VertexId:
        """Id of the vertex with an index."""
        return self._core.get_vertex_id(index)  # type: ignore[no-any-return]

    def vertex_position(self, vertex: Any) -> NDArray[np.float64]:
        """The position of a vertex."""
        return self._core.get_vertex_position(vertex)  # type: ignore[no-any-return]

    def points(self) -> NDArray[np.float64]:
        """Positions of all vertices, by index: a copy."""
        return self._core.get_points().reshape(-1, self.dimension)  # type: ignore[no-any-return]

    def centre(self, volume: Any) -> NDArray[np.float64]:
        """The mean of a volume's vertices, rounded."""
        return self._core.get_centre(volume)  # type: ignore[no-any-return]

    def volume_counts(self, volume: Any) -> VolumeCounts:
        """Type of a volume and numbers of its vertices, edges and faces."""
        return self._core.get_volume_counts(volume)  # type: ignore[no-any-return]

    def face_id(self, volume: Any, local: int) -> FaceId:
        """Canonical id of a face of a volume."""
        return self._core.get_face_id(volume, local)  # type: ignore[no-any-return]

    def edge_id(self, volume: Any, local: int) -> EdgeId:
        """Canonical id of an edge of a volume; in the plane there are none."""
        return self._core.get_edge_id(volume, local)  # type: ignore[no-any-return]

    def vertices(self, cell: Any) -> Records:
        """Ids of the vertices of a cell: a Cell, or any id of vertex, edge, face or volume."""
        return self._core.copy_vertices(cell_of(cell))  # type: ignore[no-any-return]

    def face_volumes(self, face: Any) -> tuple[VolumeId, VolumeId]:
        """The two volumes of a face; the second id is null at the outer boundary."""
        both = self._core.get_face_volumes(face)
        return both.near_side, both.far_side

    def neighbour(self, volume: Any, local: int) -> Neighbour:
        """The volume behind a face of a volume, and whether the face is impassable."""
        return self._core.get_neighbour(volume, local)  # type: ignore[no-any-return]

    def find_faces(self, offsets: ArrayLike, indices: ArrayLike) -> Records:
        """Ids of faces, in the plane sides, by their vertices: face i has indices[offsets[i] : offsets[i + 1]]; null ids where there is none."""
        return self._core.find_faces(offsets, indices)  # type: ignore[no-any-return]

    def find_edges(self, pairs: ArrayLike) -> Records:
        """Ids of edges by their two vertices."""
        return self._core.find_edges(pairs)  # type: ignore[no-any-return]

    def region(self, volume: Any) -> int:
        """Region label of a volume."""
        return self._core.get_region(volume)  # type: ignore[no-any-return]

    def parent(self, volume: Any) -> int:
        """The index of the cell that was given of which a volume is all or a part. `NotFound`: it was added later to an environment
        whose cells were split."""
        return self._core.get_parent(volume)  # type: ignore[no-any-return]

    def tag(self, volume: Any) -> int:
        """A host's tag of a volume."""
        return self._core.get_tag(volume)  # type: ignore[no-any-return]

    def set_tag(self, volume: Any, tag: int) -> None:
        """Sets the tag of a volume."""
        self._core.set_tag(volume, tag)

    def is_valid(self, volume: Any) -> bool:
        """Whether a volume is valid where its vertices are now."""
        return self._core.is_valid(volume)  # type: ignore[no-any-return]

    # --- queries

    def locate(self, point: ArrayLike, hint: Any = None) -> tuple[VolumeId, Location]:
        """The volume that contains a point, exactly (null outside), and where the point is."""
        found = self._core.locate(point, hint)
        return found.volume, Location(found.location)

    def locate_points(self, points: ArrayLike, hints: Ids | None = None) -> tuple[Records, NDArray[np.int32]]:
        """Ids of the volumes that contain points, and the Location of each."""
        points = np.asarray(points, np.float64)
        volumes = np.empty(len(points), dtypes.VOLUME_ID)
        locations = np.empty(len(points), np.int32)
        self._core.locate_points(points, hints, volumes, locations)
        return volumes, locations

    def classify(self, point: ArrayLike, volume: Any) -> Cell:
        """The cell of lowest dimension on which a point of a volume lies."""
        return self._core.classify(point, volume)  # type: ignore[no-any-return]

    def cast(self, start: ArrayLike, end: ArrayLike, volume: Any = None, options: CastOptions | None = None) -> Flight:
        """The first impassable face on a segment. `volume`: one near the start, or the one that holds it (CastFlag.START_KNOWN)."""
        return self._core.cast(start, end, volume, options)  # type: ignore[no-any-return]

    def cast_segments(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        volumes: Ids | None = None,
        options: CastOptions | None = None,
        out: Records | None = None,
    ) -> Records:
        """Flights (dtypes.FLIGHT) of many segments, written to `out` where it is given."""
        starts, ends = contiguous(starts), contiguous(ends)
        flights = np.empty(len(starts), dtypes.FLIGHT) if out is None else out
        self._core.cast_segments(starts, ends, volumes, options, flights)
        return flights

    def sees(self, starts: ArrayLike, ends: ArrayLike) -> NDArray[np.bool_]:
        """Whether the way between two points is free, exactly, for many of them: points of a surface see each other, as what touches the
        ends alone does not count. It is free if it runs through passable volumes and touches no impassable face."""
        options = described(CastOptions, flags=int(CastFlag.OPEN_ENDS | CastFlag.NO_DETAIL))
        flights = self.cast_segments(starts, ends, options=options)
        return np.asarray(flights["outcome"] == Outcome.REACHED)

    def cast_path(
        self, start: ArrayLike, end: ArrayLike, volume: Any = None, options: CastOptions | None = None
    ) -> Records:
        """Every volume that a segment enters (dtypes.CROSSING), in order."""
        return self._core.cast_path(start, end, volume, options)  # type: ignore[no-any-return]

    def find_nearest(self, point: ArrayLike, radius: float = float("inf"), volume: Any = None) -> Nearest:
        """The nearest impassable thing within a radius that can be seen from a point."""
        return self._core.find_nearest(point, radius, volume)  # type: ignore[no-any-return]

    def signed_distances(self, points: ArrayLike) -> NDArray[np.float64]:
        """How far each point, of shape (n, 3) or (3,), is from the outer boundary, whatever is marked; negative inside. Signs are exact."""
        given = np.asarray(points, np.float64)
        rows = given.reshape(-1, given.shape[-1])
        distances = np.empty(len(rows))
        self._core.find_signed_distances(rows, distances)
        return distances.reshape(given.shape[:-1])

    def inside(self, points: ArrayLike, by: float = 0.0, hints: Ids | None = None, volumes: Records | None = None) -> NDArray[np.float64]:
        """The nearest place that is inside for each point, of shape (n, 3) or (3,): in a passable volume and on nothing impassable. In C this
        is dsw_environment_find_inside. Points inside stay as they are. Others go to the nearest place of the boundary and from there `by`
        along its normal, or where that is not free towards the middle of the volume there; 0 is as little as rounding allows. `volumes`,
        of the places, are filled where they are given; a null id says that there is none."""
        given = np.asarray(points, np.float64)
        rows = given.reshape(-1, given.shape[-1])
        found = np.empty(rows.shape)
        self._core.find_inside(rows, by, hints, found, volumes)
        return found.reshape(given.shape)

    def find_nearest_to_points(
        self,
        points: ArrayLike,
        radius: float = float("inf"),
        hints: Ids | None = None,
        out: Records | None = None,
        volumes: Records | None = None,
        locations: NDArray[np.int32] | None = None,
    ) -> Records:
        """What is nearest to each point (dtypes.NEAREST), written to `out` where it is given. Filled, too, where they are given: the
        `volumes` of the points, which may be the hints of the next call, and the Location of each."""
        points = np.asarray(points, np.float64)
        nearest = np.empty(len(points), dtypes.NEAREST) if out is None else out
        self._core.find_nearest_to_points(points, radius, hints, nearest, volumes, locations)
        return nearest

    def find_nearest_to_segments(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        radius: float = float("inf"),
        hints: Ids | None = None,
        out: Records | None = None,
        volumes: Records | None = None,
        locations: NDArray[np.int32] | None = None,
    ) -> Records:
        """What is nearest to each segment (dtypes.SEGMENT_NEAREST); `hints`, `volumes` and `locations` are of the starts."""
        starts, ends = contiguous(starts), contiguous(ends)
        nearest = np.empty(len(starts), dtypes.SEGMENT_NEAREST) if out is None else out
        self._core.find_nearest_to_segments(starts, ends, radius, hints, nearest, volumes, locations)
        return nearest

    def sweep_edges(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        fixed: ArrayLike,
        volumes: Ids | None = None,
        options: SweepOptions | None = None,
        out: Records | None = None,
    ) -> Records:
        """Reports (dtypes.SWEEP) of edges whose first end moves from `starts` to `ends` while the other stays at `fixed`."""
        starts, ends, fixed = contiguous(starts), contiguous(ends), contiguous(fixed)
        sweeps = np.empty(len(starts), dtypes.SWEEP) if out is None else out
        self._core.sweep_edges(starts, ends, fixed, volumes, options, sweeps)
        return sweeps

    def cross_check(self, contact: BodyContact | np.void) -> CrossCheck:
        """The normal of a contact, computed a second time by libccd. Raises NotBuilt where the library has no libccd."""
        return self._core.cross_check(contact)  # type: ignore[no-any-return]

    # --- marks

    def mark_volumes(self, volumes: IdOrIds, mark: int = Mark.IMPASSABLE, flags: int = 0) -> int:
        """Sets the mark of volumes; returns the number of occupied volumes that were skipped (MarkFlag.SKIP_OCCUPIED)."""
        return self._core.mark_volumes(volumes, mark, flags)  # type: ignore[no-any-return]

    def mark_faces(self, faces: IdOrIds, mark: int = Mark.IMPASSABLE) -> None:
        """Sets the mark of faces."""
        self._core.mark_faces(faces, mark)

    def mark_edges(self, edges: IdOrIds, mark: int = Mark.IMPASSABLE) -> None:
        """Sets the mark of edges."""
        self._core.mark_edges(edges, mark)

    def mark_vertices(self, vertices: IdOrIds, mark: int = Mark.IMPASSABLE) -> None:
        """Sets the mark of vertices."""
        self._core.mark_vertices(vertices, mark)

    def mark_exits(self, faces: IdOrIds, patch: int = 1) -> None:
        """Makes faces of the outer boundary an exit with this number, through which particles leave, and vertices with MoveFlag.LEAVE; with 0
        none any more."""
        self._core.mark_exits(faces, patch)

    def exit_of(self, face: Any) -> int:
        """The number of the exit that a face is, or 0."""
        return self._core.get_exit(face)  # type: ignore[no-any-return]

    def exit_faces(self) -> Records:
        """The faces of all exits."""
        return self._core.get_exit_faces()  # type: ignore[no-any-return]

    def is_marked(self, cell: Any) -> bool:
        """Whether the cell itself carries a mark."""
        return self._core.is_marked(cell_of(cell))  # type: ignore[no-any-return]

    def is_impassable(self, cell: Any) -> bool:
        """Whether a cell is impassable, by its own mark or because of others."""
        return self._core.is_impassable(cell_of(cell))  # type: ignore[no-any-return]

    def mark_count(self, kind: int) -> int:
        """How many cells of a CellKind carry a mark."""
        return self._core.get_mark_count(kind)  # type: ignore[no-any-return]

    # --- deformation, with Feature.DEFORMING of a scene

    def deform(self, positions: NDArray[np.float64], options: DeformOptions | None = None) -> DeformReport:
        """Takes the environment to new positions of its vertices.

        The array is lent, not copied: float64, C-contiguous, writable, of shape (n, 3), or (n, 2) in the plane, with n the environment's vertex indices. The
        environment keeps it and reads it until the next deformation; the one before is free again. It is written where a
        vertex could not go all of its way. More rows are room for vertices that cuts add.
        """
        return self._core.deform(positions, options)  # type: ignore[no-any-return]

    def wall_contacts(self) -> Records:
        """Contacts of walls in the last deformation (dtypes.WALL_CONTACT)."""
        return self._core.get_wall_contacts()  # type: ignore[no-any-return]

    def held_vertices(self) -> Records:
        """Vertices that the last deformation did not take to their targets."""
        return self._core.get_held_vertices()  # type: ignore[no-any-return]

    def invalid_volumes(self) -> Records:
        """Volumes that the last deformation kept from becoming invalid."""
        return self._core.get_invalid_volumes()  # type: ignore[no-any-return]


def _loaded(block: bytes, names: Names) -> Environment:
    return Environment._of(_core.Environment.load(block), names)
