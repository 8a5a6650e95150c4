"""Files of VTK and of the formats that VTK reads, by the installed release and by another."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
import sys
from typing import Any

import meshio
import numpy as np
import pytest
import pyvista

import dartsweep as ds
from dartsweep import plot
from releases import grids, main
from scenario import vessel
from volumes import CUBE, CUBE_FACES, PRISM, TETRA, content, volume_of

OTHER = os.environ.get("DARTSWEEP_OTHER_VTK", "")
VOLUMES = {"wedge": 0.5, "wedge15": 0.5, "polyhedron": 2.0, "prism": 1.5 * 3**0.5, "voxel": 1.0}


def by(release: str, what: str, folder: pathlib.Path) -> Any:
    """What another release of VTK writes or reads, in a process of its own."""
    path = os.pathsep.join([release, str(pathlib.Path(__file__).parent), os.environ.get("PYTHONPATH", "")])
    program = pathlib.Path(__file__).parent / "releases.py"
    done = subprocess.run(
        [sys.executable, str(program), what, str(folder)], env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout) if what == "read" else None


@pytest.mark.parametrize("name", VOLUMES)
@pytest.mark.parametrize("ending", ["vtu", "vtk"])
def test_cells_that_the_installed_vtk_writes_are_right(tmp_path: pathlib.Path, name: str, ending: str) -> None:
    main("write", tmp_path)
    (path,) = tmp_path.glob(f"{name}-*.{ending}")
    with ds.read(path, inner_walls=True) as environment, ds.from_pyvista(grids()[name], inner_walls=True) as direct:
        assert volume_of(environment) == pytest.approx(VOLUMES[name]) and content(environment) == content(direct)
        assert not any("inside out" in note for note in environment.notes)


@pytest.mark.skipif(not os.path.isdir(OTHER), reason="DARTSWEEP_OTHER_VTK names no folder with another release of VTK")
def test_two_releases_of_vtk_read_what_each_writes_as_the_same_environment(tmp_path: pathlib.Path, capsys: pytest.CaptureFixture[str]) -> None:
    main("write", tmp_path)
    by(OTHER, "write", tmp_path)
    other = by(OTHER, "read", tmp_path)
    main("read", tmp_path)
    own = json.loads(capsys.readouterr().out)
    assert own["version"] != other["version"] and len(own["read"]) == 20
    for name in own["read"]:
        kind, writer = name.rpartition(".")[0].split("-")
        if len(other["read"][name]) == 1 and kind == "polyhedron" and writer == own["version"]:
            continue  # an older release may refuse the polyhedra of a newer one, but says so
        for release in (own, other):
            volume, _, cells = release["read"][name]
            assert volume == pytest.approx(VOLUMES[kind]), (name, release["version"])
            assert cells[1] == own["read"][name][2][1], (name, release["version"])


def test_plot_has_wedges_as_the_installed_vtk_numbers_them(tmp_path: pathlib.Path) -> None:
    with ds.Environment(PRISM, [[0, 2, 1, 3, 5, 4]]) as wedge:
        made = plot.grid(wedge)
        assert made.compute_cell_sizes()["Volume"][0] == pytest.approx(0.5)
        made.save(tmp_path / "wedge.vtu")
        with ds.read(tmp_path / "wedge.vtu") as again:
            assert content(again) == content(wedge) and again.notes == ()


def test_structured_grids_images_and_surfaces_of_vtk(tmp_path: pathlib.Path) -> None:
    image = pyvista.ImageData(dimensions=(3, 4, 5), spacing=(0.5, 1, 2))
    image.cell_data["material"] = np.arange(24, dtype=np.int32) // 12
    for data, ending in (
        (image, "vti"),
        (image, "vtk"),
        (image.cast_to_rectilinear_grid(), "vtr"),
        (image.cast_to_rectilinear_grid(), "vtk"),
        (image.cast_to_structured_grid(), "vts"),
        (image.cast_to_structured_grid(), "vtk"),
    ):
        path = tmp_path / f"grid.{ending}"
        data.save(path)
        with ds.read(path) as environment:
            assert environment.info.volume_count == 24 and environment.info.part_count == 1
            assert volume_of(environment) == pytest.approx(1 * 3 * 8) and environment.regions() == [0, 1]
    plane = pyvista.Plane(i_resolution=3, j_resolution=2)
    plane.save(tmp_path / "plane.vtp")
    with ds.read(tmp_path / "plane.vtp") as environment:
        assert environment.dimension == 2 and environment.info.volume_count == 6 and volume_of(environment) == pytest.approx(1)


def test_pieces_and_blocks_are_sewn(tmp_path: pathlib.Path) -> None:
    halves = [pyvista.UnstructuredGrid({12: np.array([range(8)])}, CUBE + (shift, 0, 0)) for shift in (0, 1)]
    blocks = pyvista.MultiBlock({"lumen": halves[0], "tissue": halves[1]})
    blocks.save(tmp_path / "both.vtm")
    for made in (ds.from_pyvista(blocks), ds.read(tmp_path / "both.vtm")):
        with made as environment:
            assert environment.info.part_count == 1 and environment.info.vertex_count == 12
            assert environment.region_names == {"lumen": 1, "tissue": 2} and environment.mark_region("tissue")[0] == 1
    crack = pyvista.UnstructuredGrid({12: np.array([range(8), range(8, 16)])}, np.concatenate([CUBE, CUBE + (1, 0, 0)]))
    with ds.from_pyvista(pyvista.MultiBlock({"cracked": crack, "behind": halves[1].translate((1, 0, 0))}), inner_walls=True) as environment:
        assert environment.info.part_count == 2  # the lips of the crack stay apart


def test_ghost_cells_are_left_out_and_told() -> None:
    grid = pyvista.UnstructuredGrid({12: np.array([range(8), range(8, 16)])}, np.concatenate([CUBE, CUBE]))
    grid.cell_data["vtkGhostType"] = np.array([0, 1], np.uint8)
    with ds.from_pyvista(grid) as environment:
        assert environment.info.volume_count == 1 and "1 cells are hidden or belong to another piece" in environment.notes[0]


def test_polyhedra_that_are_not_closed_are_an_error() -> None:
    open_box = pyvista.UnstructuredGrid(
        np.array([26, 5, *(number for face in CUBE_FACES[:5] for number in (4, *face))]), [42], CUBE
    )
    with pytest.raises(ds.MeshError, match="the faces of polyhedron 0 do not close it"):
        ds.from_pyvista(open_box)


def test_vtkhdf_and_other_compressors(tmp_path: pathlib.Path) -> None:
    from vtkmodules.vtkIOHDF import vtkHDFWriter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    points, cells, regions = vessel()
    grid = pyvista.UnstructuredGrid({12: np.asarray(cells)}, points)
    grid.cell_data["region"] = np.asarray(regions, np.int32)
    with ds.from_pyvista(grid) as direct:
        for writer, name in ((vtkHDFWriter(), "vessel.vtkhdf"), (vtkXMLUnstructuredGridWriter(), "vessel.vtu")):
            writer.SetInputData(grid)
            writer.SetFileName(str(tmp_path / name))
            if name.endswith("vtu"):
                writer.SetCompressorTypeToLZ4()
            writer.Write()
            with ds.read(tmp_path / name) as environment:
                assert content(environment) == content(direct)


def test_blocks_and_side_sets_of_exodus(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("netCDF4")
    meshio.Mesh([*PRISM, (0, 0, -1)], [("wedge", [[0, 1, 2, 3, 4, 5]]), ("tetra", [[0, 2, 1, 6]])]).write(tmp_path / "two.e")
    with ds.read(tmp_path / "two.e") as environment:
        assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.info.part_count == 1
        assert len(environment.region_names) == 2 and environment.notes == ()


def foam_case(folder: pathlib.Path) -> pathlib.Path:
    """Two cells: a prism and a tetrahedron below it, with patches and a zone of each kind."""
    mesh = folder / "constant" / "polyMesh"
    mesh.mkdir(parents=True)
    (folder / "system").mkdir()

    def write(name: str, kind: str, rows: list[str]) -> None:
        head = f"FoamFile\n{{\n version 2.0;\n format ascii;\n class {kind};\n object {name};\n}}\n"
        (mesh / name).write_text(head + f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n")

    faces = [[0, 2, 1], [1, 2, 5, 4], [3, 4, 5], [0, 3, 5, 2], [0, 1, 4, 3], [0, 1, 6], [1, 2, 6], [2, 0, 6]]
    write("points", "vectorField", ["(%g %g %g)" % tuple(point) for point in [*PRISM, (0, 0, -1)]])
    write("faces", "faceList", [f"{len(face)}({' '.join(map(str, face))})" for face in faces])
    write("owner", "labelList", list("00000111"))
    write("neighbour", "labelList", ["1"])
    write("boundary", "polyBoundaryMesh", ["outlet{type patch; nFaces 4; startFace 1;}", "inlet{type patch; nFaces 3; startFace 5;}"])
    write("cellZones", "regIOobject", ["tip\n{\n type cellZone;\ncellLabels List<label> \n1\n(\n1\n)\n;\n}"])
    write("faceZones", "regIOobject", ["baffle\n{\n type faceZone;\nfaceLabels List<label> \n1\n(\n0\n)\n;\nflipMap List<bool> 1(0);\n}"])
    head = "FoamFile\n{\n version 2.0;\n format ascii;\n class dictionary;\n object controlDict;\n}\n"
    (folder / "system" / "controlDict").write_text(head + "startFrom startTime; startTime 0; endTime 1; deltaT 1; writeInterval 1;\n")
    return folder


def test_cases_of_openfoam_keep_patches_and_zones(tmp_path: pathlib.Path) -> None:
    case = foam_case(tmp_path / "case")
    (case / "case.foam").touch()
    for path in (case, case / "case.foam"):
        with ds.read(path) as environment:
            assert volume_of(environment) == pytest.approx(0.5 + 1 / 6) and environment.info.volume_count == 2
            assert {"outlet", "inlet", "baffle"} <= set(environment.surface_names)
            assert len(environment.faces("inlet")) == 3 and environment.mark_region("tip")[0] == 1


def test_ucd_of_avs_has_its_pyramids_apex_first(tmp_path: pathlib.Path) -> None:
    points = "".join(f"{i} {x:g} {y:g} {z:g}\n" for i, (x, y, z) in enumerate([*CUBE[:4], (0.5, 0.5, 1.0), (0.5, 0.5, -1.0)], 1))
    (tmp_path / "two.inp").write_text(f"# UCD\n6 2 0 0 0\n{points}1 4 pyr 5 1 2 3 4\n2 7 pyr 6 4 3 2 1\n")
    with ds.read(tmp_path / "two.inp") as environment:
        assert volume_of(environment) == pytest.approx(2 / 3) and environment.regions() == [4, 7] and environment.notes == ()


def test_tetrahedra_of_pyvista_in_files_that_were_cut_are_errors(tmp_path: pathlib.Path) -> None:
    pyvista.UnstructuredGrid({10: np.array([[0, 1, 2, 3]])}, TETRA).save(tmp_path / "whole.vtu")
    whole = (tmp_path / "whole.vtu").read_bytes()
    (tmp_path / "cut.vtu").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ds.MeshError, match="cut.vtu.*VTK can't read it"):
        ds.read(tmp_path / "cut.vtu")


FLUENT = """(0 "two cubes side by side")
(2 3)
(10 (0 1 c 0 3))
(10 (1 1 c 1 3)(
{points}
))
(12 (0 1 2 0))
(12 (2 1 2 1 4))
(13 (0 1 b 0))
{faces}
(39 (2 fluid lumen)())
(39 (3 interior inside)())
(39 (4 velocity-inlet inlet)())
(39 (5 pressure-outlet outlet)())
(39 (6 wall wall)())
"""


@pytest.mark.parametrize("dialect", ["text", "mixed", "binary"])
def test_zones_of_fluent_are_regions_and_surfaces(dialect: str, tmp_path: pathlib.Path) -> None:
    def face(*places: tuple[int, int, int], cells: str) -> str:
        return " ".join(f"{x + 3 * y + 6 * z + 1:x}" for x, y, z in reversed(places)) + f" {cells}"

    sides = {3: [face((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1), cells="1 2")], 4: [face((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0), cells="1 0")]}
    sides |= {5: [face((2, 0, 0), (2, 1, 0), (2, 1, 1), (2, 0, 1), cells="2 0")], 6: []}
    for k in (0, 1):
        for side in (
            ((k, 0, 0), (k, 1, 0), (k + 1, 1, 0), (k + 1, 0, 0)), ((k, 0, 1), (k + 1, 0, 1), (k + 1, 1, 1), (k, 1, 1)),
            ((k, 0, 0), (k + 1, 0, 0), (k + 1, 0, 1), (k, 0, 1)), ((k, 1, 0), (k, 1, 1), (k + 1, 1, 1), (k + 1, 1, 0)),
        ):  # fmt: skip
            sides[6].append(face(*side, cells=f"{k + 1} 0"))
    points = "\n".join(f"{x} {y} {z}" for z in (0, 1) for y in (0, 1) for x in (0, 1, 2))
    text, first = "", 1
    for (zone, rows), kind in zip(sides.items(), ("2", "a", "5", "3")):
        head = f"{zone:x} {first:x} {first + len(rows) - 1:x} {kind} {0 if dialect == 'mixed' else 4}"
        if dialect == "binary":
            numbers = np.array([[int(word, 16) for word in row.split()] for row in rows], "<i4").tobytes().decode("latin-1")
            text += f"(2013 ({head})({numbers})\nEnd of Binary Section   2013)\n"
        else:
            text += f"(13 ({head})(\n" + "\n".join("4 " * (dialect == "mixed") + row for row in rows) + "\n))\n"
        first += len(rows)
    (tmp_path / "two.cas").write_bytes(FLUENT.format(points=points, faces=text).encode("latin-1"))
    with ds.read(tmp_path / "two.cas") as environment:
        assert environment.info.volume_count == 2 and environment.info.part_count == 1 and volume_of(environment) == pytest.approx(2)
        assert environment.mark_region("lumen", mark=False)[0] == 2 and set(environment.region_groups) == {"lumen"}
        assert {name: len(environment.faces(name)) for name in environment.surface_names} == {"inlet": 1, "outlet": 1, "wall": 8}
        assert environment.surfaces_of(environment.cast((0.5, 0.5, 0.5), (3, 0.5, 0.5)).contact.wall)[1] == "outlet" and not environment.notes
    (tmp_path / "short.msh").write_text(FLUENT.format(points=points, faces="(13 (4 1 b 3 4)(\n1 2 3 4 1 0\n))"))
    with pytest.raises(ds.MeshError, match="short.msh"):  # meshio would make a surface of it, which could be filled
        ds.read(tmp_path / "short.msh")


def test_a_mesh_of_fluent_in_the_plane(tmp_path: pathlib.Path) -> None:
    """Two squares. The cells beside the wall are in VTK's block of the wall, too."""
    (tmp_path / "plane.msh").write_text(
        "(0 comment)\n(2 2)\n(10 (0 1 6 0 2))\n(10 (1 1 6 1 2)(\n0 0\n1 0\n2 0\n0 1\n1 1\n2 1\n))\n(12 (0 1 2 0))\n(12 (2 1 2 1 3))\n(13 (0 1 7 0))\n"
        "(13 (3 1 1 2 2)(\n2 5 2 1\n))\n(13 (4 2 6 3 2)(\n2 1 1 0\n3 2 2 0\n5 6 2 0\n4 5 1 0\n1 4 1 0\n))\n(13 (5 7 7 5 2)(\n6 3 2 0\n))\n"
        "(45 (2 fluid air)())\n(45 (3 interior inside)())\n(45 (4 wall wall)())\n(45 (5 pressure-outlet outlet)())\n"
    )
    with ds.read(tmp_path / "plane.msh") as environment:
        assert environment.info.dimension == 2 and environment.info.volume_count == 2 and volume_of(environment) == pytest.approx(2)
        assert environment.mark_region("air", mark=False)[0] == 2
        assert {name: len(environment.faces(name)) for name in environment.surface_names} == {"wall": 5, "outlet": 1}
