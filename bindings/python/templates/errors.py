"""An exception for each status of the C interface. All derive from Error; some also from the built-in one of that meaning."""

from __future__ import annotations

from . import _core
from ._door.error import MeshError as MeshError
from .enums import Status


class Error(Exception):
    """A call has failed, and nothing has changed. The text is the library's; `status` is the kind of failure."""

    status: Status = Status.INTERNAL


# {errors}


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
