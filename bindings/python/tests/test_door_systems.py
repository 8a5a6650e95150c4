"""Points that files give in coordinate systems of their own, and rows that stand elsewhere: each reader has them as global numbers, or loses them."""

from __future__ import annotations

import pathlib

import numpy as np
import pytest

import dartsweep as ds
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


@pytest.mark.parametrize("card", ["CORD2C,4,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.", "CORD3G,4,1,2,3"])
def test_systems_of_nastran_that_lead_nowhere_are_told(card: str, tmp_path: pathlib.Path) -> None:
    rows = "".join(f"GRID,{i},4,{x}.,{y}.,{z}.\n" for i, (x, y, z) in enumerate(TETRA.astype(int).tolist(), 1))
    (tmp_path / "lost.bdf").write_text(f"BEGIN BULK\n{card}\n{rows}CTETRA,1,1,1,2,3,4\nENDDATA\n")
    with pytest.raises(ds.MeshError, match="system"):
        ds.read(tmp_path / "lost.bdf")


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
