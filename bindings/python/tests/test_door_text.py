"""Formats that the package reads itself, and those of few programs: small files written here, against what their texts say."""

from __future__ import annotations

import pathlib
from typing import Any

import meshio
import numpy as np
import pytest

import dartsweep as ds
from volumes import CUBE, PRISM, TETRA, volume_of

POINTS = [*PRISM, (0, 0, -1)]  # a wedge above a tetrahedron


def lines(rows: Any, first: int = 1) -> str:
    """Numbered points."""
    return "".join(f"{i} {x:g} {y:g} {z:g}\n" for i, (x, y, z) in enumerate(rows, first))


def sizes(environment: ds.Environment) -> dict[str, int]:
    """The number of faces of each surface."""
    return {name: len(environment.faces(name)) for name in environment.surface_names}


def exodus(path: pathlib.Path, points: Any, blocks: list[tuple[str, int, str, Any]], sides: list[tuple[str, int, Any, Any]], version: int = 1) -> None:
    """A file of blocks (name, id, type, connectivity from 0 on) and side sets (name, id, elements and sides from 1 on)."""
    netcdf = pytest.importorskip("scipy.io").netcdf_file
    with netcdf(path, "w", version=version) as file:
        points = np.asarray(points, np.float64)
        file.createDimension("len_name", 33)
        file.createDimension("num_nodes", len(points))
        for axis, column in zip("xyz", points.T):
            file.createVariable(f"coord{axis}", "f8", ("num_nodes",))[:] = column
        for kind, sets in (("eb", blocks), ("ss", sides)):
            file.createDimension(f"num_{kind}", len(sets))
            file.createVariable(f"{kind}_prop1", "i4", (f"num_{kind}",))[:] = [own[1] for own in sets]
            names = file.createVariable(f"{kind}_names", "c", (f"num_{kind}", "len_name"))
            for i, own in enumerate(sets):
                names[i] = np.frombuffer(own[0].encode().ljust(33, b"\0"), "S1")
        for i, (_, _, kind, rows) in enumerate(blocks, 1):
            file.createDimension(f"el{i}", len(rows))
            file.createDimension(f"nod{i}", len(rows[0]))
            made = file.createVariable(f"connect{i}", "i4", (f"el{i}", f"nod{i}"))
            made[:] = np.asarray(rows) + 1
            made.elem_type = kind
        for i, (_, _, elements, own_sides) in enumerate(sides, 1):
            file.createDimension(f"ss{i}", len(elements))
            file.createVariable(f"elem_ss{i}", "i4", (f"ss{i}",))[:] = elements
            file.createVariable(f"side_ss{i}", "i4", (f"ss{i}",))[:] = own_sides


@pytest.mark.parametrize("version", [1, 2])
def test_exodus_keeps_names_of_blocks_and_side_sets(tmp_path: pathlib.Path, version: int) -> None:
    blocks = [("shaft", 12, "WEDGE6", [[0, 1, 2, 3, 4, 5]]), ("", 7, "TET4", [[0, 2, 1, 6]]), ("lid", 3, "TRISHELL3", [[3, 4, 5]])]
    sides = [("walls", 40, [1, 1, 1], [1, 2, 3]), ("", 41, [2, 3], [1, 2])]
    exodus(tmp_path / "two.e", POINTS, blocks, sides, version)
    with ds.read(tmp_path / "two.e") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.info.part_count == 1 and environment.notes == ()
        assert environment.regions() == [7, 12] and environment.region_names == {"shaft": 12, "7": 7}
        assert sizes(environment) == {"walls": 3, "41": 2, "lid": 1}
        assert environment.surface_names["walls"] == 40


def test_sides_of_shells_and_of_cells_of_the_plane_in_exodus(tmp_path: pathlib.Path) -> None:
    for kind, side in (("QUAD4", 3), ("SHELL4", 5)):  # the first two sides of a shell are itself
        exodus(tmp_path / "plane.e", CUBE[:4, :2], [("sheet", 1, kind, [[0, 1, 2, 3]])], [("top", 2, [1], [side])])
        with ds.read(tmp_path / "plane.e") as environment:
            assert environment.dimension == 2 and sizes(environment) == {"top": 1}
            (face,) = environment.faces("top")
            assert np.all(environment.points()[environment.vertices(face)["index"]][:, 1] == 1)


def test_bezier_cells_of_exodus_are_told(tmp_path: pathlib.Path) -> None:
    exodus(tmp_path / "spline.e", CUBE, [("patch", 1, "BEX_HEX", [list(range(8))])], [])
    with pytest.raises(ds.MeshError, match="1 cells have the type 'BEX_HEX': Bezier cells have control points"):
        ds.read(tmp_path / "spline.e")


