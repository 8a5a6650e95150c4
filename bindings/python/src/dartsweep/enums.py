"""Constants of the C interface, named as there without their prefixes."""

from __future__ import annotations

from enum import IntEnum, IntFlag

from . import _core


class Constant(IntEnum):
    """A constant that prints as its name; otherwise an integer."""

    def __str__(self) -> str:
        return f"{type(self).__name__}.{self.name}"

    __repr__ = __str__

    def __format__(self, spec: str) -> str:
        return format(str(self) if spec == "" else int(self), spec)


class Flags(IntFlag):
    """Flags that print as their names; otherwise an integer."""

    def __str__(self) -> str:
        names = [flag.name or "" for flag in type(self) if flag and flag in self]
        return f"{type(self).__name__}.{'|'.join(names) or int(self)}"

    __repr__ = __str__

    def __format__(self, spec: str) -> str:
        return format(str(self) if spec == "" else int(self), spec)


class Status(Constant):
    """The result of a call. Values are stable; new values are only appended."""

    OK = _core.STATUS_OK
    NULL_ARGUMENT = _core.STATUS_NULL_ARGUMENT
    BAD_STRUCT_SIZE = _core.STATUS_BAD_STRUCT_SIZE
    UNSUPPORTED = _core.STATUS_UNSUPPORTED
    OUT_OF_RANGE = _core.STATUS_OUT_OF_RANGE
    NON_FINITE = _core.STATUS_NON_FINITE
    WRONG_SIZE = _core.STATUS_WRONG_SIZE
    STALE_ID = _core.STATUS_STALE_ID
    BUFFER_TOO_SMALL = _core.STATUS_BUFFER_TOO_SMALL
    OUT_OF_MEMORY = _core.STATUS_OUT_OF_MEMORY
    TOO_LARGE = _core.STATUS_TOO_LARGE
    INDEX_OUT_OF_RANGE = _core.STATUS_INDEX_OUT_OF_RANGE
    BAD_CELL_TYPE = _core.STATUS_BAD_CELL_TYPE
    BAD_CELL = _core.STATUS_BAD_CELL
    INVERTED_CELL = _core.STATUS_INVERTED_CELL
    INVALID_CELL = _core.STATUS_INVALID_CELL
    DUPLICATE_CELL = _core.STATUS_DUPLICATE_CELL
    SHARED_FACE = _core.STATUS_SHARED_FACE
    BOUNDARY_CROSSES = _core.STATUS_BOUNDARY_CROSSES
    OUTSIDE = _core.STATUS_OUTSIDE
    IMPASSABLE = _core.STATUS_IMPASSABLE
    OCCUPIED = _core.STATUS_OCCUPIED
    IN_USE = _core.STATUS_IN_USE
    SHARED = _core.STATUS_SHARED
    DUPLICATE_ID = _core.STATUS_DUPLICATE_ID
    NOT_FOUND = _core.STATUS_NOT_FOUND
    TRUNCATED = _core.STATUS_TRUNCATED
    CORRUPT = _core.STATUS_CORRUPT
    BAD_VERSION = _core.STATUS_BAD_VERSION
    NOT_ENABLED = _core.STATUS_NOT_ENABLED
    NOT_BUILT = _core.STATUS_NOT_BUILT
    INTERNAL = _core.STATUS_INTERNAL
    BAD_TOPOLOGY = _core.STATUS_BAD_TOPOLOGY
    BORROWED = _core.STATUS_BORROWED
    WRITE_FAILED = _core.STATUS_WRITE_FAILED
    NOT_CLOSED = _core.STATUS_NOT_CLOSED
    REPEATED_VERTEX = _core.STATUS_REPEATED_VERTEX
    DUPLICATE_PART = _core.STATUS_DUPLICATE_PART
    NOT_MANIFOLD = _core.STATUS_NOT_MANIFOLD
    NOT_ORIENTED = _core.STATUS_NOT_ORIENTED
    NOT_CONFORMING = _core.STATUS_NOT_CONFORMING


class LogLevel(Constant):
    """Severity of a log line."""

    NONE = _core.LOG_NONE
    ERROR = _core.LOG_ERROR
    WARNING = _core.LOG_WARNING
    INFO = _core.LOG_INFO


class CellKind(Constant):
    """Kind of a cell."""

    NONE = _core.CELL_NONE
    VERTEX = _core.CELL_VERTEX
    EDGE = _core.CELL_EDGE
    FACE = _core.CELL_FACE
    VOLUME = _core.CELL_VOLUME


