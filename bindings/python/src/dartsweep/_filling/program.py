"""What the process does: it reads a pickle of the arguments of `work` from its standard input and writes one of what that gives, or of the
text that tells why the surface can't be filled."""

from __future__ import annotations

import os
import pickle
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import closing, repairing, tetrahedra
from .arrays import Mendable, Points, Refused, merged


def answer() -> None:
    with os.fdopen(os.dup(1), "wb") as out:
        os.dup2(2, 1)  # what others print does not go to the answer
        try:
            found: Any = work(*pickle.load(sys.stdin.buffer))
        except Refused as reason:
            found = str(reason)
        pickle.dump(found, out)


def work(
    points: Points,
    triangles: NDArray[Any],
    scale: float,
    parts: str,
    largest_hole: float,
    outside: str,
    size: float | None,
    thickness: float | None,
    repair: bool = False,
) -> tuple[Any, ...]:
    """The members of FilledSurface."""
    points, triangles = merged(points * scale, triangles)
    notes: tuple[str, ...] = ()
    try:
        points, wall, count, hole_count, part_count = closing.surface(points, triangles, parts, largest_hole)
    except Mendable as reason:
        if not repair:
            raise Refused(f"{reason}; repair=True may mend it") from reason
        (points, wall, count, hole_count, part_count), notes = repairing.repaired(points, triangles, parts, largest_hole, reason)
    is_cap = np.arange(len(wall)) >= count
    return *tetrahedra.filled(points, wall, outside, size, thickness), is_cap, hole_count, part_count, notes