UNIVERSAL = """    -1
  2411
{nodes}    -1
    -1
  2412
         1       112         1         1         7         6
         1         2         3         4         5         6
         2       111         1         1         7         4
         1         3         2         7
         3        91         1         1         7         3
         4         5         6
    -1
    -1
  2467
         1         0         0         0         0         0         0         1
outlet
         8         3         0         0
         2         0         0         0         0         0         0         2
all
         8         1         0         0         8         2         0         0
         3         0         0         0         0         0         0         1
tip
         8         2         0         0
    -1
"""


def test_groups_of_universal_files(tmp_path: pathlib.Path) -> None:
    nodes = "".join(f"{i:10}{1:10}{1:10}{11:10}\n" + "".join(f"{x:25.16E}".replace("E", "D") for x in point) + "\n" for i, point in enumerate(POINTS, 1))
    (tmp_path / "two.unv").write_text(UNIVERSAL.format(nodes=nodes))
    with ds.read(tmp_path / "two.unv") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.notes == ()
        assert sizes(environment) == {"outlet": 1} and environment.mark_region("tip")[0] == 1 and environment.mark_region("all")[0] == 2


GAMBIT = """        CONTROL INFO 2.4.6
** GAMBIT NEUTRAL FILE
two
PROGRAM:                Gambit     VERSION:  2.4.6
     NUMNP     NELEM     NGRPS    NBSETS     NDFCD     NDFVL
        13         3         2         1         3         3
ENDOFSECTION
   NODAL COORDINATES 2.4.6
{nodes}ENDOFSECTION
      ELEMENTS/CELLS 2.4.6
       1  4  8        1       2       4       3       5       6       8
                      7
       2  7  5        5       6       8       7       9
       3  6  4       10      11      12      13
ENDOFSECTION
       ELEMENT GROUP 2.4.6
GROUP:          1 ELEMENTS:          2 MATERIAL:          2 NFLAGS:          1
                           fluid
       0
       1       2
ENDOFSECTION
       ELEMENT GROUP 2.4.6
GROUP:          4 ELEMENTS:          1 MATERIAL:          2 NFLAGS:          1
                           solid
       0
       3
ENDOFSECTION
 BOUNDARY CONDITIONS 2.4.6
                       main inlet       1       2       0       6
         1    4    5
         3    6    1
ENDOFSECTION
"""


def test_groups_and_boundary_conditions_of_gambit(tmp_path: pathlib.Path) -> None:
    (tmp_path / "two.neu").write_text(GAMBIT.format(nodes=lines([*CUBE, (0.5, 0.5, 2), *(TETRA + (5, 0, 0))])))
    with ds.read(tmp_path / "two.neu") as environment:
        assert volume_of(environment) == pytest.approx(1 + 1 / 3 + 1 / 6) and environment.notes == ()
        assert environment.region_names == {"fluid": 1, "solid": 4} and sizes(environment) == {"main inlet": 2}
        heights = [environment.points()[environment.vertices(face)["index"]][:, 2].max() for face in environment.faces("main inlet")]
        assert heights == [0, 0]


KRATOS = """Begin ModelPartData
End ModelPartData
Begin Properties 3
 DENSITY 1
End Properties
Begin Nodes
{nodes}End Nodes
Begin Elements SmallDisplacementElement3D6N // the shaft
  1 3 1 2 3 4 5 6
End Elements
Begin Elements SmallDisplacementElement3D4N
  2 5 1 3 2 7
End Elements
Begin Conditions SurfaceLoadCondition3D3N
  1 0 4 5 6
End Conditions
Begin Conditions PointLoadCondition3D1N
  2 0 7
End Conditions
Begin SubModelPart Structure
  Begin SubModelPartElements
  1
  2
  End SubModelPartElements
  Begin SubModelPart Tip
    Begin SubModelPartElements
    2
    End SubModelPartElements
  End SubModelPart
End SubModelPart
Begin SubModelPart Outlet
  Begin SubModelPartConditions
  1
  End SubModelPartConditions
End SubModelPart
"""


def test_sub_model_parts_of_kratos(tmp_path: pathlib.Path) -> None:
    (tmp_path / "two.mdpa").write_text(KRATOS.format(nodes=lines(POINTS)))
    with ds.read(tmp_path / "two.mdpa") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.regions() == [3, 5]
        assert environment.region_groups["Structure"] == (3, 5) and environment.region_names["Structure.Tip"] == 5
        assert sizes(environment) == {"Outlet": 1}


