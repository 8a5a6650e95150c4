"""Input of Ansys and LS-DYNA: columns of each width, bricks that are other cells, parts, sets and segments."""

from __future__ import annotations

import pathlib
from typing import Any

import numpy as np
import pytest

import dartsweep as ds
from volumes import CUBE, PRISM, TETRA, volume_of

_APEX = np.array([*CUBE[:4], (0.5, 0.5, 1)])
_ROOF = np.array([*CUBE[:4], (0.5, 0, 1), (0.5, 1, 1)])
CELLS = [  # points of a cell, and how it is written as a brick
    (CUBE, [0, 1, 2, 3, 4, 5, 6, 7], ds.CellType.HEXAHEDRON, 1.0),
    (PRISM, [0, 1, 2, 2, 3, 4, 5, 5], ds.CellType.WEDGE, 0.5),
    (_APEX, [0, 1, 2, 3, 4, 4, 4, 4], ds.CellType.PYRAMID, 1 / 3),
    (TETRA, [0, 1, 2, 2, 3, 3, 3, 3], ds.CellType.TETRA, 1 / 6),
    (TETRA, [0, 1, 2, 3, 3, 3, 3, 3], ds.CellType.TETRA, 1 / 6),
    (_ROOF, [0, 1, 2, 3, 4, 4, 5, 5], ds.CellType.WEDGE, 0.5),
    (PRISM, [0, 1, 1, 2, 3, 4, 4, 5], ds.CellType.WEDGE, 0.5),
]
POINTS = np.concatenate([points + (2 * i, 0, 0) for i, (points, _, _, _) in enumerate(CELLS)])
NUMBERS = 7 * np.arange(len(POINTS)) + 12  # of nodes: with gaps
FIRST = np.cumsum([0, *(len(points) for points, _, _, _ in CELLS)])
BRICKS = [NUMBERS[FIRST[i] + np.array(order)].tolist() for i, (_, order, _, _) in enumerate(CELLS)]


def check_cells(environment: ds.Environment) -> None:
    """Each cell is of its own type, in the order of the file, and as large as it should be."""
    types = [environment.volume_counts(environment.volume_id(i)).type for i in range(environment.info.volume_count)]
    assert types == [kind for _, _, kind, _ in CELLS] and environment.notes == ()
    assert volume_of(environment) == pytest.approx(sum(volume for _, _, _, volume in CELLS))


def columns(numbers: Any, width: int) -> str:
    return "".join(f"{number:{width}}" for number in numbers)


def lsdyna(width: int, mark: str, has_two_rows: bool, is_free: bool = False, of_part: int = 10) -> str:
    """Elements of the parts 3 and 4. Numbers have a width, reals 16 columns or 20, and numbers of parts a width of their own."""

    def row(words: list[str], own: int) -> str:
        return ",".join(words) if is_free else "".join(f"{word:>{own}}" for word in words)

    real = 20 if width == 20 else 16
    text = [f"*NODE{mark}", "$# a remark"]
    text += [row([str(n)], width) + ("," if is_free else "") + row([f"{x:g}" for x in point], real) for n, point in zip(NUMBERS.tolist(), POINTS)]
    text += ["*PART", "shaft", row(["3", "1", "1"], of_part), "the rest", row(["4", "1", "1"], of_part), f"*ELEMENT_SOLID{mark}"]
    for i, nodes in enumerate(BRICKS):
        head, own = row([str(101 + 10 * i), "3" if i < 2 else "4"], width), row([str(node) for node in nodes], width)
        text += [head, own + ("" if is_free else row(["0", "0"], width))] if has_two_rows else [head + ("," if is_free else "") + own]
    return "\n".join(text) + "\n"


@pytest.mark.parametrize("has_two_rows", [False, True])
@pytest.mark.parametrize(("head", "mark", "width"), [("", "", 8), ("", " %", 10), (" I10=Y", "", 10), ("", "+", 20), (" LONG=Y", "", 20)])
def test_bricks_of_lsdyna_in_all_columns(head: str, mark: str, width: int, has_two_rows: bool, tmp_path: pathlib.Path) -> None:
    deck = lsdyna(width, mark, has_two_rows, of_part=20 if "LONG" in head else 10)
    (tmp_path / "deck.k").write_text(f"$ a remark\n*KEYWORD{head}\n{deck}*END\n*NODE\nwhat follows is no part of it\n")
    with ds.read(tmp_path / "deck.k") as environment:
        check_cells(environment)
        assert environment.regions() == [3, 4] and environment.region_names == {"shaft": 3, "the rest": 4}
        assert environment.mark_region("shaft", mark=False)[0] == 2