class CellType(Constant):
    """Cell types, with the numbers of VTK. The points of each:

    - tetrahedron 0 1 2 3: seen from 3, 0 1 2 turn counter-clockwise;
    - hexahedron: 0 1 2 3 counter-clockwise seen from 4 5 6 7, each of these above its counterpart;
    - wedge: 0 1 2 clockwise seen from 3 4 5, each of these above its counterpart. That is the order of VTK up to 9.6; VTK from 9.7 on
      and Gmsh have 0 2 1 3 5 4;
    - pyramid: base 0 1 2 3 counter-clockwise seen from the apex 4;
    - in the plane triangle, quad and polygon: their points counter-clockwise;
    - polyhedron: a face stream, the count of faces, then for each face the count of its points and the points, counter-clockwise
      seen from outside.
    """

    NONE = _core.CELL_TYPE_NONE
    TRIANGLE = _core.CELL_TYPE_TRIANGLE
    POLYGON = _core.CELL_TYPE_POLYGON
    QUAD = _core.CELL_TYPE_QUAD
    TETRA = _core.CELL_TYPE_TETRA
    HEXAHEDRON = _core.CELL_TYPE_HEXAHEDRON
    WEDGE = _core.CELL_TYPE_WEDGE
    PYRAMID = _core.CELL_TYPE_PYRAMID
    POLYHEDRON = _core.CELL_TYPE_POLYHEDRON


class Outcome(Constant):
    """How a flight ended."""

    NONE = _core.OUTCOME_NONE
    REACHED = _core.OUTCOME_REACHED
    CONTACT = _core.OUTCOME_CONTACT
    WORK_LIMIT = _core.OUTCOME_WORK_LIMIT
    OUTSIDE = _core.OUTCOME_OUTSIDE
    IMPASSABLE = _core.OUTCOME_IMPASSABLE


class ContactKind(Constant):
    """The part of the obstacle that was touched."""

    NONE = _core.CONTACT_NONE
    PLANE = _core.CONTACT_PLANE
    EDGE = _core.CONTACT_EDGE
    VERTEX = _core.CONTACT_VERTEX


class ContactHistory(Constant):
    """Whether the same obstacle stopped the vertex in the body's previous move."""

    NONE = _core.HISTORY_NONE
    NEW = _core.HISTORY_NEW
    LASTING = _core.HISTORY_LASTING


class CrossCheckKind(Constant):
    """What libccd compared."""

    NONE = _core.CROSS_CHECK_NONE
    PLANE = _core.CROSS_CHECK_PLANE
    EDGE = _core.CROSS_CHECK_EDGE
    VERTEX = _core.CROSS_CHECK_VERTEX


class NoCrossCheck(Constant):
    """Why there is no cross-check."""

    NONE = _core.NO_CROSS_CHECK_NONE
    MARKED = _core.NO_CROSS_CHECK_MARKED
    PARALLEL = _core.NO_CROSS_CHECK_PARALLEL
    OUTSIDE_CONE = _core.NO_CROSS_CHECK_OUTSIDE_CONE
    NOT_CONVERGED = _core.NO_CROSS_CHECK_NOT_CONVERGED
    NOT_UNIQUE = _core.NO_CROSS_CHECK_NOT_UNIQUE


class Location(Constant):
    """Where a point is."""

    NONE = _core.LOCATION_NONE
    PASSABLE = _core.LOCATION_PASSABLE
    IMPASSABLE = _core.LOCATION_IMPASSABLE
    OUTSIDE = _core.LOCATION_OUTSIDE


class Level(Constant):
    """What is tested when the end p of an edge moves to p' and the other end q stays."""

    POINTS = _core.LEVEL_POINTS
    EDGES = _core.LEVEL_EDGES
    EDGES_SWEPT = _core.LEVEL_EDGES_SWEPT
    FACES = _core.LEVEL_FACES


class Mark(Constant):
    """The mark of one cell."""

    PASSABLE = _core.MARK_PASSABLE
    IMPASSABLE = _core.MARK_IMPASSABLE


class Search(Constant):
    """How a contact is found."""

    EXACT = _core.SEARCH_EXACT
    EXHAUSTIVE = _core.SEARCH_EXHAUSTIVE
    BISECTION = _core.SEARCH_BISECTION


class Response(Constant):
    """The response to a contact [JCD10] 4.2, figure 5."""

    STOP = _core.RESPONSE_STOP
    ADAPTIVE_ONE = _core.RESPONSE_ADAPTIVE_ONE
    ADAPTIVE_MANY = _core.RESPONSE_ADAPTIVE_MANY
    HYBRID = _core.RESPONSE_HYBRID
    SLIDE = _core.RESPONSE_SLIDE
    ADAPTIVE_SLIDE = _core.RESPONSE_ADAPTIVE_SLIDE


class TogetherStop(Constant):
    """What stops at a contact of bodies that move together."""

    ALL = _core.TOGETHER_STOP_ALL
    ISLAND = _core.TOGETHER_STOP_ISLAND
    FEATURE = _core.TOGETHER_STOP_FEATURE


