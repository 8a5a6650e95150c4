"""AVS UCD files as text (.inp, .ucd, .avs): VTK's reader rounds their points to single precision, and has those in binary."""

from __future__ import annotations

import numpy as np

from . import linear
from .error import CutShort, MeshError
from .ragged import offsets_of
from .raw import Raw

_TYPES = {"pt": 1, "line": 3, "tri": 5, "quad": 9, "tet": 10, "pyr": 14, "prism": 13, "hex": 12}
_ORDER = {13: [3, 4, 5, 0, 1, 2], 14: [1, 2, 3, 4, 0]}  # AVS looks from above: the upper triangle and the apex come first
_WAY_ON = "ParaView may read it and write it anew"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Materials are regions; where cells of the boundary have materials, these are its surfaces."""
    with open(path, encoding="latin-1") as file:
        if file.read(1) == "\x07":
            raise MeshError(source, "it is in binary", "VTK reads it")
    with open(path, encoding="latin-1") as file:
        lines = [line for line in (line.strip() for line in file) if line and not line.startswith("#")]
    try:
        return _raw_of(lines, source)
    except (ValueError, IndexError, KeyError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as AVS writes it ({error})", _WAY_ON) from error


def _raw_of(lines: list[str], source: str) -> Raw:
    node_count, cell_count = (int(word) for word in lines[0].split()[:2])
    if len(lines) < 1 + node_count + cell_count:
        raise CutShort(source, f"it ends after {len(lines) - 1} of {node_count + cell_count} points and cells", _WAY_ON)
    nodes = [line.split() for line in lines[1 : 1 + node_count]]
    index = {node[0]: i for i, node in enumerate(nodes)}
    rows, kinds, materials = [], [], []
    for line in lines[1 + node_count : 1 + node_count + cell_count]:
        words = line.split()
        title = [word.isalpha() for word in words].index(True)
        kind = _TYPES.get(words[title].lower(), 0)
        if kind == 0:
            raise MeshError(source, f"cells have the type '{words[title]}'", _WAY_ON)
        corners = np.array([index[word] for word in words[title + 1 :]], np.int64)
        rows.append(corners[_ORDER[kind]] if kind in _ORDER else corners)
        kinds.append(kind)
        materials.append(int(words[1]))
    cells = linear.Cells(np.array(kinds, np.uint8), offsets_of([len(row) for row in rows]), np.concatenate([np.empty(0, np.int64), *rows]))
    raw = Raw(np.array([node[1:4] for node in nodes], np.float64), cells, source=source, reader="NumPy")
    raw.regions = np.array(materials, np.int64)
    raw.data["material"] = raw.regions
    return raw