def test_markers_and_zones_of_su2(tmp_path: pathlib.Path) -> None:
    zone = "NDIME= 3\nNELEM= 2\n13 0 2 1 3 5 4 0\n10 0 2 1 6 1 % the tip\nNPOIN= 7\n{points}NMARK= 1\nMARKER_TAG= {name}\nMARKER_ELEMS= 1\n5 3 4 5\n"
    text = [zone.format(points="".join("%g %g %g\n" % tuple(p) for p in np.array(POINTS) + (shift, 0, 0)), name=f"out{shift}") for shift in (0, 5)]
    (tmp_path / "one.su2").write_text(text[0])
    with ds.read(tmp_path / "one.su2") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and sizes(environment) == {"out0": 1} and environment.notes == ()
    (tmp_path / "two.su2").write_text("NZONE= 2\nIZONE= 1\n" + text[0] + "IZONE= 2\n" + text[1])
    with ds.read(tmp_path / "two.su2") as environment:
        assert environment.region_names == {"zone 1": 1, "zone 2": 2} and sizes(environment) == {"out0": 1, "out5": 1}


def test_polygons_of_off(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("tetgen")
    faces = ["4 3 2 1 0", "4 4 5 6 7 255 0 0", "4 0 1 5 4", "4 1 2 6 5", "3 2 3 7", "3 2 7 6", "4 3 0 4 7"]
    points = "".join("%g %g %g\n" % tuple(p) for p in CUBE)
    for head in ("OFF\n# a cube\n8 7 0\n", "OFF 8 7 0\n"):
        (tmp_path / "cube.off").write_text(head + points + "\n".join(faces) + "\n")
        with ds.read(tmp_path / "cube.off") as environment:
            assert volume_of(environment) == pytest.approx(1) and "filled with tetrahedra" in environment.notes[0]
    (tmp_path / "cube.off").write_text("OFF\n8 7 0\n" + points)
    with pytest.raises(ds.MeshError, match="it has 0 of 7 faces"):
        ds.read(tmp_path / "cube.off")


def test_ucd_keeps_double_precision(tmp_path: pathlib.Path) -> None:
    third = 1 / 3  # VTK's reader rounds it to single precision
    points = "".join(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate((PRISM * third).tolist(), 1))
    (tmp_path / "one.ucd").write_text(f"6\t1\t0\t0\t0\n{points}1 9 prism 4 5 6 1 2 3\n")
    with ds.read(tmp_path / "one.ucd") as environment:
        assert environment.points().max() == third and volume_of(environment) == pytest.approx(0.5 * third**3, rel=1e-15)
        assert environment.regions() == [9] and environment.notes == ()


@pytest.mark.parametrize("ids", ["off", "given"])
def test_parts_of_ensight(tmp_path: pathlib.Path, ids: str) -> None:
    (tmp_path / "two.case").write_text("FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: two.geo\n")
    text = f"a mesh\nof two parts\nnode id {ids}\nelement id off\n"
    for number, name, points, kind, corners in ((1, "shaft", PRISM, "penta6", "1 2 3 4 5 6"), (2, "tip", np.array([*PRISM[:3], (0, 0, -1)]), "tetra4", "1 3 2 4")):
        numbers = "".join(f"{100 * number + i:10}\n" for i in range(len(points))) if ids == "given" else ""
        columns = "".join(f"{x:12.5e}\n" for column in np.asarray(points).T for x in column)
        row = "".join(f"{int(word):10}" for word in corners.split())
        text += f"part\n{number:10}\n{name}\ncoordinates\n{len(points):10}\n{numbers}{columns}{kind}\n{1:10}\n{row}\n"
    (tmp_path / "two.geo").write_text(text)
    with ds.read(tmp_path / "two.case") as environment:
        assert environment.info.volume_count == 2 and volume_of(environment) == pytest.approx(0.5 + 1 / 6)
        assert sorted(environment.region_names) == ["shaft", "tip"] and environment.info.part_count == 1


def test_zones_of_tecplot(tmp_path: pathlib.Path) -> None:
    nodes = "".join("%g %g %g\n" % tuple(point) for point in TETRA)
    (tmp_path / "one.dat").write_text(f'TITLE = "one"\nVARIABLES = "X" "Y" "Z"\nZONE N=4, E=1, F=FEPOINT, ET=TETRAHEDRON\n{nodes}1 2 3 4\n')
    with ds.read(tmp_path / "one.dat") as environment:
        assert environment.info.volume_count == 1 and volume_of(environment) == pytest.approx(1 / 6)


@pytest.mark.parametrize(("ending", "kind"), [("xml", "dolfin-xml"), ("ele", "tetgen"), ("f3grid", "flac3d"), ("post", "permas"), ("b8.ugrid", "ugrid"), ("xdmf", "xdmf"), ("hmf", "hmf")])
def test_formats_of_meshio(tmp_path: pathlib.Path, ending: str, kind: str) -> None:
    path = tmp_path / f"two.{ending}"
    cells: list[tuple[str, Any]] = [("triangle", np.array([[0, 2, 1]]))] if kind == "ugrid" else []
    mesh = meshio.Mesh(np.array([*TETRA, (1, 1, 1.0)]), [*cells, ("tetra", np.array([[0, 1, 2, 3], [1, 2, 3, 4]]))])
    meshio.write(path, mesh, file_format=kind)
    with ds.read(path) as environment:
        assert environment.info.volume_count == 2 and volume_of(environment) == pytest.approx(1 / 6 + 1 / 3), kind
        assert environment.info.part_count == 1


def test_cells_of_the_plane_are_turned_but_not_folded_ones() -> None:
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    with ds.from_meshio(meshio.Mesh(np.array(square, float), [("triangle", [[0, 1, 2], [0, 3, 2]])])) as environment:
        assert volume_of(environment) == pytest.approx(1) and environment.notes == ("1 cells of type triangle were clockwise and have been turned",)
    folded = np.array([*square[:3], (0.9, 0.2)])  # the second triangle lies on the first
    with pytest.raises(ds.MeshError, match="1 of 2 cells of type triangle are inside out, the first is cell 1.*REORIENT"):
        ds.from_meshio(meshio.Mesh(folded, [("triangle", [[0, 1, 2], [0, 2, 3]])]))


def test_cells_with_points_at_one_place_are_opened() -> None:
    """A sector at an axis, as a cylindrical grid has it: its inner edge has two points at each height."""
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1), (0, 0, 1)], float)
    with ds.from_meshio(meshio.Mesh(points, [("hexahedron", [[0, 1, 2, 3, 4, 5, 6, 7]])])) as environment:
        assert volume_of(environment) == pytest.approx(0.5) and environment.volume_counts(environment.volume_id(0)).faces == 5
        assert "1 cells have several points at one place" in environment.notes[0]