@pytest.mark.parametrize("has_two_rows", [False, True])
def test_bricks_of_lsdyna_between_commas(has_two_rows: bool, tmp_path: pathlib.Path) -> None:
    keyword = "*Element_Solid_Format2" if has_two_rows else "*Element_Solid"
    (tmp_path / "deck.key").write_text("*keyword\n" + lsdyna(1, "", has_two_rows, is_free=True).replace("*ELEMENT_SOLID", keyword))
    with ds.read(tmp_path / "deck.key") as environment:
        check_cells(environment)


SETS = """*KEYWORD
*INCLUDE_PATH
parts
*INCLUDE
.\\nodes +
.k
*ELEMENT_SOLID_ORTHO
       1       1       1       2       3       4       4       4       4       4
             1.0             0.0             0.0
             0.0             1.0             0.0
       2       2       1       3       2       5       5       5       5       5
             1.0             0.0             0.0
             0.0             1.0             0.0
*ELEMENT_SHELL_THICKNESS
       7       9       1       2       4       4
             1.0             1.0             1.0             1.0
*ELEMENT_BEAM
       8       8       1       4       5
*PART

         1         1         1
wall
         9         1         1
*SET_SOLID_GENERATE_TITLE
both of them
         1
         1         2
*SET_PART_LIST
         5
         2
*SET_SEGMENT_TITLE
inlet
         3
         2         3         4         4
*SET_SEGMENT
         5
         1         3         5         5
*SET_NODE_LIST
         1
         1
"""


def test_sets_segments_and_included_files_of_lsdyna(tmp_path: pathlib.Path) -> None:
    (tmp_path / "parts").mkdir()
    points = [*TETRA, (0.1, 0.1, -1)]
    nodes = "".join(f"{i:8}{x:16g}{y:16g}{z:13g}+00\n" for i, (x, y, z) in enumerate(points, 1))
    (tmp_path / "parts" / "nodes.k").write_text(f"*KEYWORD\n*NODE\n{nodes}*END\n")
    (tmp_path / "deck.k").write_text(SETS)
    with ds.read(tmp_path / "deck.k") as environment:
        assert volume_of(environment) == pytest.approx(1 / 3) and environment.notes == () and environment.regions() == [1, 2]
        assert {name: len(environment.faces(name)) for name in environment.surface_names} == {"wall": 1, "inlet": 1, "segment set 5": 1}
        assert environment.surface_names["wall"] == 9
        assert environment.mark_region("both of them", mark=False)[0] == 2 and environment.mark_region("part set 5", mark=False)[0] == 1


NODES = "".join(f"{i:8}{x:16g}{y:16g}{z:16g}\n" for i, (x, y, z) in enumerate([*CUBE, *(CUBE + (2, 0, 0)), *(CUBE + (4, 0, 0))], 1))
"""Nodes of LS-DYNA of three cubes: 1 to 8, 9 to 16 and 17 to 24."""


def solid(number: int, part: int, first: int) -> str:
    return columns([number, part, *range(first, first + 8)], 8) + "\n"


def written(folder: pathlib.Path, text: str) -> pathlib.Path:
    (folder / "deck.k").write_text(f"*KEYWORD\n*NODE\n{NODES}{text}")
    return folder / "deck.k"


@pytest.mark.parametrize("has_two_rows", [False, True])
def test_blank_rows_of_lsdyna_behind_an_element_are_zeros(has_two_rows: bool, tmp_path: pathlib.Path) -> None:
    rows = [solid(i, 1, 8 * i - 7) for i in (1, 2, 3)]
    rows = [f"{row[:16]}\n{row[16:]}" for row in rows] if has_two_rows else rows
    text = "*ELEMENT_SOLID_ORTHO\n" + "\n\n".join(rows) + "\n"
    for end in ("\n", "\n\n\n"):  # what is more than the rows of the last element is no part of it
        with ds.read(written(tmp_path, text + end)) as environment:
            assert environment.info.volume_count == 3 and volume_of(environment) == pytest.approx(3)
    with pytest.raises(ds.MeshError, match="rows for each element, but the last one has fewer.*; LS-PrePost"):
        ds.read(written(tmp_path, text))


