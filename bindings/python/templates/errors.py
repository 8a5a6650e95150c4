"""An exception for each status of the C interface. All derive from Error; some also from the built-in one of that meaning."""

from __future__ import annotations

from . import _core
from ._door.error import MeshError as MeshError
from .enums import Status


class Error(Exception):
    """A call has failed, and nothing has changed. The text is the library's; `status` is the kind of failure."""

    status: Status = Status.INTERNAL


# {errors}


class Closed(NullArgument):
    """The object was closed before."""


def _subclasses(cls: type[Error]) -> list[type[Error]]:
    return [cls] + [below for direct in cls.__subclasses__() for below in _subclasses(direct)]


_core.set_errors({**{int(cls.status): cls for cls in _subclasses(Error)[1:] if cls is not Closed}, -1: Closed})
