"""MED files as Salome writes them: every type of cell, groups, polyhedra, newer versions than Gmsh's library knows."""

from __future__ import annotations

import pathlib
import sys
from typing import Any

import numpy as np
import pytest

import dartsweep as ds
from test_quadratic import cell, curved, made
from volumes import CUBE, TETRA, volume_of

h5py = pytest.importorskip("h5py")

Folders = dict[str, dict[str, Any]]
KINDS = {  # type of MED, its number, and which of our nodes stands where
    "tetra10": ("T10", 310, [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]),
    "hexahedron20": ("H20", 320, [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17]),
    "hexahedron27": ("H27", 327, [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17, 24, 20, 23, 21, 22, 25, 26]),
    "wedge15": ("P15", 315, [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13]),
    "wedge18": ("P18", 318, [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15]),
    "pyramid13": ("P13", 313, [0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10]),
}


def write(path: pathlib.Path, points: Any, folders: Folders, families: dict[int, list[str]], kind: int = 0) -> None:
    """A mesh of folders of cells, whose arrays are given as they stand in the file; families name groups."""
    with h5py.File(path, "w") as file:
        file.create_group("INFOS_GENERALES").attrs.update({"MAJ": 4, "MIN": 2, "REL": 0})
        mesh = file.create_group("ENS_MAA/part")
        mesh.attrs.update({"TYP": kind, "ESP": np.shape(points)[1], "DIM": 3})
        step = mesh.create_group("-0000000000000000001-0000000000000000001")
        step["NOE/COO"] = np.ravel(np.transpose(points))
        for name, arrays in folders.items():
            folder = step.create_group(f"MAI/{name}")
            for title, values in arrays.items():
                if title == "GEO":
                    folder.attrs["GEO"] = values
                else:
                    folder[title] = np.asarray(values, np.int64)
        for number, titles in families.items():
            family = file.create_group(f"FAS/part/ELEME/FAM_{number}")
            family.attrs["NUM"] = number
            family["GRO/NOM"] = np.array([np.frombuffer(title.encode().ljust(80, b"\0"), np.int8) for title in titles])


def columns(rows: Any) -> Any:
    """Nodes as MED has them: the first ones of all cells, then the second ones."""
    return np.ravel(np.transpose(rows)) + 1


@pytest.mark.parametrize("kind", KINDS)
def test_quadratic_cells_of_med(kind: str, tmp_path: pathlib.Path) -> None:
    name, number, order = KINDS[kind]
    write(tmp_path / "one.med", curved(kind), {name: {"GEO": number, "NOD": columns([order])}}, {})
    for quadratic in ("corners", "split"):
        with ds.read(tmp_path / "one.med", quadratic=quadratic) as environment, made(kind, curved(kind), quadratic) as expected:
            assert volume_of(environment) == pytest.approx(volume_of(expected), rel=1e-12)
    assert len(order) == len(cell(kind))


def test_polyhedra_and_groups_of_med(tmp_path: pathlib.Path) -> None:
    """A cube as a polyhedron, a wedge beside it and a tetrahedron on that; two groups share a cell."""
    points = np.array([*CUBE, (2, 0, 0), (2, 0, 1), (1, 0, 2)])
    sides = [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [0, 3, 2, 1], [4, 5, 6, 7]]
    folders = {
        "POE": {"GEO": 500, "IFN": [1, 7], "INN": np.arange(1, 26, 4), "NOD": np.ravel(sides) + 1, "FAM": [-2]},
        "PE6": {"GEO": 306, "NOD": columns([[1, 2, 8, 5, 6, 9]]), "FAM": [-1]},
        "TE4": {"GEO": 304, "NOD": columns([[5, 6, 9, 10]])},
        "POG": {"GEO": 400, "INN": [1, 5], "NOD": np.array(sides[3]) + 1, "FAM": [-3]},
    }
    write(tmp_path / "parts.med", points, folders, {-1: ["tissue", "both"], -2: ["lumen", "both"], -3: ["inlet"]})
    with ds.read(tmp_path / "parts.med") as environment:
        assert environment.info.volume_count == 3 and environment.info.part_count == 1 and environment.notes == ()
        assert volume_of(environment) == pytest.approx(1 + 0.5 + 1 / 6)
        types = [environment.volume_counts(environment.volume_id(i)).type for i in range(3)]
        assert types == [ds.CellType.TETRA, ds.CellType.WEDGE, ds.CellType.POLYHEDRON]
        assert [environment.mark_region(name, mark=False)[0] for name in ("tissue", "lumen", "both")] == [1, 1, 2] and len(environment.faces("inlet")) == 1


def test_what_gmsh_would_leave_out_of_med_is_told(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("gmsh", exc_type=ImportError)
    from dartsweep._door import gmsh_reader

    write(tmp_path / "one.med", CUBE, {"POE": {"GEO": 500, "IFN": [1, 2], "INN": [1, 5], "NOD": [1, 2, 3, 4]}}, {})
    with pytest.raises(ds.MeshError, match="polyhedra or polygons, which Gmsh leaves out"):
        gmsh_reader.read(str(tmp_path / "one.med"), "the file", "med")


def test_polyhedra_of_med_without_h5py_name_the_extra(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("gmsh", exc_type=ImportError)
    write(tmp_path / "one.med", CUBE, {"POE": {"GEO": 500, "IFN": [1, 2], "INN": [1, 5], "NOD": [1, 2, 3, 4]}}, {})
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(ds.MeshError, match=r"which Gmsh leaves out.*; pip install dartsweep\[med\], or its cells"):
        ds.read(tmp_path / "one.med")


def test_grids_and_strange_cells_of_med_are_told(tmp_path: pathlib.Path) -> None:
    cells = {"TE4": {"GEO": 304, "NOD": columns([[0, 2, 1, 3]])}}
    for kind, folders, found in ((1, cells, "is a structured grid"), (0, {**cells, "O12": {"GEO": 312, "NOD": np.arange(1, 13)}}, "cells of the type 'O12'")):
        write(tmp_path / "one.med", TETRA, folders, {}, kind)
        with pytest.raises(ds.MeshError, match=found):
            ds.read(tmp_path / "one.med")