def test_parts_of_lsdyna_with_one_title_have_names_of_their_own(tmp_path: pathlib.Path) -> None:
    parts = "*PART\n" + "".join(f"{title}\n{columns([number, 1, 1], 10)}\n" for title, number in (("a", 3), ("a", 4), ("wall", 7), ("wall", 8)))
    shells = "*ELEMENT_SHELL\n" + "".join(columns(row, 8) + "\n" for row in ([1, 7, 1, 2, 3, 4], [2, 8, 5, 6, 7, 8], [3, 8, 9, 10, 11, 12]))
    same = f"*SET_SOLID_LIST_TITLE\na\n{1:10}\n{2:10}\n"
    with ds.read(written(tmp_path, f"{parts}*ELEMENT_SOLID\n{solid(1, 3, 1)}{solid(2, 4, 9)}{solid(3, 4, 17)}{shells}{same}")) as environment:
        counts = {name: environment.mark_region(name, mark=False)[0] for name in ("a", "a (part 4)", "a (solid set)")}
        assert counts == {"a": 1, "a (part 4)": 2, "a (solid set)": 1}
        assert {name: len(environment.faces(name)) for name in environment.surface_names} == {"wall": 1, "wall (part 8)": 2}
        assert environment.surface_names["wall (part 8)"] == 8


def test_sets_of_lsdyna_keep_solids_and_thick_shells_apart(tmp_path: pathlib.Path) -> None:
    elements = f"*ELEMENT_SOLID\n{solid(1, 1, 1)}*ELEMENT_TSHELL\n{solid(1, 1, 9)}{solid(2, 1, 17)}"
    sets = f"*SET_SOLID_LIST\n{1:10}\n{1:10}{2:10}\n*SET_TSHELL_LIST\n{1:10}\n{1:10}{2:10}\n"
    with ds.read(written(tmp_path, elements + sets)) as environment:
        assert volume_of(environment) == pytest.approx(3)
        assert [environment.mark_region(name, mark=False)[0] for name in ("solid set 1", "tshell set 1")] == [1, 2]


def test_ranges_of_lsdyna_may_be_long(tmp_path: pathlib.Path) -> None:
    ranges = columns([2, 99999999, 0, 0, 2, 3, 3000000000, 9999999999], 10)
    sets = f"*SET_SOLID_GENERATE\n{1:10}\n{ranges}\n*SET_SOLID_GENERATE\n{2:10}\n{columns([3, 3, 1, 1], 10)}\n"
    with ds.read(written(tmp_path, "*ELEMENT_SOLID\n" + "".join(solid(i, 1, 8 * i - 7) for i in (1, 2, 3)) + sets)) as environment:
        assert [environment.mark_region(f"solid set {i}", mark=False)[0] for i in (1, 2)] == [2, 2]


@pytest.mark.parametrize("middles", [[13, 14, 15, 16], [13, 14, 0, 0]])
def test_shells_of_lsdyna_with_nodes_in_the_middle_of_sides(middles: list[int], tmp_path: pathlib.Path) -> None:
    points = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0)]
    nodes = "".join(f"{i},{x},{y},{z}\n" for i, (x, y, z) in enumerate(points, 9))
    (tmp_path / "deck.k").write_text(f"*KEYWORD\n*NODE\n{nodes}*ELEMENT_SHELL\n{columns([1, 1, 9, 10, 11, 12, *middles], 8)}\n")
    with ds.read(tmp_path / "deck.k") as environment:
        assert volume_of(environment) == pytest.approx(4) and any("taken by their corners" in note for note in environment.notes)


def test_solids_of_lsdyna_with_ten_nodes(tmp_path: pathlib.Path) -> None:
    sides = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
    points = [*TETRA, *((TETRA[a] + TETRA[b]) / 2 for a, b in sides)]
    nodes = "".join(f"{i},{x},{y},{z}\n" for i, (x, y, z) in enumerate(points, 1))
    (tmp_path / "deck.k").write_text(f"*KEYWORD\n*NODE\n{nodes}*ELEMENT_SOLID (ten nodes format)\n       1       1\n{columns(range(1, 11), 8)}\n")
    for quadratic, count in (("corners", 1), ("split", 8)):
        with ds.read(tmp_path / "deck.k", quadratic=quadratic) as environment:
            assert environment.info.volume_count == count and volume_of(environment) == pytest.approx(1 / 6)


