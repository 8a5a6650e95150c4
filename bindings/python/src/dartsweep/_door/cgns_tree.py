"""The tree of nodes in a CGNS file: HDF5 by h5py, or ADF, which the older files are. Arrays are as in Fortran: the first index is the fastest."""

from __future__ import annotations

import dataclasses
import functools
import importlib
import math
import mmap
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

_HDF5, _ADF = b"\x89HDF", b"ADF Data"
_ROOT = 266
_TYPES = {"I4": "i4", "I8": "i8", "U4": "u4", "U8": "u8", "R4": "f4", "R8": "f8", "C1": "S1", "B1": "u1"}


class NoTree(Exception):
    """The file has no tree that can be read here; its text says why."""


@dataclasses.dataclass
class Node:
    """A node. Its data are read when they are asked for."""

    name: str
    label: str
    children: list[Node]
    load: Callable[[], Any] = lambda: None

    def data(self) -> Any:
        """The numbers in one row, the first index the fastest, or None."""
        found = self.load()
        return None if found is None else np.asarray(found)

    def text(self) -> str:
        """The data as a text."""
        found = self.data()
        return "" if found is None else found.astype(np.uint8 if found.dtype.kind in "iu" else found.dtype).tobytes().decode("latin-1").strip(" \0")

    def all(self, label: str) -> Iterator[Node]:
        """The children with a label."""
        return (child for child in self.children if child.label == label)

    def child(self, name: str) -> Node | None:
        """The child with a name, or None."""
        return next((child for child in self.children if child.name == name), None)


def zones(path: str) -> list[tuple[Node, Node]]:
    """All zones, each with its base. Raises NoTree."""
    with open(path, "rb") as file:
        head = file.read(12)
    try:
        root = _of_hdf5(path) if head[:4] == _HDF5 else _of_adf(path) if head[4:] == _ADF else None
    except (OSError, ValueError, KeyError, IndexError, RecursionError) as error:
        raise NoTree(f"its tree is damaged ({type(error).__name__} {error})") from error
    if root is None:
        raise NoTree("it is neither HDF5 nor ADF")
    return [(base, zone) for base in root.all("CGNSBase_t") for zone in base.all("Zone_t")]


def _of_hdf5(path: str) -> Node:
    try:
        h5py: Any = importlib.import_module("h5py")
    except ImportError as error:
        raise NoTree("h5py, which reads the names of its surfaces, is not installed") from error

    def load(path: str, name: str) -> Any:
        with h5py.File(path, "r") as file:
            return np.ravel(file[name][()])  # C's order of the file is Fortran's of the node

    def node(name: str, group: Any, depth: int) -> Node:
        label = group.attrs.get("label", b"")
        inner = [node(key, child, depth + 1) for key, child in group.items() if isinstance(child, h5py.Group)] if depth < 9 else []
        made = Node(name, label.decode() if isinstance(label, bytes) else str(label), inner)
        if " data" in group:
            data = group[" data"]
            made.load = functools.partial(load, data.file.filename, data.name)  # a link may lead into another file
        return made

    with h5py.File(path, "r") as file:
        return node("", file, 0)


def _of_adf(path: str) -> Node:
    with open(path, "rb") as file:
        text = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    is_big = text[100:101] == b"B"
    is_hexadecimal = text[25:26] == b"A"  # of database version A...: later ones have integers

    def number(at: int, size: int) -> int:
        return int(text[at : at + size], 16) if is_hexadecimal else int.from_bytes(text[at : at + size], "big" if is_big else "little")

    def place(at: int) -> int:
        """A pointer: number of a block of 4096 bytes, and the place in it."""
        return number(at, 8) * 4096 + number(at + 8, 4)

    def expect(at: int, tag: bytes) -> None:
        if text[at : at + 4] != tag:
            raise ValueError(f"no {tag.decode()} at byte {at}")

    def chunk(at: int, end: int) -> bytes:
        expect(at, b"DaTa")
        return text[at + 16 : end]

    def load(at: int) -> Any:
        kind = text[at + 96 : at + 128].decode("latin-1").strip()
        if kind not in _TYPES:
            return None
        count = int(text[at + 128 : at + 130], 16)
        sizes = [number(at + 130 + 8 * i, 8) for i in range(count)]
        chunks, first = int(text[at + 226 : at + 230], 16), place(at + 230)
        if chunks == 0:
            return None
        if chunks == 1:
            data = chunk(first, place(first + 4))
        else:
            expect(first, b"DCtb")
            data = b"".join(chunk(place(first + 16 + 24 * i), place(first + 28 + 24 * i)) for i in range(chunks))
        word = np.dtype(_TYPES[kind]).newbyteorder(">" if is_big else "<")
        return np.frombuffer(data[: math.prod(sizes) * word.itemsize], word)

    def node(at: int, depth: int) -> Node:
        expect(at, b"NoDe")
        name, label = (text[at + k : at + k + 32].decode("latin-1").strip() for k in (4, 36))
        made = Node(name, label, [], lambda: load(at))
        count, table = int(text[at + 68 : at + 76], 16), place(at + 84)
        if count and depth < 9:
            expect(table, b"SNTb")
            made.children = [node(place(table + 16 + 44 * i + 32), depth + 1) for i in range(count)]
        return made

    return node(_ROOT, 0)
