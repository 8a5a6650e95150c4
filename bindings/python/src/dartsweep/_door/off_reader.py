"""Geomview's .off files as text, with polygons of any number of corners, and with colours, normals or texture coordinates."""

from __future__ import annotations

import re

import numpy as np

from .error import MeshError
from .linear import Cells
from .ragged import offsets_of
from .raw import Raw

_HEAD = re.compile(r"(ST)?(C)?(N)?OFF\b", re.IGNORECASE)
_TYPES = {3: 5, 4: 9}  # by the number of corners: VTK's type; polygons else
_WAY_ON = "a program that reads the file, such as MeshLab, can write it as PLY"


def read(path: str, source: str, format: str) -> Raw:
    """The faces of a file."""
    with open(path, encoding="latin-1") as file:
        lines = [line for line in (line.partition("#")[0].strip() for line in file) if line]
    try:
        return _raw_of(lines, source)
    except (ValueError, IndexError) as error:
        raise MeshError(source, f"it is not as OFF is written ({error})", _WAY_ON) from error


def _raw_of(lines: list[str], source: str) -> Raw:
    head = _HEAD.match(lines[0])
    if head is not None:
        lines = [rest for rest in [lines[0][head.end() :].strip()] if rest] + lines[1:]
    vertex_count, face_count = (int(word) for word in lines[0].split()[:2])
    points = np.array([line.split()[:3] for line in lines[1 : 1 + vertex_count]], np.float64)
    rows = [line.split() for line in lines[1 + vertex_count : 1 + vertex_count + face_count]]
    if len(rows) < face_count:
        raise ValueError(f"it has {len(rows)} of {face_count} faces")
    faces = [np.array(row[1 : 1 + int(row[0])], np.int64) for row in rows if int(row[0]) > 2]
    types = np.array([_TYPES.get(len(face), 7) for face in faces], np.uint8)
    cells = Cells(types, offsets_of([len(face) for face in faces]), np.concatenate([np.empty(0, np.int64), *faces]))
    return Raw(points, cells, source=source, reader="NumPy")