@pytest.mark.parametrize("order", [1, 2])
def test_solids_of_lsdyna_that_gmsh_writes(order: int, tmp_path: pathlib.Path) -> None:
    """Gmsh writes nodes of wedges in an order of its own, and ten nodes in a row that goes on."""
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.add("two")
        for tag, (kind, points) in enumerate(((4, TETRA), (6 if order == 1 else 4, (PRISM if order == 1 else TETRA) + (2, 0, 0))), 1):
            gmsh.model.addDiscreteEntity(3, tag)
            nodes = np.arange(len(points)) + 10 * tag
            gmsh.model.mesh.addNodes(3, tag, nodes, points.ravel())
            gmsh.model.mesh.addElementsByType(tag, kind, [tag], nodes)
            gmsh.model.addPhysicalGroup(3, [tag], tag)
        gmsh.model.mesh.setOrder(order)
        gmsh.write(str(tmp_path / "deck.key"))
    finally:
        gmsh.finalize()
    with ds.read(tmp_path / "deck.key", quadratic="split") as environment:
        assert volume_of(environment) == pytest.approx(1 / 6 + (0.5 if order == 1 else 1 / 6)) and len(environment.regions()) == 2
        assert environment.info.volume_count == (2 if order == 1 else 16) and environment.notes == ()


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("*INCLUDE\nnothing.k\n", "includes 'nothing.k', which is not there"),
        ("*INCLUDE\ndeck.k\n", "within itself"),
        ("*INCLUDE_TRANSFORM\nother.k\n", "moves or numbers"),
        ("*NODE_TRANSFORM\n         1         1\n", "makes or moves"),
        ("*ELEMENT_SOLID_P21\n       1       1\n", "option P21"),
        ("*NODE\n       1             &x1             0.0             0.0\n", "not as LS-DYNA reads it"),
        ("*ELEMENT_SOLID\n       1       1       1       2       3       9       9       9       9       9\n", "names a node that is not there"),
        ("*NODE\n      -3             0.0             0.0             0.0\n", "a node has the number -3"),
        ("*NODE\n       0             0.0             0.0             0.0\n", "a node has the number 0"),
        ("*NODE\n1,0,0,0\n2,1,0,0\n*NODE\n1,0,0,0\n2,1,0,1\n", "node 2 is there twice"),
        ("-----BEGIN PGP MESSAGE-----\n", "encrypted"),
        ("*NODE\n       1             0.0             0.0             0.0\n", "it has no cells"),
    ],
)
def test_what_lsdyna_would_make_of_a_deck_is_told(text: str, reason: str, tmp_path: pathlib.Path) -> None:
    (tmp_path / "deck.k").write_text(f"*KEYWORD\n{text}")
    with pytest.raises(ds.MeshError, match=reason):
        ds.read(tmp_path / "deck.k")


def archive(types: str, elements: list[list[int]], more: str = "", points: Any = POINTS, numbers: Any = NUMBERS) -> str:
    """A file of elements, each with material, type and nodes."""
    text = ["/COM,ANSYS RELEASE 19.2", "/PREP7", types, f"NBLOCK,6,SOLID,{max(numbers):10},{len(points):10}", "(3i9,6e21.13e3)"]
    for number, point in zip(numbers, points):
        kept = next((k for k in (3, 2, 1) if point[k - 1]), 0)  # zeros at the end are left out
        text.append(columns([number, 0, 0], 9) + "".join(f"{x:21.13E}" for x in point[:kept]))
    text += ["N,R5.3,LOC,       -1,", f"EBLOCK,19,SOLID,{len(elements):10},{len(elements):10}", "(19i9)"]
    for i, (material, kind, *nodes) in enumerate(elements):
        text.append(columns([material, kind, 1, 1, 0, 0, 0, 0, len(nodes), 0, 50 + 10 * i, *nodes[:8]], 9))
        text += [columns(nodes[8:], 9)] if len(nodes) > 8 else []
    return "\n".join(text) + f"\n{-1:9}\n{more}FINISH\n"


@pytest.mark.parametrize("types", ["ET,        1,185", "ETBLOCK,        1,        1\n(2i9,19a9)\n        1      185        0\n       -1"])
def test_bricks_of_ansys(types: str, tmp_path: pathlib.Path) -> None:
    component = f"CMBLOCK,SHAFT   ,ELEM,       2\n(8i10)\n{50:10}{-60:10}\nCMBLOCK,ENDS    ,NODE,       1\n(8i10)\n{12:10}\n"
    (tmp_path / "part.cdb").write_text(archive(types, [[1 if i < 2 else 5, 1, *nodes] for i, nodes in enumerate(BRICKS)], component))
    with ds.read(tmp_path / "part.cdb") as environment:
        check_cells(environment)
        assert environment.regions() == [1, 5] and environment.mark_region("SHAFT", mark=False)[0] == 2


