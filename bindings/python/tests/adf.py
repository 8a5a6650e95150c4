"""CGNS files in ADF, which older programs write: a tree of HDF5 is written anew, with pointers in hexadecimal digits or as integers."""

from __future__ import annotations

import pathlib
from typing import Any

import numpy as np

_TYPES = {"i4": "I4", "i8": "I8", "f4": "R4", "f8": "R8", "i1": "C1", "u1": "C1"}


def write(group: Any, path: pathlib.Path, is_hexadecimal: bool) -> None:
    """Writes the tree below a group of h5py."""
    out = bytearray(266)
    version = b"A02011" if is_hexadecimal else b"B02012"
    out[0:32] = b"\xc0\xa8\xa3\xa9ADF Database Version " + version + b">"

    def number(value: int, size: int) -> bytes:
        return f"{value:0{size}X}".encode() if is_hexadecimal else value.to_bytes(size, "little")

    def pointer(at: int) -> bytes:
        return number(at // 4096, 8) + number(at % 4096, 4)

    def chunk(at: int, data: bytes) -> bytes:
        return b"DaTa" + pointer(at + 16 + len(data)) + data + b"dEnD"

    def text(word: str) -> bytes:
        return word.encode().ljust(32)

    def data_of(node: Any) -> Any:
        return np.asarray(node[" data"][()]) if " data" in node else None

    def put(name: str, label: str, node: Any, split: bool) -> int:
        """Appends a node, then its data and children; gives where it is."""
        at = len(out)
        out.extend(bytes(246))
        data = data_of(node)
        kind, sizes, chunks, first = "MT", [], 0, 0
        if data is not None:
            kind = _TYPES[data.dtype.str[1:]]
            sizes, raw = list(reversed(data.shape)), data.astype(data.dtype.newbyteorder("<")).tobytes()
            parts = [raw[: len(raw) // 2 // 8 * 8], raw[len(raw) // 2 // 8 * 8 :]] if split and len(raw) >= 16 else [raw]
            places = []
            for part in parts:
                places.append((len(out), len(out) + 16 + len(part)))
                out.extend(chunk(len(out), part))
            chunks, first = len(parts), places[0][0]
            if chunks > 1:
                first = len(out)
                rows = b"".join(pointer(start) + pointer(end) for start, end in places)
                out.extend(b"DCtb" + pointer(first + 16 + len(rows)) + rows + b"dcTE")
        children = [(key, child) for key, child in node.items() if not key.startswith(" ")]
        table = len(out) if children else 0
        if children:
            out.extend(b"SNTb" + pointer(table + 16 + 44 * len(children)) + bytes(44 * len(children)) + b"snTE")
        places_of = [put(key, child.attrs["label"].decode(), child, split) for key, child in children]
        for i, ((key, _), place) in enumerate(zip(children, places_of)):
            out[table + 16 + 44 * i : table + 60 + 44 * i] = text(key) + pointer(place)
        dimensions = b"".join(number(size, 8) for size in sizes + [0] * (12 - len(sizes)))
        counts = f"{len(children):08X}{len(children):08X}".encode()
        head = b"NoDe" + text(name) + text(label) + counts + pointer(table) + text(kind) + f"{len(sizes):02X}".encode() + dimensions
        out[at : at + 246] = head + f"{chunks:04X}".encode() + pointer(first) + b"TaiL"
        return at

    put("ADF MotherNode", "Root Node of ADF File", group, True)
    head = b"AdF0" + b" " * 28 + b"AdF1" + b" " * 28 + b"AdF2LBAdF3" + b"010204080408080808080808AdF4"
    head += pointer(266) + pointer(len(out)) + pointer(186) + pointer(0) + b"AdF5"
    out[32 : 32 + len(head)] = head[: 186 - 32]
    path.write_bytes(out)
