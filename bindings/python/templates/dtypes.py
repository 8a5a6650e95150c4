"""NumPy's types of arrays of ids, reports and contacts: laid out as the structs of the C interface, so that neither side converts."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core

F8, U4, I4 = np.dtype(np.float64), np.dtype(np.uint32), np.dtype(np.int32)


def _struct(*fields: tuple[Any, ...]) -> np.dtype[np.void]:
    return np.dtype(list(fields), align=True)


def _id(kind: str, *names: str) -> np.dtype[np.void]:
    """Kinds of ids have the same layout: the metadata tell them apart, also where an id is a field of a result."""
    return np.dtype([(name, U4) for name in names], align=True, metadata={"id": kind})


# {types}


def surface(length: int) -> np.dtype[np.void]:
    """The type of what Environment.surfaces_of tells: a tag and a name of at most this length."""
    return np.dtype([("tag", np.int64), ("name", f"U{length}")])


# {registered}
