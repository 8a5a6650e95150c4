"""Models of FEBio, Elmer and GiD: small files written here, against what their texts say."""

from __future__ import annotations

import pathlib
from typing import Any

import pytest

import dartsweep as ds
from volumes import CUBE, PRISM, volume_of

POINTS = [*PRISM, (0, 0, -1)]  # a wedge above a tetrahedron
_LOW, _TOP, _UP = ((0, 1), (1, 2), (2, 0)), ((3, 4), (4, 5), (5, 3)), ((0, 3), (1, 4), (2, 5))  # sides of wedges
_LOWER, _UPPER, _UPWARDS = ((0, 1), (1, 2), (2, 3), (3, 0)), ((4, 5), (5, 6), (6, 7), (7, 4)), ((0, 4), (1, 5), (2, 6), (3, 7))  # of hexahedra
_AROUND, _BELOW, _ABOVE = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)), ((0, 1, 2, 3),), ((4, 5, 6, 7),)
_CENTRE = (tuple(range(8)),)
HIGH = [*CUBE, *((CUBE[a] + CUBE[b]) / 2 for a, b in ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)))]


def sizes(environment: ds.Environment) -> dict[str, int]:
    return {name: len(environment.faces(name)) for name in environment.surface_names}


def febio(root: str, nodes: Any, parts: str, more: str) -> str:
    places = "".join(f'<node id="{i}">{x:g},{y:g},{z:g}</node>' for i, (x, y, z) in enumerate(nodes, 11))
    return f'<?xml version="1.0"?><febio_spec version="4.0"><Material/><{root}><Nodes name="all">{places}</Nodes>{parts}{more}</{root}></febio_spec>'


@pytest.mark.parametrize(("root", "members"), [("Mesh", "7,8"), ("Geometry", '<elem id="7"/><elem id="8"/>')])
def test_models_of_febio_keep_parts_surfaces_and_sets(tmp_path: pathlib.Path, root: str, members: str) -> None:
    parts = '<Elements type="penta6" name="bone"><elem id="7">11,12,13,14,15,16</elem></Elements>'
    parts += '<Elements type="TET4G4" name="cartilage"><elem id="8"> 11, 13, 12, 17 </elem></Elements>'
    more = '<Surface name="top"><tri3 id="1">14,15,16</tri3></Surface><Surface name="side"><quad4 id="1">11,12,15,14</quad4></Surface>'
    more += f'<ElementSet name="joint">{members}</ElementSet><PartList name="hard">bone</PartList>'
    (tmp_path / "two.feb").write_text(febio(root, POINTS, parts, more))
    with ds.read(tmp_path / "two.feb") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.info.part_count == 1 and environment.notes == ()
        assert environment.regions() == [1, 2] and environment.region_names["cartilage"] == 2
        assert set(environment.region_groups) >= {"bone", "cartilage", "joint", "hard"}
        assert sizes(environment) == {"top": 1, "side": 1}


def test_models_of_febio_in_several_files_and_of_unknown_elements(tmp_path: pathlib.Path) -> None:
    part = '<Elements type="{}" name="cube"><elem id="1">{}</elem></Elements>'
    top = '<Surface name="top"><quad8 id="1">15,16,17,18,23,24,25,26</quad8></Surface>'
    model = febio("Mesh", HIGH, part.format("hex20", ",".join(map(str, range(11, 31)))), top)
    (tmp_path / "mesh.feb").write_text(model)
    (tmp_path / "model.feb").write_text('<febio_spec version="4.0"><Mesh from="mesh.feb"/></febio_spec>')
    with ds.read(tmp_path / "model.feb", quadratic="split") as environment:
        assert environment.info.volume_count == 8 and volume_of(environment) == pytest.approx(1)
        assert sizes(environment) == {"top": 4} and environment.notes == ()
    shells = febio("Mesh", CUBE, '<Elements type="quad4" name="skin"><elem id="1">11,12,13,14</elem></Elements>', top.replace("quad8", "quad4"))
    (tmp_path / "shells.feb").write_text(shells)
    with ds.read(tmp_path / "shells.feb") as environment:
        assert environment.dimension == 2 and "surface 'top' is one of shells" in environment.notes[-1]
    for parts, reason in (
        (part.format("tet4", "11,12,13,15").replace(' type="tet4"', ""), "elements have the type 'elem'"),
        (part.format("quark4", "11"), "elements have the type 'quark4'"),
        (part.format("tet4", "11,12,13"), "element 1 has 3 nodes, where its type has 4"),
        (part.format("tet4", "11,12,13,99"), "node 99 is not there"),
        ("<Instance/>", "parts and instances"),
    ):
        (tmp_path / "mesh.feb").write_text(febio("Mesh", HIGH, parts, ""))
        with pytest.raises(ds.MeshError, match=reason):
            ds.read(tmp_path / "mesh.feb")


