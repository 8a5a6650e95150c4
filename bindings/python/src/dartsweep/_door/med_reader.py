"""MED files of Salome and code_aster, of every version since 3, by h5py. Gmsh leaves out polyhedra and polygons of MED and refuses files newer than
its library; meshio does not know these nor half of the quadratic cells. MED numbers volumes the other way round."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import blocks, linear, polyhedra
from .error import MeshError
from .linear import Cells
from .mesh import Indices
from .ragged import groups_by_number
from .raw import Raw

_TYPES = {  # VTK's type, and where its points stand
    **{"PO1": (1, [0]), "SE2": (3, [0, 1]), "SE3": (21, [0, 1, 2]), "SE4": (35, [0, 1, 2, 3])},
    **{"TR3": (5, [0, 1, 2]), "TR6": (22, [*range(6)]), "TR7": (34, [*range(7)]), "QU4": (9, [*range(4)]), "QU8": (23, [*range(8)]), "QU9": (28, [*range(9)])},
    **{"TE4": (10, [0, 2, 1, 3]), "PY5": (14, [0, 3, 2, 1, 4]), "PE6": (13, [0, 2, 1, 3, 5, 4]), "HE8": (12, [0, 3, 2, 1, 4, 7, 6, 5])},
    "T10": (24, [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]),
    "P13": (27, [0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10]),
    "P15": (26, [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13]),
    "P18": (32, [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15]),
    "H20": (25, [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17]),
    "H27": (29, [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17, 21, 23, 24, 22, 20, 25, 26]),
}
_POLYGONS = {"POG": 7, "PG2": 36}
_POLYHEDRA = "POE"
_WAY_ON = "Salome can write it anew"


def read(path: str, source: str, format: str) -> Raw:
    """The cells of a file. Groups are kept by name; several meshes are regions."""
    import h5py

    try:
        with h5py.File(path, "r") as file:
            raws = [(name, _raw_of(file, name, source)) for name in file["ENS_MAA"]]
    except (KeyError, OSError, ValueError, IndexError, RuntimeError) as error:
        if isinstance(error, MeshError):
            raise
        raise MeshError(source, f"it is not as MED is written ({error})", _WAY_ON) from error
    if not raws:
        raise MeshError(source, "it has no mesh", _WAY_ON)
    return blocks.joined(raws) if len(raws) > 1 else raws[0][1]


def _raw_of(file: Any, name: str, source: str) -> Raw:
    mesh = file["ENS_MAA"][name]
    if int(mesh.attrs["TYP"]) != 0:
        raise MeshError(source, f"its mesh '{name}' is a structured grid", _WAY_ON)
    steps = sorted(mesh)
    step = mesh[steps[0]]
    folders = sorted(step["MAI"].items(), key=lambda item: int(item[1].attrs["GEO"])) if "MAI" in step else []
    parts = [_cells_of(kind, folder, source) for kind, folder in folders]
    points = np.reshape(step["NOE/COO"][()], (int(mesh.attrs["ESP"]), -1)).T
    raw = Raw(points, linear.joined(parts), source=source, reader="h5py")
    if len(steps) > 1:
        raw.notes.append(f"of {len(steps)} steps of the mesh '{name}' the first was taken")
    families = [folder["FAM"][()] if "FAM" in folder else np.zeros(len(part.types), np.int64) for (_, folder), part in zip(folders, parts)]
    _add_groups(raw, np.concatenate([np.empty(0, np.int64), *families]), file[f"FAS/{name}"] if f"FAS/{name}" in file else {})
    return raw


def _cells_of(kind: str, folder: Any, source: str) -> Cells:
    flat = folder["NOD"][()].astype(np.int64) - 1
    if kind in _TYPES:
        number, order = _TYPES[kind]
        return linear.uniform(number, flat.reshape(len(order), -1).T[:, order])
    if kind in _POLYGONS:
        offsets = _offsets(folder["INN"])
        return Cells(np.full(len(offsets) - 1, _POLYGONS[kind], np.uint8), offsets, flat)
    if kind == _POLYHEDRA:
        return polyhedra.cells_of_faces(np.diff(_offsets(folder["IFN"])), np.diff(_offsets(folder["INN"])), flat)
    raise MeshError(source, f"it has cells of the type '{kind}'", "its cells have to be divided into linear ones first")


def _offsets(index: Any) -> Indices:
    made: Indices = index[()].astype(np.int64) - 1
    return made


def _add_groups(raw: Raw, families: Indices, folders: Any) -> None:
    """Each cell is in one family, which names its groups."""
    members: dict[str, list[Indices]] = {}
    cells = groups_by_number(families)
    for family in folders["ELEME"].values() if "ELEME" in folders else ():
        own = cells.get(int(family.attrs["NUM"]), np.empty(0, np.int64))
        for title in family["GRO/NOM"][()] if len(own) and "GRO" in family else ():
            members.setdefault(_text(title), []).append(own)
    for name, found in members.items():
        raw.groups[name] = np.sort(np.concatenate(found))


def _text(title: Any) -> str:
    data: bytes = np.asarray(title, np.int8).tobytes()
    return data.partition(b"\0")[0].decode("utf-8", "replace").strip()
