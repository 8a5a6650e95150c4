"""An exception for each status of the C interface. All derive from Error; some also from the built-in one of that meaning."""

from __future__ import annotations

from . import _core
from ._door.error import MeshError as MeshError
from .enums import Status


class Error(Exception):
    """A call has failed, and nothing has changed. The text is the library's; `status` is the kind of failure."""

    status: Status = Status.INTERNAL


class NullArgument(Error):
    """A required pointer or handle is null."""

    status = Status.NULL_ARGUMENT


class BadStructSize(Error):
    """struct_size is smaller than the first release's struct."""

    status = Status.BAD_STRUCT_SIZE


class Unsupported(Error, ValueError):
    """The library does not know a value, a flag or a non-zero member."""

    status = Status.UNSUPPORTED


class OutOfRange(Error, ValueError):
    """An index or number lies outside the documented range."""

    status = Status.OUT_OF_RANGE


class NonFinite(Error, ValueError):
    """A coordinate is NaN or infinite."""

    status = Status.NON_FINITE


class WrongSize(Error, ValueError):
    """Sizes, strides or offsets of arrays contradict each other."""

    status = Status.WRONG_SIZE


class StaleId(Error, LookupError):
    """The id names nothing that exists."""

    status = Status.STALE_ID


class BufferTooSmall(Error):
    """The count argument was set to the capacity that is needed."""

    status = Status.BUFFER_TOO_SMALL


class OutOfMemory(Error, MemoryError):
    """The allocator returned null."""

    status = Status.OUT_OF_MEMORY


class TooLarge(Error):
    """More cells or points than 28-bit indices can name."""

    status = Status.TOO_LARGE


class IndexOutOfRange(Error, IndexError):
    """A cell names a point that does not exist."""

    status = Status.INDEX_OUT_OF_RANGE


class BadCellType(Error):
    """A cell type is unknown."""

    status = Status.BAD_CELL_TYPE


class BadCell(Error):
    """Repeated points in a cell, or faces that do not close a sphere."""

    status = Status.BAD_CELL


class InvertedCell(Error):
    """A cell is turned inside out."""

    status = Status.INVERTED_CELL


class InvalidCell(Error):
    """A cell is flat, folded, or not seen whole from the mean of its vertices."""

    status = Status.INVALID_CELL


class DuplicateCell(Error):
    """Two cells lie on the same side of one face."""

    status = Status.DUPLICATE_CELL


class SharedFace(Error):
    """A face belongs to three cells or more."""

    status = Status.SHARED_FACE


class BoundaryCrosses(Error):
    """The outer boundary passes through itself."""

    status = Status.BOUNDARY_CROSSES


class Outside(Error):
    """The point lies in no cell."""

    status = Status.OUTSIDE


class Impassable(Error):
    """The point lies in an impassable volume."""

    status = Status.IMPASSABLE


class Occupied(Error):
    """The change would make a cell impassable that something occupies."""

    status = Status.OCCUPIED


class InUse(Error):
    """Scenes (or other scenes) use the environment."""

    status = Status.IN_USE


class Shared(Error):
    """Several scenes share the environment: it can't be changed."""

    status = Status.SHARED


class DuplicateId(Error):
    """An id occurs twice in a batch."""

    status = Status.DUPLICATE_ID


class NotFound(Error, LookupError):
    """No cell has these vertices."""

    status = Status.NOT_FOUND


class Truncated(Error):
    """The snapshot block ends early."""

    status = Status.TRUNCATED


class Corrupt(Error):
    """The snapshot block is damaged."""

    status = Status.CORRUPT


class BadVersion(Error):
    """The snapshot block was written by an unknown format version."""

    status = Status.BAD_VERSION


class NotEnabled(Error):
    """The scene has not enabled the feature that this call needs."""

    status = Status.NOT_ENABLED


class NotBuilt(Error, NotImplementedError):
    """The library was built without this part."""

    status = Status.NOT_BUILT


class Internal(Error):
    """A bug of the library; please report the message."""

    status = Status.INTERNAL


class BadTopology(Error):
    """The cells are not arranged as the change needs them; the message says how."""

    status = Status.BAD_TOPOLOGY


class Borrowed(Error):
    """The points belong to the host and have no room for another vertex."""

    status = Status.BORROWED


class WriteFailed(Error):
    """A recording could not be written."""

    status = Status.WRITE_FAILED


class NotClosed(Error):
    """The body is not a closed surface."""

    status = Status.NOT_CLOSED


class RepeatedVertex(Error):
    """An edge or face of a body repeats a vertex."""

    status = Status.REPEATED_VERTEX


class DuplicatePart(Error):
    """A body has an edge or face twice."""

    status = Status.DUPLICATE_PART


class NotManifold(Error):
    """A body would not be a manifold."""

    status = Status.NOT_MANIFOLD


class NotOriented(Error):
    """Faces of a body are turned against each other."""

    status = Status.NOT_ORIENTED


class NotConforming(Error):
    """Parts of a mesh lie on each other and can't be sewn."""

    status = Status.NOT_CONFORMING


class TouchingParts(NotConforming):
    """Faces of a mesh lie on faces of other cells, and no argument of Environment says that they are walls."""

    way_on = (
        "merge_points=0.0 (or a distance) makes one of the points at one place, conform=True also splits faces that other faces cover, "
        "inner_walls=True leaves them as walls"
    )

    def __init__(self, found: str) -> None:
        super().__init__(f"{found}; {self.way_on}")
        self.found = found
        """What lies where."""

    def __reduce__(self) -> tuple[type[TouchingParts], tuple[str]]:
        return TouchingParts, (self.found,)

    @classmethod
    def of(cls, report: _core.BuildReport) -> TouchingParts:
        """Makes the error of an environment in which faces touch."""
        first, other = report.touching_face, report.touched_face
        return cls(
            f"{report.touching_face_count} faces of the boundary lie on faces of other cells, and casts would stop there: first face "
            f"{first.local} of cell {first.volume}, on face {other.local} of cell {other.volume}"
        )


class Closed(NullArgument):
    """The object was closed before."""


def _subclasses(cls: type[Error]) -> list[type[Error]]:
    return [cls] + [below for direct in cls.__subclasses__() for below in _subclasses(direct)]


_core.set_errors({**{int(cls.status): cls for cls in _subclasses(Error)[1:] if cls not in (Closed, TouchingParts)}, -1: Closed})