def test_names_and_ranges_in_models_of_febio(tmp_path: pathlib.Path) -> None:
    tetrahedra = "".join(f'<elem id="{i}">{a},{b},{c},{d}</elem>' for i, (a, b, c, d) in enumerate([(11, 12, 13, 14), (12, 15, 13, 14), (13, 15, 16, 14)], 1))
    parts = f'<Elements type="tet5" name="left bone">{tetrahedra.replace("</elem>", ",99</elem>")}</Elements>'
    parts += '<Elements type="tet4" name="cartilage"><elem id="7"> 11, 13, 12, 17 </elem></Elements>'
    more = '<PartList name="hard">left bone,</PartList><PartList name="all"> left bone , cartilage </PartList>'
    for name, members in {"range": "1:3", "step": "1:3:2, 7", "blanks": "1 2:3", "joined": "1", "cartilage": "1", "all": "2", "same": "7"}.items():
        more += f'<ElementSet name="{name}">{members}</ElementSet>'
    more += '<ElementSet name="joined">2</ElementSet><PartList name="same">cartilage</PartList>'
    more += '<Surface name="all"><tri3 id="1">14,15,16</tri3></Surface><Surface name="all"><tri3 id="1">11,12,14</tri3></Surface>'
    (tmp_path / "names.feb").write_text(febio("Mesh", POINTS, parts, more))
    with ds.read(tmp_path / "names.feb") as environment:
        regions = [environment.region(environment.volume_id(i)) for i in range(4)]
        groups = {name: [i for i in range(4) if regions[i] in labels] for name, labels in environment.region_groups.items()}
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6)
        assert groups["hard"] == groups["left bone"] == groups["range"] == groups["blanks"] == [0, 1, 2]
        assert groups["step"] == [0, 2, 3] and groups["joined"] == [0, 1] and groups["cartilage"] == groups["same"] == [3]
        assert groups["cartilage (element set)"] == [0] and groups["all"] == [1] and groups["all (part set)"] == [0, 1, 2, 3]
        assert sizes(environment) == {"all": 2} and "same (part set)" not in groups
    (tmp_path / "names.feb").write_text(febio("Mesh", POINTS, parts, '<ElementSet name="far">1:999999999999</ElementSet>'))
    with pytest.raises(ds.MeshError, match="element 4 is not there"):
        ds.read(tmp_path / "names.feb")


def test_models_of_febio_of_version_1(tmp_path: pathlib.Path) -> None:
    elements = '<penta6 id="1" mat="2">11,12,13,14,15,16</penta6><tet4 id="2" mat="1">11,13,12,17</tet4>'
    (tmp_path / "old.feb").write_text(febio("Geometry", POINTS, f"<Elements>{elements}</Elements>", "").replace("4.0", "1.2"))
    with ds.read(tmp_path / "old.feb") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.notes == ()
        assert environment.region_names == {"2": 1, "1": 2} and environment.regions() == [1, 2]