def test_bricks_of_ansys_with_twenty_nodes(tmp_path: pathlib.Path) -> None:
    """Cells of second order that are a brick with repeated nodes, and one whose sides have no nodes in the middle."""
    sides = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    numbers, points = NUMBERS.tolist(), POINTS.tolist()
    elements = []
    for nodes in BRICKS[:4]:
        at = dict(zip(numbers, points))
        middles: dict[frozenset[int], int] = {}
        for a, b in sides:
            ends = frozenset((nodes[a], nodes[b]))
            if len(ends) == 1:
                middles[ends] = nodes[a]
            elif ends not in middles:
                numbers.append(max(numbers) + 1)
                points.append([(x + y) / 2 for x, y in zip(at[nodes[a]], at[nodes[b]])])
                middles[ends] = numbers[-1]
        elements.append([1, 1, *nodes, *(middles[frozenset((nodes[a], nodes[b]))] for a, b in sides)])
    elements.append([1, 1, *BRICKS[3], *[0] * 12])
    elements[4] = [1, 1, *(numbers[FIRST[4] + k] for k in (0, 1, 2, 2, 3, 3, 3, 3)), *[0] * 12]
    (tmp_path / "part.cdb").write_text(archive("ET,1,SOLID186", elements, "", points, numbers))
    for quadratic, count in (("corners", 5), ("split", 8 + 8 + 10 + 8 + 1)):
        with ds.read(tmp_path / "part.cdb", quadratic=quadratic) as environment:
            assert environment.info.volume_count == count
            assert volume_of(environment) == pytest.approx(1 + 0.5 + 1 / 3 + 1 / 6 + 1 / 6)
            assert not any("inside out" in note for note in environment.notes)


def test_remarks_of_ansys_are_no_part_of_a_command(tmp_path: pathlib.Path) -> None:
    remark = " ! as SHELL181"
    component = f"CMBLOCK,SHAFT   ,ELEM,       2{remark}\n(8i10){remark}\n{50:10}{-60:10}\n"
    (tmp_path / "part.cdb").write_text(archive(f"ET,1,185{remark}", [[1 if i < 2 else 5, 1, *nodes] for i, nodes in enumerate(BRICKS)], component))
    with ds.read(tmp_path / "part.cdb") as environment:
        check_cells(environment)
        assert environment.mark_region("SHAFT", mark=False)[0] == 2


def test_key_options_of_ansys_in_the_command_of_the_type(tmp_path: pathlib.Path) -> None:
    def read(types: str) -> ds.Environment:
        (tmp_path / "part.cdb").write_text(archive(types, [[1, 1, *nodes] for nodes in BRICKS]))
        return ds.read(tmp_path / "part.cdb")

    for types in ("ET,1,200,10", "ET,1,200,0\nKEYOPT,1,1,10", "ET,1,MESH200,10\nET,1,185,option"):
        with read(types) as environment:
            check_cells(environment)
    for types in ("ET,1,200,10\nET,1,200", "ET,1,200"):  # lines
        with pytest.raises(ds.MeshError, match="it has no cells"):
            read(types)


def test_quads_of_ansys_with_nodes_in_the_middle_of_sides(tmp_path: pathlib.Path) -> None:
    points = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0)]
    for middles, kept in ([16, 17, 18, 19], True), ([16, 17, 0, 0], False):
        (tmp_path / "part.cdb").write_text(archive("ET,1,183", [[1, 1, 12, 13, 14, 15, *middles]], "", points, range(12, 20)))
        with ds.read(tmp_path / "part.cdb") as environment:
            assert volume_of(environment) == pytest.approx(4) and any("taken by their corners" in note for note in environment.notes)
        with ds.read(tmp_path / "part.cdb", quadratic="split") as environment:
            assert environment.info.volume_count == (4 if kept else 1)


def test_components_of_ansys_may_have_long_ranges(tmp_path: pathlib.Path) -> None:
    component = f"CMBLOCK,SHAFT   ,ELEM,       2\n(8i10)\n{60:10}{-999999999}\n"
    (tmp_path / "part.cdb").write_text(archive("ET,1,185", [[1, 1, *nodes] for nodes in BRICKS], component))
    with ds.read(tmp_path / "part.cdb") as environment:
        assert environment.mark_region("SHAFT", mark=False)[0] == len(BRICKS) - 1


