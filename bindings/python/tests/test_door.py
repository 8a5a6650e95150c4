"""One door for all meshes: which library reads a file, what an error says, and cells that are inside out."""

from __future__ import annotations

import gzip
import pathlib
import subprocess
import sys

import meshio
import numpy as np
import pytest

import dartsweep as ds
import unsafe_reader
from dartsweep._door import apart, build, files, raw, table
from volumes import CUBE, PRISM, TETRA, box, content, volume_of

DOCS = pathlib.Path(__file__).parents[2] / "docs" / "meshes.md"


def grid_of_tetrahedra(turned: list[int] | None = None) -> meshio.Mesh:
    points, cells = box()
    ways = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
    tetrahedra = np.concatenate([cells[:, way] for way in ways])
    for cell in turned or []:
        tetrahedra[cell, [1, 2]] = tetrahedra[cell, [2, 1]]
    return meshio.Mesh(points, [("tetra", tetrahedra)])


def test_the_table_of_the_docs_is_the_one_of_the_code() -> None:
    part = DOCS.read_text().partition("## Which library reads what")[2].partition("\n## ")[0]
    rows = [line for line in part.splitlines() if line.startswith("| ")][2:]
    assert rows == [
        f"| {dialect.name} | {' '.join(f'`{ending}`' for ending in dialect.endings)} "
        f"| {', then '.join(dict.fromkeys(table.LIBRARIES[reader.library][2] for reader in dialect.readers))} | {dialect.kept} |"
        for dialect in table.DIALECTS
    ]


def test_read_has_two_names_and_takes_packed_files(tmp_path: pathlib.Path) -> None:
    mesh = grid_of_tetrahedra()
    plain = tmp_path / "vessel.vtu"
    mesh.write(plain)
    with gzip.open(tmp_path / "vessel.vtu.gz", "wb") as packed:
        packed.write(plain.read_bytes())
    with ds.read(plain) as a, ds.meshes.read(str(tmp_path / "vessel.vtu.gz")) as b:
        assert content(a) == content(b) and a.notes == b.notes == ()
        assert volume_of(a) == pytest.approx(6)
    (tmp_path / "torn.vtu.gz").write_bytes((tmp_path / "vessel.vtu.gz").read_bytes()[:100])
    with pytest.raises(ds.MeshError, match=r"torn.vtu.gz.*can't be unpacked"):
        ds.read(tmp_path / "torn.vtu.gz")


def test_errors_name_the_file_what_was_found_and_a_way_on(tmp_path: pathlib.Path, capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(FileNotFoundError, match="nothing.vtu"):
        ds.read(tmp_path / "nothing.vtu")
    for name, text, found in (
        ("mesh.xyz", "x", "the ending '.xyz' is not known"),
        ("mesh.mesh", "What is this?", "its first bytes are not those of .*MFEM.*Medit"),
        ("mesh.plt", "#!TDV112", "it is Tecplot's binary"),
        ("mesh.msh", 'MESH "part" dimension 3 ElemType Tetrahedra Nnode 4\nCoordinates\n', "it is not as GiD writes it .it ends early"),
        ("mesh.vtu", "<VTKFile", "VTK can't read it"),
        ("mesh.med", "\x89HDF but no more", "it is not as MED is written .*; Gmsh can't read it .*; meshio can't read it"),
        ("mesh.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=XYZ\n1, 1\n", "elements have the type 'XYZ'"),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "it is flat near"),
        ("mesh.e", "", "VTK can't read it"),
        ("mesh.mesh", "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n1\n1 77 0 1\n", "MFEM can't read it .*geom = 77"),
    ):
        path = tmp_path / name
        path.write_text(text, "latin-1")
        with pytest.raises(ds.MeshError, match=found) as caught:
            ds.read(path)
        assert caught.value.file == f"mesh '{path}'" and caught.value.way_on != "" and isinstance(caught.value, ValueError)
    assert capfd.readouterr().out == ""