def elmer(folder: pathlib.Path, nodes: Any, elements: str, boundary: str, names: str) -> None:
    counts = len(nodes), elements.count("\n"), boundary.count("\n")
    places = "".join(f"{i} -1 {x:g} {y:g} {z:g}\n" for i, (x, y, z) in enumerate(nodes, 1))
    header = f"{counts[0]} {counts[1]} {counts[2]}\n1\n504 1\n"
    for name, text in {"header": header, "nodes": places, "elements": elements, "boundary": boundary, "names": names}.items():
        (folder / f"mesh.{name}").write_text(text)


@pytest.mark.parametrize("comments", [("! ----- names for bodies -----\n", "! ----- names for boundaries -----\n"), ("", "")])
def test_meshes_of_elmer_keep_bodies_and_boundaries(tmp_path: pathlib.Path, comments: tuple[str, str]) -> None:
    names = f"{comments[0]}$ bone = 1\n$ soft tissue = 2\n{comments[1]}$ top = 1\n$ side = 2\n$ top = 3\n"
    boundary = "1 1 1 0 303 4 5 6\n2 2 1 0 404 1 2 5 4\n3 3 2 0 303 1 3 7\n4 4 2 0 303 1 2 7\n"
    elmer(tmp_path, POINTS, "1 1 706 1 2 3 4 5 6\n2 2 504 1 3 2 7\n", boundary, names)
    for path in (tmp_path, tmp_path / "mesh.header"):
        with ds.read(path) as environment:
            assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.notes == ()
            assert environment.region_names == {"bone": 1, "soft tissue": 2} and sizes(environment) == {"top": 2, "side": 1, "4": 1}
    (tmp_path / "mesh.elements").write_text("1 1 706 1 2 3 4 5 6\n")
    with pytest.raises(ds.MeshError, match="7 nodes, 1 elements and 4 of the boundary, where its header says"):
        ds.read(tmp_path)


def test_headings_of_elmer_say_what_has_a_name(tmp_path: pathlib.Path) -> None:
    names = "! names for bodies\n$ ghost = 3\n$ old = 1\n$ bone = 1\n$ tissue = 2\n! names for boundaries\n$ top = 1\n"
    elmer(tmp_path, POINTS, "1 1 706 1 2 3 4 5 6\n2 2 504 1 3 2 7\n", "1 1 1 0 303 4 5 6\n2 3 2 0 303 1 3 7\n", names)
    with ds.read(tmp_path) as environment:
        assert environment.region_names == {"ghost": 3, "bone": 1, "tissue": 2} and sizes(environment) == {"top": 1, "3": 1}


def test_quadratic_cells_of_elmer(tmp_path: pathlib.Path) -> None:
    order = [*range(1, 13), 17, 18, 19, 20, 13, 14, 15, 16]  # the sides upwards come before those on top
    elmer(tmp_path, HIGH, "1 1 820 " + " ".join(map(str, order)) + "\n", "", "")
    with ds.read(tmp_path, quadratic="split") as environment:
        assert environment.info.volume_count == 8 and volume_of(environment) == pytest.approx(1)


def gid(names: tuple[str, str], materials: tuple[str, str]) -> str:
    places = "".join(f"{i} {x:g} {y:g} {z:g}\n" for i, (x, y, z) in enumerate(POINTS, 11))
    wedge = f"MESH {names[0]} dimension 3 ElemType Prism Nnode 6\nCoordinates\n{places}end coordinates\nElements\n1 11 12 13 14 15 16 {materials[0]}\nend elements\n"
    tetrahedron = f"MESH {names[1]} dimension = 3 ElemType Tetrahedra  Nnode 4\ncoordinates\nend coordinates\nelements\n2 11 13 12 17 {materials[1]}\nend elements\n"
    return f'# made by a test\n{wedge}{tetrahedron}MESH "lid" dimension 3 ElemType Triangle Nnode 3\nCoordinates\nEnd Coordinates\nElements\n3 14 15 16\nEnd Elements\n'