def test_contacts_of_ansys_are_left_out_and_told(tmp_path: pathlib.Path) -> None:
    loads = "et,3,154\neblock,10,,,1\n(15i9)\n" + columns([900, 3, 3, 3, 0, *BRICKS[0][:4]], 9) + f"\n{-1:9}\n"
    elements = [[1, 1, *BRICKS[0]], [2, 2, *BRICKS[0][:4]], [4, 4, *BRICKS[0][4:]], [4, 4, *BRICKS[0][:3], BRICKS[0][2]]]
    (tmp_path / "ds.dat").write_text(archive("et,1,185\net,2,174\net,4,181\nET,_tid,170", elements, loads).replace("/COM", "/batch\n/COM"))
    with ds.read(tmp_path / "ds.dat") as environment:
        assert environment.info.volume_count == 1 and volume_of(environment) == pytest.approx(1)
        assert environment.notes == (
            "1 elements of Ansys's types 174 (contacts, lines, points) were left out",
            "1 elements of blocks without SOLID, as contacts and loads have, were left out",
        )


@pytest.mark.parametrize(
    ("types", "reason"),
    [("ET,1,999", "the type 999 of Ansys"), ("ET,2,185", "a type 1 that no ET names"), ("ET,1,187", "7 elements have 8 nodes")],
)
def test_elements_that_ansys_does_not_explain_are_told(types: str, reason: str, tmp_path: pathlib.Path) -> None:
    (tmp_path / "part.cdb").write_text(archive(types, [[1, 1, *nodes] for nodes in BRICKS]))
    with pytest.raises(ds.MeshError, match=reason):
        ds.read(tmp_path / "part.cdb")


def test_archives_of_ansys_that_end_early_or_name_other_nodes_are_told(tmp_path: pathlib.Path) -> None:
    text = archive("ET,1,185", [[1, 1, *nodes] for nodes in BRICKS])
    component = f"CMBLOCK,A,ELEM,        20\n(8i10)\n{50:10}"
    cases = [(text[: text.index(end)], "ends within a block") for end in ("       -1\n", "(3i9", "(19i9")]
    cases += [(text + more, "ends within a block") for more in ("CMBLOCK,A,ELEM,        20\n", component, component + "\n", "ETBLOCK,1,1\n")]
    cases += [(text.replace(f"{BRICKS[0][0]:9}", f"{13:9}", 1), "names a node"), (text.replace(f"{NUMBERS[1]:9}", f"{-3:9}", 1), "the number -3")]
    for own, reason in cases:
        (tmp_path / "part.cdb").write_text(own)
        with pytest.raises(ds.MeshError, match=reason):
            ds.read(tmp_path / "part.cdb")
    (tmp_path / "part.cdb").write_text("/PREP7\nN,1,0,0,0\nEN,1,1\n")
    with pytest.raises(ds.MeshError, match="no NBLOCK"):
        ds.read(tmp_path / "part.cdb")


DIFFPACK = """
Finite element mesh (GridFE):

  Number of space dim. =   3
  Number of elements   =   2
  Number of nodes      =   5

  All elements are of the same type : dpTRUE
  Max number of nodes in an element: 4
  Only one subdomain               : dpFALSE
  Lattice data                     ? 0



  1 Boundary indicators:  1


  Nodal coordinates and nodal boundary indicators,
  the columns contain:
   - node number
   - coordinates
   - no of boundary indicators that are set (ON)
   - the boundary indicators that are set (ON) if any.
#
  1  (  0.0,  0.0,  0.0) [1] 1
  2  (  1.0,  0.0,  0.0) [1] 1
  3  (  0.0,  1.0,  0.0) [1] 1
  4  (  0.0,  0.0,  1.0) [0]
  5  (  0.0,  0.0, -1.0) [0]

  Element types and connectivity
  the columns contain:
   - element number
   - element type
   - subdomain number
   - the global node numbers of the nodes in the element.
#
  1  ElmT4n3D  3  1  2  3  4
  2  ElmT4n3D  8  1  3  2  5
"""


def test_materials_of_diffpack(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("gmsh")
    (tmp_path / "two.diff").write_text(DIFFPACK)
    with ds.read(tmp_path / "two.diff") as environment:
        assert volume_of(environment) == pytest.approx(1 / 3) and environment.regions() == [3, 8]
        assert environment.mark_region(8, mark=False)[0] == 1


def test_a_stage_of_usd_is_told(tmp_path: pathlib.Path) -> None:
    (tmp_path / "stage.usda").write_text("#usda 1.0\n")
    with pytest.raises(ds.MeshError, match="it is a stage of USD"):
        ds.read(tmp_path / "stage.usda")
