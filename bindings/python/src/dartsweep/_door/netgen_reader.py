"""Netgen's .vol files, of every version. Netgen numbers volumes the other way round."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from . import linear
from .error import MeshError
from .ragged import groups_by_number
from .raw import Raw

_VOLUMES = {  # by the number of points: VTK's type, and the order of ours
    4: (10, [0, 2, 1, 3]),
    5: (14, [0, 3, 2, 1, 4]),
    6: (13, [0, 2, 1, 3, 5, 4]),
    8: (12, [0, 3, 2, 1, 4, 7, 6, 5]),
    10: (24, [0, 2, 1, 3, 5, 7, 4, 6, 9, 8]),
}
_SURFACES = {3: (5, [0, 1, 2]), 4: (9, [0, 1, 2, 3]), 6: (22, [0, 1, 2, 5, 3, 4])}
_WAY_ON = "Netgen can write it for Gmsh or Abaqus"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Materials are regions, boundary conditions are groups of faces, both with their names."""
    with open(path, encoding="latin-1") as file:
        lines = [line for line in (line.strip() for line in file) if line and not line.startswith("#")]
    parts, labels = [], []
    try:
        points = np.array([line.split() for line in _section(lines, "points")], np.float64).reshape(-1, 3)
        for name, first, label, known in (
            ("volumeelements", 2, 0, _VOLUMES),
            ("surfaceelements(?:gi|uv)?", 5, 1, _SURFACES),
        ):
            for width, rows in _by_width(_section(lines, name), first - 1).items():
                if width not in known:
                    raise MeshError(source, f"{len(rows)} cells have {width} points", _WAY_ON)
                kind, order = known[width]
                parts.append(linear.uniform(kind, rows[:, first + np.array(order)] - 1))
                labels.append(rows[:, label])
    except (ValueError, IndexError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as Netgen writes it ({error})", _WAY_ON) from error
    raw = Raw(points, linear.joined(parts), source=source, reader="NumPy")
    raw.regions = np.concatenate([np.empty(0, np.int64), *labels])
    _add_names(raw, _names(_section(lines, "materials")), _names(_section(lines, "bcnames")))
    return raw


def _section(lines: list[str], name: str) -> list[str]:
    """The lines under a word and their count."""
    at = next((i for i, line in enumerate(lines) if re.fullmatch(name, line)), None)
    return [] if at is None else lines[at + 2 : at + 2 + int(lines[at + 1])]


def _by_width(lines: list[str], place: int) -> dict[int, Any]:
    """Rows of integers by their number of points, which is the integer at a place."""
    rows: dict[int, list[list[str]]] = {}
    for line in lines:
        words = line.split()
        width = int(words[place])
        rows.setdefault(width, []).append(words[: place + 1 + width])
    return {width: np.array(own).astype(np.int64) for width, own in rows.items()}


def _names(lines: list[str]) -> dict[int, str]:
    pairs = [line.split(None, 1) for line in lines]
    return {int(pair[0]): pair[1] for pair in pairs if len(pair) == 2}


def _add_names(raw: Raw, materials: dict[int, str], conditions: dict[int, str]) -> None:
    is_volume = linear.DIMENSION[raw.cells.types] == 3
    raw.region_names = {name: number for number, name in materials.items()}
    rows = np.flatnonzero(~is_volume)
    for number, members in groups_by_number(raw.regions[rows]).items():
        name = conditions.get(number, str(number))
        own = rows[members]
        raw.groups[name] = np.concatenate([raw.groups[name], own]) if name in raw.groups else own
        raw.numbers.setdefault(name, number)