def test_meshes_of_gid_keep_names_or_materials(tmp_path: pathlib.Path) -> None:
    (tmp_path / "two.post.msh").write_text(gid(('"bone one"', '"soft"'), ("", "")))
    with ds.read(tmp_path / "two.post.msh") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.notes == ()
        assert environment.region_names == {"bone one": 1, "soft": 2} and sizes(environment) == {"lid": 1}
    (tmp_path / "two.msh").write_text(gid(("", "Layer0"), ("5", "9")))
    with ds.read(tmp_path / "two.msh") as environment:
        assert environment.regions() == [5, 9] and "Layer0" in environment.region_groups
    (tmp_path / "two.msh").write_text(gid(("", ""), ("", "")).replace("Prism", "Sphere"))
    with pytest.raises(ds.MeshError, match="elements have the type 'Sphere', with 6 nodes"):
        ds.read(tmp_path / "two.msh")
    text = gid(('"bone #1"', '"soft"'), ("", "")).replace("end coordinates", "end coordinates # of it")
    (tmp_path / "two.msh").write_text(text)
    with ds.read(tmp_path / "two.msh") as environment:
        assert environment.region_names == {"bone #1": 1, "soft": 2}


@pytest.mark.parametrize(
    ("program", "kind", "middles"),
    [
        ("FEBio", "penta15", [*_LOW, *_TOP, *_UP]),  # its shape functions
        ("FEBio", "hex27", [*_LOWER, *_UPPER, *_UPWARDS, *_AROUND, *_BELOW, *_ABOVE, *_CENTRE]),
        ("Elmer", "715", [*_LOW, *_TOP, *_UP]),  # its elements.def
        ("Elmer", "715", [*_LOW, *_UP, *_TOP]),  # as ElmerGrid converts those of Gmsh
        ("Elmer", "827", [*_LOWER, *_UPWARDS, *_UPPER, *_AROUND, *_BELOW, *_ABOVE, *_CENTRE]),
        ("GiD", "Prism", [*_LOW, *_UP, *_TOP]),  # by the geometries of Kratos, whose pages say that GiD has their order
        ("GiD", "Hexahedra", [*_LOWER, *_UPWARDS, *_UPPER]),
        ("GiD", "Hexahedra", [*_LOWER, *_UPWARDS, *_UPPER, *_BELOW, *_AROUND, *_ABOVE, *_CENTRE]),
    ],
)
def test_orders_of_quadratic_nodes(tmp_path: pathlib.Path, program: str, kind: str, middles: Any) -> None:
    """Each node lies where the format has it, in a cell that is longer in one direction than in others and leans, and every part is valid."""
    corners = (PRISM if max(map(max, middles)) == 5 else CUBE) @ [[1, 0, 0], [0.25, 2, 0], [0.5, 0.25, 3]]
    nodes = [*corners, *(corners[list(members)].mean(axis=0) for members in middles)]
    numbers = range(1, len(nodes) + 1)
    row = " ".join(map(str, numbers))
    if program == "FEBio":
        path = tmp_path / "cell.feb"
        part = f'<Elements type="{kind}" name="one"><elem id="1">{",".join(str(number + 10) for number in numbers)}</elem></Elements>'
        path.write_text(febio("Mesh", nodes, part, ""))
    elif program == "Elmer":
        path = tmp_path / "mesh.header"
        elmer(tmp_path, nodes, f"1 1 {kind} {row}\n", "", "")
    else:
        path = tmp_path / "cell.msh"
        places = "".join(f"{number} {x} {y} {z}\n" for number, (x, y, z) in zip(numbers, nodes))
        path.write_text(f"MESH dimension 3 ElemType {kind} Nnode {len(nodes)}\nCoordinates\n{places}End Coordinates\nElements\n1 {row}\nEnd Elements\n")
    with ds.read(path, quadratic="split") as environment:
        assert environment.info.volume_count == 8 and environment.notes == ()
        assert volume_of(environment) == pytest.approx(3 if len(corners) == 6 else 6)
