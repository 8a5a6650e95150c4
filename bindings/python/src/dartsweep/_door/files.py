"""A Mesh of a file of any kind that the table knows."""

from __future__ import annotations

import bz2
import contextlib
import difflib
import gzip
import importlib
import lzma
import os
import shutil
import tempfile
import zlib
from collections.abc import Iterator
from typing import Any

from .error import CutShort, MeshError
from . import abaqus_reader, ansys_reader, apart, elmer_reader, exodus_reader, febio_reader, gambit_reader, gid_reader, gmsh_reader, kratos_reader, lsdyna_reader, med_reader
from . import meshio_reader, mfem_reader, moab_reader, netgen_reader, off_reader, su2_reader, ucd_reader, unv_reader, vtk_files
from .mesh import Mesh
from .raw import Raw, mesh_of
from .table import DIALECTS, LIBRARIES, Dialect, Reader, dialects_of, endings, stranger

_READERS: dict[str, Any] = {
    **{"vtk": vtk_files, "meshio": meshio_reader, "gmsh": gmsh_reader, "mfem": mfem_reader, "moab": moab_reader, "abaqus": abaqus_reader, "exodus": exodus_reader},
    **{"gambit": gambit_reader, "med": med_reader, "kratos": kratos_reader, "netgen": netgen_reader, "off": off_reader, "su2": su2_reader, "ucd": ucd_reader, "unv": unv_reader},
    **{"ansys": ansys_reader, "lsdyna": lsdyna_reader, "elmer": elmer_reader, "febio": febio_reader, "gid": gid_reader},
}  # by the keys of LIBRARIES
_ELMER = "mesh.header"
_COMPRESSED: dict[str, Any] = {".gz": gzip.open, ".bz2": bz2.open, ".xz": lzma.open}


def read(path: str | os.PathLike[str], quadratic: str = "corners") -> Mesh:
    """The cells of a file and all that it says about them; quadratic: "corners" or "split"."""
    name = os.fspath(path)
    source = f"mesh '{name}'"
    if quadratic not in ("corners", "split"):
        raise ValueError(f'quadratic is "corners" or "split", not {quadratic!r}')
    if os.path.isdir(name) and os.path.isdir(os.path.join(name, "constant", "polyMesh")):
        with _foam_file(name) as known:
            return _of_dialects(known, source, [dialect for dialect in DIALECTS if ".foam" in dialect.endings], quadratic)
    if os.path.isfile(os.path.join(name, _ELMER)):
        name = os.path.join(name, _ELMER)
    with open(name, "rb"):  # an OSError names the path
        pass
    with _plain(name, source) as known:
        return _of_dialects(known, source, dialects_of(known), quadratic)


@contextlib.contextmanager
def _plain(name: str, source: str) -> Iterator[str]:
    """A file that is not compressed."""
    stem, ending = os.path.splitext(name)
    if ending.lower() not in _COMPRESSED:
        yield name
        return
    with tempfile.TemporaryDirectory() as folder:
        plain = os.path.join(folder, os.path.basename(stem))
        try:
            with _COMPRESSED[ending.lower()](name, "rb") as packed, open(plain, "wb") as file:
                shutil.copyfileobj(packed, file)
        except (OSError, EOFError, lzma.LZMAError, zlib.error) as error:
            raise MeshError(source, f"it can't be unpacked ({error})", "the file is damaged") from error
        yield plain


@contextlib.contextmanager
def _foam_file(case: str) -> Iterator[str]:
    """The name that VTK's reader wants beside the case; it needs no file of that name."""
    yield os.path.join(case, "case.foam")


def _of_dialects(path: str, source: str, dialects: list[Dialect], quadratic: str) -> Mesh:
    ways = [(dialect, reader) for dialect in dialects for reader in dialect.readers]
    if not ways:
        raise MeshError(source, *_unknown(path))
    installed = [(dialect, reader) for dialect, reader in ways if _is_installed(reader)]
    if not installed:
        raise MeshError(source, f"{ways[0][0].name} needs {LIBRARIES[ways[0][1].library][2]}, which is not installed", _extra(ways[0][1]))
    failed: list[MeshError] = []
    for dialect, reader in installed:
        try:
            raw = _raw(path, source, reader, quadratic)
        except CutShort:  # others would read what there is
            raise
        except MeshError as error:
            failed.append(error)
            continue
        except Exception as error:  # of many kinds, about a file that is not what a reader expects
            reason = f"{type(error).__name__} {error}".strip()
            failed.append(MeshError(source, f"{LIBRARIES[reader.library][2]} can't read it ({reason})", "the file may be damaged"))
            failed[-1].__cause__ = error
            continue
        mesh = mesh_of(raw, quadratic)
        if (dialect, reader) != ways[0]:
            mesh.notes += _why_not_first(ways, installed, failed, reader)
        return mesh
    missing = [reader for _, reader in ways if not _is_installed(reader)]
    if len(failed) == 1 and not missing:
        raise failed[0]
    way_on = f"{_extra(missing[0])}, or {failed[0].way_on}" if missing else failed[0].way_on
    raise MeshError(source, "; ".join(error.found for error in failed), way_on) from failed[0]


def _why_not_first(ways: Any, installed: Any, failed: list[MeshError], reader: Reader) -> list[str]:
    first = ways[0][1]
    if failed:
        return [f"{LIBRARIES[reader.library][2]} read it, after: {failed[0].found}"]
    return [f"{LIBRARIES[reader.library][2]} read it; {LIBRARIES[first.library][2]} loses less: {_extra(first)}"]


def _raw(path: str, source: str, reader: Reader, quadratic: str) -> Raw:
    if reader.library not in _READERS:
        raise MeshError(source, "it is a surface", "dartsweep.from_surface fills it with tetrahedra")
    module, more = _READERS[reader.library], (quadratic,) if reader.library == "mfem" else ()
    raw: Raw
    if _is_apart(path, reader):
        raw = apart.read(LIBRARIES[reader.library][2], module.__name__, path, source, reader.format, *more)
    else:
        raw = module.read(path, source, reader.format, *more)
    return raw


def _is_apart(path: str, reader: Reader) -> bool:
    """Whether a library may crash on a file, or not come to an end."""
    if reader.library == "gmsh":
        return gmsh_reader.is_apart(path, reader.format)
    if reader.library == "vtk":
        return reader.format not in ("legacy", "xml", "hdf", "pvd")
    return reader.library in ("meshio", "mfem")


def _is_installed(reader: Reader) -> bool:
    try:
        importlib.import_module(LIBRARIES[reader.library][0])
    except (ImportError, OSError):  # a library of the system is missing
        return False
    return True


def _extra(reader: Reader) -> str:
    return f"pip install dartsweep[{LIBRARIES[reader.library][1]}]"


def _unknown(path: str) -> tuple[str, str]:
    ending = os.path.splitext(path)[1].lower()
    known = stranger(path)
    if known is not None:
        return known
    if ending in endings():
        names = ", ".join(dialect.name for dialect in DIALECTS if ending in dialect.endings)
        return f"its first bytes are not those of {names}", "a program that reads the file can write it anew"
    near = difflib.get_close_matches(ending, endings(), 1)
    found = f"the ending '{ending}' is not known" + (f" ('{near[0]}' is)" if near else "")
    return found, f"files that end in {' '.join(endings())} are read"