def test_libraries_that_are_not_installed_are_named_with_their_extra(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "tetra.vtk"
    meshio.Mesh(TETRA, [("tetra", [[0, 1, 2, 3]])]).write(path)
    program = (
        "import sys\n"
        "for name in sys.argv[2:]: sys.modules[name] = None\n"
        "import dartsweep\n"
        "print(dartsweep.read(sys.argv[1]).notes)\n"
    )

    def without(*modules: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([sys.executable, "-c", program, str(path), *modules], capture_output=True, text=True, check=False)

    assert without().stdout == "()\n"
    assert "meshio read it; VTK loses less: pip install dartsweep[vtk]" in without("vtkmodules").stdout
    assert "needs VTK, which is not installed; pip install dartsweep[vtk]" in without("vtkmodules", "meshio").stderr


def test_types_of_which_all_cells_are_turned_are_turned_back() -> None:
    mesh = grid_of_tetrahedra()
    count = len(mesh.cells[0].data)
    with ds.from_meshio(mesh) as right, ds.from_meshio(grid_of_tetrahedra(list(range(count)))) as turned:
        assert turned.notes == (f"all {count} cells of type tetra were inside out and have been turned",) and right.notes == ()
        assert volume_of(turned) == pytest.approx(volume_of(right))
    for kind, points in (("hexahedron", CUBE), ("wedge", PRISM), ("pyramid", [*CUBE[:4], (0.5, 0.5, 1)])):
        below = np.array(points) * (1, 1, -1)
        with ds.from_meshio(meshio.Mesh(below, [(kind, [list(range(len(points)))])])) as turned:
            assert [kind in note for note in turned.notes] == [True]
            assert volume_of(turned) == pytest.approx({"hexahedron": 1, "wedge": 0.5, "pyramid": 1 / 3}[kind])
    with ds.from_meshio(meshio.Mesh(CUBE[:4], [("quad", [[3, 2, 1, 0]])])) as turned:
        assert turned.dimension == 2 and volume_of(turned) == 1 and len(turned.notes) == 1


def test_single_cells_that_are_turned_are_counted_and_the_flag_is_named() -> None:
    mesh = grid_of_tetrahedra([5, 7])
    count = len(mesh.cells[0].data)
    with pytest.raises(ds.MeshError, match=f"2 of {count} cells of type tetra are inside out, the first is cell 5.*REORIENT"):
        ds.from_meshio(mesh)
    with ds.from_meshio(mesh, flags=ds.EnvironmentFlag.REORIENT) as mended, ds.from_meshio(grid_of_tetrahedra()) as right:
        assert volume_of(mended) == pytest.approx(volume_of(right))


def test_cells_that_name_a_point_twice_are_polyhedra_of_the_faces_that_are_left() -> None:
    mesh = meshio.Mesh(PRISM, [("hexahedron", [[0, 1, 2, 2, 3, 4, 5, 5]])])
    with ds.from_meshio(mesh) as wedge:
        assert volume_of(wedge) == pytest.approx(0.5) and wedge.volume_counts(wedge.volume_id(0)).faces == 5
        assert wedge.notes == ("1 cells name a point twice; they are polyhedra of the faces that are left",)


def test_every_reader_that_can_read_a_file_gives_the_same_mesh(tmp_path: pathlib.Path) -> None:
    """The first of the table loses least, the others stand in where that is not installed."""
    points, cells = box()
    wedges = np.concatenate([cells[:, [0, 1, 2, 4, 5, 6]], cells[:, [0, 2, 3, 4, 6, 7]]])
    for ending, kind, rows in (("vtk", "wedge", wedges), ("msh", "wedge", wedges), ("bdf", "wedge", wedges), ("mesh", "hexahedron", cells)):
        path = tmp_path / f"vessel.{ending}"
        meshio.Mesh(points, [(kind, rows)], cell_data={"medit:ref": [np.arange(len(rows))]} if ending == "mesh" else {}).write(
            path, **({"file_format": "gmsh"} if ending == "msh" else {})
        )
        ways = [reader for dialect in table.dialects_of(str(path)) for reader in dialect.readers]
        assert len(ways) > 1
        if ending == "bdf":  # Gmsh leaves out half of what meshio writes, without a word
            with pytest.raises(ds.MeshError, match="Gmsh keeps 8 of 16 elements"):
                files._raw(str(path), "the file", ways.pop(0), "corners")
        meshes = [raw.mesh_of(files._raw(str(path), "the file", reader, "corners")) for reader in ways]
        assert all(len(mesh.types) == len(rows) for mesh in meshes)
        made = [build.environment_of(mesh, None, {}) for mesh in meshes]
        assert [volume_of(each) for each in made] == pytest.approx([6] * len(ways))


@pytest.mark.cold
@pytest.mark.parametrize(
    ("word", "found"),
    [("exit", r"VTK has crashed \(.*exit code 3\)"), ("crash", r"VTK has crashed \(.*SIGKILL\)"), ("loop", "VTK had not read it after 3 s"), ("odd", "KeyError: 'odd'")],
)
def test_readers_that_crash_or_do_not_end_are_errors(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str], word: str, found: str
) -> None:
    monkeypatch.setitem(files._READERS, "vtk", unsafe_reader)
    if word == "loop":  # the others get a minute of processor time: a busy machine takes seconds for the start
        monkeypatch.setattr(apart, "SECONDS", 2.0)
    path = tmp_path / "mesh.cgns"
    path.write_text(word)
    with pytest.raises(ds.MeshError, match=found) as caught:
        ds.read(path)
    assert caught.value.file == f"mesh '{path}'" and caught.value.way_on != ""
    assert capfd.readouterr() == ("", "")


def test_what_no_reader_expects_is_an_error_about_the_file(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(files._READERS, "su2", unsafe_reader)
    (tmp_path / "mesh.su2").write_text("odd")
    with pytest.raises(ds.MeshError, match=r"mesh.su2': NumPy can't read it \(KeyError 'odd'\)"):
        ds.read(tmp_path / "mesh.su2")


def test_files_that_end_early_are_told(tmp_path: pathlib.Path) -> None:
    points = "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(TETRA, 1))
    (tmp_path / "short.ucd").write_text(f"4 2 0 0 0\n{points}1 1 tet 1 2 3 4\n")
    with pytest.raises(ds.MeshError, match="it ends after 5 of 6 points and cells"):  # VTK would read one cell
        ds.read(tmp_path / "short.ucd")
    rows = "".join(f"GRID,{i},,{x}.,{y}.,{z}.\n" for i, (x, y, z) in enumerate(np.array(TETRA, int).tolist(), 1))
    for end, count in (("ENDDATA\n", 0), ("", 1)):
        (tmp_path / "tetra.bdf").write_text(f"BEGIN BULK\n{rows}CTETRA,1,1,1,2,3,4\n{end}")
        with ds.read(tmp_path / "tetra.bdf") as environment:
            assert sum("has no ENDDATA" in note for note in environment.notes) == count
