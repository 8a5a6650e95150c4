"""Zones of faces in files of Fluent (.msh, .cas). VTK gives the cells beside them in their place, so their faces are read here."""

from __future__ import annotations

import mmap
import os
import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .error import MeshError
from .mesh import Indices
from .ragged import offsets_of, positions

_NAME = re.compile(rb"\(\s*(?:39|45)\s*\(\s*(\d+)\s+([^\s()]+)\s+([^\s()]+)")
_FACES = re.compile(rb"\(\s*(20|30)?13\s*\(\s*([0-9a-fA-F]+(?:\s+[0-9a-fA-F]+){3,4})\s*\)\s*\(")
_MACHINE = re.compile(rb"\(\s*4\s*\(\s*(\d+)")
_INTERIOR, _MIXED, _POLYGONS = 2, 0, 5
_LITTLE_ENDIAN = 60
_WAY_ON = "a program that reads the file can write it anew"


def has_faces(path: str) -> bool:
    """Whether a file gives its cells by their faces, as Fluent's own files do."""
    if os.path.getsize(path) == 0:
        return False
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        return _FACES.search(text) is not None


def sides_of(path: str, source: str) -> list[tuple[str, Indices, Indices]]:
    """The zones of faces but those within the mesh: name, offsets and points of each, where points count from 0."""
    if os.path.getsize(path) == 0:
        return []
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        names = {int(number): name.decode(errors="replace") for number, _, name in _NAME.findall(text)}
        machine = _MACHINE.search(text)
        integer = ">i4" if machine is not None and int(machine[1]) != _LITTLE_ENDIAN else "<i4"
        found = []
        for section in _FACES.finditer(text):
            zone, first, last, kind, *shape = (int(number, 16) for number in section[2].split())
            if kind == _INTERIOR or zone == 0:
                continue
            count, width = last - first + 1, shape[0] if shape else _MIXED
            try:
                offsets, points = _faces_in(_numbers(text, section, integer), count, 0 if width == _POLYGONS else width)
            except (ValueError, IndexError) as error:
                raise MeshError(source, f"the faces of zone {zone} end early or are no numbers", _WAY_ON) from error
            found.append((names.get(zone, str(zone)), offsets, points))
    return found


def _numbers(text: mmap.mmap, section: re.Match[bytes], integer: str) -> NDArray[Any]:
    """The numbers of a section: as hexadecimal text, or as integers of 4 bytes up to the words that end a binary section."""
    if section[1] is None:
        return np.array([int(word, 16) for word in text[section.end() : text.find(b")", section.end())].split()], np.int64)
    end = text.find(b"End of Binary Section", section.end())
    size = (len(text) if end < 0 else text.rfind(b")", section.end(), end)) - section.end()
    return np.frombuffer(text[section.end() : section.end() + max(size // 4, 0) * 4], integer).astype(np.int64)


def _faces_in(numbers: NDArray[Any], count: int, width: int) -> tuple[Indices, Indices]:
    """Offsets and points of faces. Each has its points and the cells on both sides, and before them how many points if zones are mixed."""
    if width != _MIXED:
        rows = numbers[: count * (width + 2)].reshape(count, width + 2)
        return np.arange(count + 1) * width, np.ravel(rows[:, :width]) - 1
    starts, sizes, at = np.empty(count, np.int64), np.empty(count, np.int64), 0
    for i in range(count):
        starts[i], sizes[i] = at + 1, numbers[at]
        at += int(numbers[at]) + 3
    if at > len(numbers):
        raise IndexError
    return offsets_of(sizes), numbers[positions(starts, sizes)] - 1