class PairKind(Constant):
    """A pair of features, and the order of its points."""

    VERTEX_FACE = _core.PAIR_VERTEX_FACE
    EDGE_EDGE = _core.PAIR_EDGE_EDGE
    VERTEX_EDGE = _core.PAIR_VERTEX_EDGE


class DeformMethod(Constant):
    """How bodies and particles are kept in their places."""

    SWEPT = _core.DEFORM_SWEPT
    END_STATE = _core.DEFORM_END_STATE


class WallResponse(Constant):
    """The response of a wall that meets a body or particle."""

    PUSH = _core.WALL_PUSH
    INSERT = _core.WALL_INSERT
    HOLD = _core.WALL_HOLD
    STOP = _core.WALL_STOP


class InvalidResponse(Constant):
    """The response if a volume that is met would become invalid, also in the smallest steps."""

    HOLD = _core.INVALID_HOLD
    REFUSE = _core.INVALID_REFUSE
    REMESH = _core.INVALID_REMESH


class DeformOutcome(Constant):
    """How a deformation ended."""

    DONE = _core.DEFORM_DONE
    HELD = _core.DEFORM_HELD
    FRACTION = _core.DEFORM_FRACTION
    REFUSED = _core.DEFORM_REFUSED
    LIMITED = _core.DEFORM_LIMITED


class EnvironmentFlag(Flags):
    """How an environment is made."""

    REORIENT = _core.ENVIRONMENT_REORIENT
    LOCATE_TREE = _core.ENVIRONMENT_LOCATE_TREE
    CHECK_BOUNDARY = _core.ENVIRONMENT_CHECK_BOUNDARY
    NO_LOCATE_TREE = _core.ENVIRONMENT_NO_LOCATE_TREE
    MERGE_POINTS = _core.ENVIRONMENT_MERGE_POINTS
    CONFORM = _core.ENVIRONMENT_CONFORM
    FIND_TOUCHING = _core.ENVIRONMENT_FIND_TOUCHING
    SPLIT = _core.ENVIRONMENT_SPLIT


class Feature(Flags):
    """Features that a scene can enable."""

    STATISTICS = _core.FEATURE_STATISTICS
    CROSSINGS = _core.FEATURE_CROSSINGS
    DEFORMING = _core.FEATURE_DEFORMING
    BODY_CONTACTS = _core.FEATURE_BODY_CONTACTS
    LIVE_CHANGES = _core.FEATURE_LIVE_CHANGES


class CastFlag(Flags):
    """Flags of CastOptions."""

    START_KNOWN = _core.CAST_START_KNOWN
    NO_DETAIL = _core.CAST_NO_DETAIL


class SweepFlag(Flags):
    """Flags of SweepOptions."""

    START_KNOWN = _core.SWEEP_START_KNOWN
    START_FREE = _core.SWEEP_START_FREE


class MarkFlag(Flags):
    """Flags of calls that mark."""

    SKIP_OCCUPIED = _core.MARK_SKIP_OCCUPIED


class BodyFlag(Flags):
    """Flags of a body: work that is skipped, self-contacts, and whether walls move the body as a whole."""

    SEQUENCES = _core.BODY_SEQUENCES
    SKIP_BY_ENVIRONMENT = _core.BODY_SKIP_BY_ENVIRONMENT
    SKIP_BY_CLEARANCE = _core.BODY_SKIP_BY_CLEARANCE
    SKIP_SIMILAR_MOTION = _core.BODY_SKIP_SIMILAR_MOTION
    SELF_CONTACTS = _core.BODY_SELF_CONTACTS
    SKIP_BACK_EDGES = _core.BODY_SKIP_BACK_EDGES
    RIGID = _core.BODY_RIGID


class MoveFlag(Flags):
    """Flags of MoveOptions."""

    KEEP_WALLS = _core.MOVE_KEEP_WALLS


class NearFlag(Flags):
    """Flags of NearOptions."""

    JACOBIAN = _core.NEAR_JACOBIAN


class PairFlag(Flags):
    """Flags of sweep_pairs in C."""

    RANK = _core.PAIRS_RANK


class CutFlag(Flags):
    """Flags of CutDesc."""

    UNSEW = _core.CUT_UNSEW


class CarveFlag(Flags):
    """Flags of CarveDesc."""

    WHOLE = _core.CARVE_WHOLE


class RecordingFlag(Flags):
    """Flags of recordings."""

    STATES = _core.RECORDING_STATES
    LATEST = _core.RECORDING_LATEST


def _give_to_core() -> None:
    """Members and results of the C interface are these constants from now on."""
    for kind in Constant.__subclasses__():
        register = getattr(_core, f"set_enum_{kind.__name__}", None)
        if register is not None:
            register(dict(kind._value2member_map_))


_give_to_core()
