"""Points that files give in coordinate systems of their own, and rows that stand elsewhere: each reader has them as global numbers, or loses them."""

from __future__ import annotations

import pathlib

import numpy as np
import pytest

import dartsweep as ds
from dartsweep._door import nastran_systems
from volumes import TETRA, volume_of

CYLINDER = """BEGIN BULK
GRDSET,,4
CORD2R,3,,10.,0.,0.,10.,0.,1.
,10.,1.,0.
CORD2C  4       3       0.      0.      0.      0.      0.      1.      +C1
+C1     1.      0.      0.
CORD2S* 5                                             0.              0.
*                     0.              0.              0.              1.
*                     1.              0.              0.
CORD1R,6,1,4,2
GRID,1,,0.,0.,0.
GRID,2,4,1.,0.,0.    $ a remark
GRID*   3               4               1.0+0           9.+1
*       0.
GRID           4              0.      0.     1.0
GRID,11,5,0.,0.,0.
GRID,12,5,1.,90.,0.
GRID,13,5,1.,90.,90.
GRID,14,5,1.,0.,0.
GRID,24,6,0.,0.,2.
CTETRA,1,1,1,2,3,4
CTETRA,2,1,11,12,13,14
CTETRA,3,1,2,3,4,24
ENDDATA
"""


def test_points_of_nastran_are_where_their_systems_are(tmp_path: pathlib.Path) -> None:
    """Cylindrical ones in a rectangular system, spherical ones, and some in a system that points give."""
    pytest.importorskip("gmsh", exc_type=ImportError)
    (tmp_path / "systems.bdf").write_text(CYLINDER)
    with ds.read(tmp_path / "systems.bdf") as environment:
        points = environment.points()
        assert np.allclose(points[:4], [(10, 0, 0), (10, 1, 0), (9, 0, 0), (10, 0, 1)], atol=1e-12)
        assert np.allclose(points[4:8], TETRA, atol=1e-12) and np.allclose(points[8], (10, 0, 2), atol=1e-12)
        assert volume_of(environment) == pytest.approx(1 / 6 + 1 / 6 + 1 / 6)