def test_polygons_of_two_points_are_lines(tmp_path: pathlib.Path) -> None:
    pyvista = pytest.importorskip("pyvista")
    pyvista.PolyData(np.array(TETRA), faces=[2, 0, 1, 2, 1, 2]).save(tmp_path / "edges.vtp")
    with pytest.raises(ds.MeshError, match="it has 2 lines and points, but no cells that fill space"):
        ds.read(tmp_path / "edges.vtp")


def test_abaqus_names_the_included_file_that_is_missing(tmp_path: pathlib.Path) -> None:
    (tmp_path / "main.inp").write_text("*INCLUDE, INPUT=mesh.inc\n*STEP\n")
    with pytest.raises(ds.MeshError, match="it includes 'mesh.inc', which is not there"):
        ds.read(tmp_path / "main.inp")
    (tmp_path / "mesh.inc").write_text("*NODE\n1, 0, 0\n2, 1.,\n3, 0, 1\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4, ELSET=all\n1, 1, 2, 3, 4,\n")
    with ds.read(tmp_path / "main.inp") as environment:
        assert volume_of(environment) == pytest.approx(1 / 6) and environment.mark_region("all")[0] == 1


def test_cells_that_are_in_a_file_once_for_each_group_are_kept_once() -> None:
    """Version 2 of Gmsh's format has one group for each element, so one in two groups is there twice."""
    points = np.array([*TETRA, (1, 1, 1.0)])
    rows = np.array([[0, 1, 2, 3], [1, 2, 3, 4], [0, 1, 2, 3]])
    mesh = meshio.Mesh(points, [("tetra", rows)], cell_sets={"all": [np.array([0, 1])], "lumen": [np.array([2])]})
    with ds.from_meshio(mesh) as environment:
        assert environment.info.volume_count == 2 and "1 cells are in the file again" in environment.notes[0]
        assert environment.mark_region("lumen")[0] == 1 and environment.mark_region("all")[0] == 2
    with pytest.raises(ds.MeshError, match="lie on the same side of a face"):
        ds.from_meshio(meshio.Mesh(points, [("tetra", [[0, 1, 2, 3], [0, 1, 2, 4]])]))


def test_blank_lines_in_netgen_and_two_dimensions_of_kratos(tmp_path: pathlib.Path) -> None:
    (tmp_path / "one.vol").write_text("mesh3d\n\nsurfaceelements\n0\n\nvolumeelements\n1\n\n# part np nodes\n1 4 1 3 2 4\n\npoints\n4\n\n0 0 0\n\n1 0 0\n0 1 0\n0 0 1\n")
    with ds.read(tmp_path / "one.vol") as environment:
        assert volume_of(environment) == pytest.approx(1 / 6)
    nodes = lines(CUBE[:4])
    (tmp_path / "one.mdpa").write_text(f"Begin Nodes\n{nodes}End Nodes\nBegin Elements Element2D4N\n1 0 1 2 3 4\nEnd Elements\nBegin Conditions LineCondition2D2N\n1 0 1 2\nEnd Conditions\n")
    with ds.read(tmp_path / "one.mdpa") as environment:
        assert environment.dimension == 2 and volume_of(environment) == pytest.approx(1)
