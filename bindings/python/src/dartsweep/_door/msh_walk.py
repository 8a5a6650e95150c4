"""Whether a binary .msh file of version 4.1 is whole, so that Gmsh can read it in the caller's process: each section has the size that it
says, and elements have nodes that are there. Gmsh trusts all of that."""

from __future__ import annotations

import mmap
import struct

import numpy as np
from numpy.typing import NDArray

_HEAD = b"$MeshFormat\n4.1 1 8\n\x01\0\0\0"
_NODES_OF = {  # how many nodes an element has, by Gmsh's types
    **{15: 1, 1: 2, 2: 3, 3: 4, 4: 4, 5: 8, 6: 6, 7: 5, 8: 3, 9: 6, 10: 9, 11: 10, 12: 27, 13: 18, 14: 14, 16: 8, 17: 20, 18: 15, 19: 13},
}
_MOST_ENTITIES = 100_000


class _Damaged(Exception):
    """Something is not as it should be, or not known here."""


def is_whole(path: str) -> bool:
    """Looks at all sections. False: damaged, of another version, or with a section that is not known here. O(elements), about 40 ns each."""
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        try:
            _walk(_Place(text))
        except (_Damaged, struct.error, ValueError, OverflowError):
            return False
    return True


class _Place:
    """Where in the file the walk is."""

    def __init__(self, text: mmap.mmap) -> None:
        self.text, self.at = text, 0

    def take(self, layout: str) -> tuple[int, ...]:
        found = struct.unpack_from("<" + layout, self.text, self.at)
        self.at += struct.calcsize("<" + layout)
        return found

    def skip(self, size: int) -> None:
        if not 0 <= size <= len(self.text) - self.at:
            raise _Damaged
        self.at += size

    def array(self, count: int) -> NDArray[np.uint64]:
        """A copy, since the file can't be closed while something looks into it."""
        start = self.at
        self.skip(8 * count)
        return np.frombuffer(self.text[start : self.at], "<u8")

    def line(self) -> bytes:
        end = self.text.find(b"\n", self.at)
        if end < 0:
            raise _Damaged
        found = self.text[self.at : end]
        self.at = end + 1
        return found.strip()


def _walk(place: _Place) -> None:
    if place.text[: len(_HEAD)] != _HEAD:
        raise _Damaged
    place.skip(len(_HEAD))
    _end(place, b"MeshFormat")
    known: NDArray[np.bool_] | None = None
    seen: list[bytes] = []
    while place.at < len(place.text):
        name = place.line()
        seen.append(name)
        if seen.count(name) > 1:
            raise _Damaged
        if name == b"$PhysicalNames":
            for _ in range(min(int(place.line()), _MOST_ENTITIES)):
                place.line()
        elif name == b"$Entities":
            _entities(place)
        elif name == b"$Nodes":
            known = _nodes(place)
        elif name == b"$Elements" and known is not None:
            _elements(place, known)
        else:
            raise _Damaged
        _end(place, name[1:])
    if b"$Elements" not in seen:
        raise _Damaged


def _end(place: _Place, name: bytes) -> None:
    while (line := place.line()) == b"":
        pass
    if line != b"$End" + name:
        raise _Damaged


def _entities(place: _Place) -> None:
    counts = place.take("4Q")
    if sum(counts) > _MOST_ENTITIES:
        raise _Damaged
    for dimension, count in enumerate(counts):
        for _ in range(count):
            place.skip(4 + 8 * (3 if dimension == 0 else 6))
            for _ in range(1 if dimension == 0 else 2):  # physical groups, and then the entities round it
                place.skip(4 * place.take("Q")[0])


def _nodes(place: _Place) -> NDArray[np.bool_]:
    """Which tags are those of nodes."""
    blocks, count, _, largest = place.take("4Q")
    if largest > len(place.text):  # tags far apart: not worth a table
        raise _Damaged
    known = np.zeros(largest + 1, np.bool_)
    for _ in range(blocks):
        dimension, _, parametric, size = place.take("3iQ")
        tags = place.array(size)
        if not 0 <= dimension <= 3 or (size and (int(tags.max()) > largest or int(tags.min()) == 0)):
            raise _Damaged
        known[tags] = True
        place.skip(8 * size * (3 + (dimension if parametric else 0)))
    if np.count_nonzero(known) != count:
        raise _Damaged
    return known


def _elements(place: _Place, known: NDArray[np.bool_]) -> None:
    blocks, count, _, _ = place.take("4Q")
    for _ in range(blocks):
        dimension, _, kind, size = place.take("3iQ")
        if kind not in _NODES_OF or not 0 <= dimension <= 3:
            raise _Damaged
        nodes = place.array(size * (1 + _NODES_OF[kind])).reshape(size, -1)[:, 1:]
        if size and (int(nodes.max()) >= len(known) or not known[nodes].all()):
            raise _Damaged
        count -= size
    if count != 0:
        raise _Damaged