def test_rows_of_nastran_that_begin_with_a_tab_go_on(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("gmsh", exc_type=ImportError)
    card = "CORD2C\t4\t3\t0.\t0.\t0.\t0.\t0.\t1.\n\t1.\t0.\t0.\n"
    first, last = CYLINDER.index("CORD2C"), CYLINDER.index("CORD2S")
    (tmp_path / "systems.bdf").write_text(CYLINDER[:first] + card + CYLINDER[last:])
    with ds.read(tmp_path / "systems.bdf") as environment:
        assert np.allclose(environment.points()[:4], [(10, 0, 0), (10, 1, 0), (9, 0, 0), (10, 0, 1)], atol=1e-12)


LOST = {
    "by each other": ("CORD2C,4,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.", "system 5 is not there"),
    "of another kind": ("CORD3G,4,1,2,3", "a system CORD3G"),
    "without the row that goes on": ("CORD2R,4,,0.,0.,0.,0.,0.,1.", "CORD2R of coordinate system 4 does not have three points"),
    "of two points": ("CORD1R,4,1,2", "CORD1R of coordinate system 4 does not have three points"),
    "of a point that is not there": ("CORD1R,4,7,8,9\nGRID,7,,0.,0.,0.\nGRID,8,,0.,0.,1.", "names point 9, which is not there"),
    "on a line": ("CORD2R,4,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.", "system 4 are on a line"),
    "of no numbers": ("CORD2R,4,,0.,0.,0.,0.,0.,1.\n,x,0.,0.", "or are not numbers"),
    "in another file": ("", "system 4 is not there"),
}


@pytest.mark.parametrize("kind", LOST)
def test_systems_of_nastran_that_lead_nowhere_are_told(kind: str, tmp_path: pathlib.Path) -> None:
    pytest.importorskip("gmsh", exc_type=ImportError)
    card, reason = LOST[kind]
    rows = "".join(f"GRID,{i},4,{x}.,{y}.,{z}.\n" for i, (x, y, z) in enumerate(TETRA.astype(int).tolist(), 1))
    (tmp_path / "lost.bdf").write_text(f"BEGIN BULK\n{card}\n{rows}CTETRA,1,1,1,2,3,4\nENDDATA\n")
    with pytest.raises(ds.MeshError, match=reason):
        ds.read(tmp_path / "lost.bdf")


ROWS = ["GRDSET,,4\nGRID,4,,0.,0.,1.\n", "GRID           4       4      0.      0.      1.\n", "grid    4              4 0.      0.      1.\n"]
ROWS += ["GRID*   4               4               0.              0.\n*       1.\n", "GRID\t4\t4\t0.\t0.\t1.\n"]


@pytest.mark.parametrize("row", ROWS)
def test_points_of_nastran_whose_system_is_in_another_file_are_told(row: str, tmp_path: pathlib.Path) -> None:
    """In all ways to write a card, some of which Gmsh refuses itself; 0 is the global system."""
    (tmp_path / "lost.bdf").write_text(f"BEGIN BULK\nGRID,1,0,0.,0.,0.\nGRID    2       0       1.      0.      0.\nGRID,3,,0.,1.,0.\n{row}ENDDATA\n")
    with pytest.raises(ds.MeshError, match="system 4 is not there"):
        nastran_systems.placed(str(tmp_path / "lost.bdf"), "the file", np.arange(1, 5), TETRA.astype(np.float64))


def test_other_cards_of_nastran_are_no_points(tmp_path: pathlib.Path) -> None:
    (tmp_path / "other.bdf").write_text("GRIDB,1,4,0.\nGRIDS,2,4,0.\nGRID,3,0,0.,0.,0.\nGRID           4       0 1.     1.      1.\n")
    assert not nastran_systems.has_any(str(tmp_path / "other.bdf"), "the file")
    (tmp_path / "other.bdf").write_text("GRIDB,1,4,0.\nCORD2R,4,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nGRID,3,0,0.,0.,0.\n")
    assert not nastran_systems.has_any(str(tmp_path / "other.bdf"), "the file")


ABAQUS = """*NODE, SYSTEM=C
1, 0, 0, 0
2, 1, 0, 0
3, 1, 90, 0
4, 0, 0, 1
*SYSTEM
10, 0, 0, 10, 1, 0
9, 0, 0
*NODE, INPUT=more.txt
*SYSTEM
*NODE
9, 0, 0, -1
*ELEMENT, TYPE=C3D4, INPUT=cells.txt
"""


def test_points_of_abaqus_are_where_their_systems_are(tmp_path: pathlib.Path) -> None:
    (tmp_path / "systems.inp").write_text(ABAQUS)
    (tmp_path / "more.txt").write_text("** a remark\n" + "".join(f"{i}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(TETRA.tolist(), 5)))
    (tmp_path / "cells.txt").write_text("1, 1, 2, 3, 4\n2, 5, 6, 7, 8\n3, 1, 3, 2, 9\n")
    with ds.read(tmp_path / "systems.inp") as environment:
        assert np.allclose(environment.points(), [*TETRA, (10, 0, 0), (10, 1, 0), (9, 0, 0), (10, 0, 1), (0, 0, -1)], atol=1e-12)
        assert environment.info.volume_count == 3 and volume_of(environment) == pytest.approx(0.5)


@pytest.mark.parametrize(("rows", "reason"), [("*ELGEN\n1, 2, 4, 1\n", r"elements by \*ELGEN"), ("*NODE, SYSTEM=S\n9, 1, 0, 0\n", "system 'S'")])
def test_what_abaqus_makes_of_rows_is_told(rows: str, reason: str, tmp_path: pathlib.Path) -> None:
    nodes = "".join(f"{i}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate([*TETRA, *(TETRA + (2, 0, 0))], 1))
    (tmp_path / "made.inp").write_text(f"*NODE\n{nodes}*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n{rows}")
    with pytest.raises(ds.MeshError, match=reason):
        ds.read(tmp_path / "made.inp")


def test_rows_of_included_files_go_on_with_the_keyword_before(tmp_path: pathlib.Path) -> None:
    nodes = [f"{i}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate([*TETRA, *(TETRA + (2, 0, 0))], 1)]
    (tmp_path / "nodes.txt").write_text("** a remark\n" + "".join(nodes[3:]))
    (tmp_path / "cells.txt").write_text("2, 5, 6, 7, 8\n*ELSET, ELSET=second\n2\n")
    start = f"*NODE\n{''.join(nodes[:3])}*INCLUDE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n*INCLUDE, INPUT=cells.txt\n"
    (tmp_path / "main.inp").write_text(start)
    with ds.read(tmp_path / "main.inp") as environment:
        assert environment.info.volume_count == 2 and volume_of(environment) == pytest.approx(1 / 3)
        assert environment.mark_region("second", mark=False)[0] == 1


def test_a_file_of_abaqus_that_includes_itself_is_told(tmp_path: pathlib.Path) -> None:
    (tmp_path / "main.inp").write_text("*NODE\n1, 0, 0, 0\n*INCLUDE, INPUT=main.inp\n")
    with pytest.raises(ds.MeshError, match="not as Abaqus writes it"):
        ds.read(tmp_path / "main.inp")
