"""Surfaces of CGNS files: boundary conditions of every type, in HDF5 and in ADF, by numbers of faces and by points."""

from __future__ import annotations

import pathlib
import sys
from typing import Any

import adf
import numpy as np
import pytest

import dartsweep as ds
from dartsweep._door import cgns_sides, cgns_tree

NAMES = ["left", "right", "front", "back", "low", "high"]


@pytest.fixture
def box(tmp_path: pathlib.Path) -> pathlib.Path:
    """A box of tetrahedra whose sides have names, by Gmsh."""
    gmsh = pytest.importorskip("gmsh")
    pytest.importorskip("vtkmodules")
    pytest.importorskip("h5py")
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5)
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [1], 7, "lumen")
        for i, name in enumerate(NAMES, 1):
            gmsh.model.addPhysicalGroup(2, [i], 10 + i, name)
        gmsh.model.mesh.generate(3)
        gmsh.write(str(tmp_path / "box.cgns"))
    finally:
        gmsh.finalize()
    return tmp_path / "box.cgns"


def _sides(made: ds.Environment) -> dict[str, int]:
    """How many faces of each surface lie where its name says."""
    where = {"left": (0, 0), "right": (0, 1), "front": (1, 0), "back": (1, 1), "low": (2, 0), "high": (2, 1)}
    counts, points = {}, made.points()
    for name in made.surface_names:
        axis, at = where[name]
        faces = made.faces(name)
        counts[name] = len(faces)
        assert all(np.all(points[made.vertices(face)["index"], axis] == at) for face in faces)
    return counts


def _number(array: Any) -> Any:
    return np.asarray(array).astype(np.int64)


def _edit(path: pathlib.Path, change: Any) -> None:
    import h5py

    with h5py.File(path, "r+") as file:
        base = next(child for child in file.values() if isinstance(child, h5py.Group) and child.attrs.get("label") == b"CGNSBase_t")
        zone = next(child for child in base.values() if isinstance(child, h5py.Group) and child.attrs.get("label") == b"Zone_t")
        change(base, zone)


def _set(group: Any, name: str, label: bytes, values: Any) -> None:
    """A node in place of the one of that name."""
    if name in group:
        del group[name]
    made = group.create_group(name)
    made.attrs["label"] = np.bytes_(label)
    made.create_dataset(" data", data=values)


def _bytes(word: str) -> Any:
    return np.frombuffer(word.encode(), np.int8)


def test_names_of_all_sides_are_kept(box: pathlib.Path) -> None:
    with ds.read(box) as made:
        counts = _sides(made)
        assert list(counts) == NAMES and sum(counts.values()) == made.info.boundary_face_count
        assert any("'lumen' names no faces" in note for note in made.notes)


@pytest.mark.parametrize("kind", ["BCInflow", "BCOutflow", "BCWall", "UserDefined", "FamilySpecified"])
def test_the_type_of_a_condition_does_not_matter(kind: str, box: pathlib.Path) -> None:
    def change(_: Any, zone: Any) -> None:
        for condition in zone["ZoneBC"].values():
            del condition[" data"]
            condition.create_dataset(" data", data=_bytes(kind))

    _edit(box, change)
    with ds.read(box) as made:
        assert list(_sides(made)) == NAMES


def test_conditions_by_points_name_the_faces_between_them(box: pathlib.Path) -> None:
    def change(_: Any, zone: Any) -> None:
        sections = {int(section["ElementRange"][" data"][0]): section for section in zone.values() if section.attrs.get("label") == b"Elements_t"}
        del zone["ZoneBC"]["V_1"]  # all points: it would name all faces
        for condition in zone["ZoneBC"].values():
            first = int(_number(condition["PointRange"][" data"]).ravel()[0])
            del condition["PointRange"], condition["GridLocation"]
            points = np.unique(sections[first]["ElementConnectivity"][" data"][()])
            _set(condition, "PointList", b"IndexArray_t", points.astype(np.int32)[:, None])

    _edit(box, change)
    with ds.read(box) as made:
        assert sum(_sides(made).values()) == made.info.boundary_face_count


def test_sections_that_no_condition_names_keep_their_own_names(box: pathlib.Path) -> None:
    def change(_: Any, zone: Any) -> None:
        del zone["ZoneBC"]
        for old in [name for name, child in zone.items() if name.startswith("3_S_")]:
            zone.move(old, NAMES[int(old[-1]) - 1])

    _edit(box, change)
    with ds.read(box) as made:
        assert sorted(_sides(made)) == sorted(NAMES) and made.notes == ()


@pytest.mark.parametrize("is_hexadecimal", [True, False])
def test_files_in_adf_keep_their_names(is_hexadecimal: bool, box: pathlib.Path, tmp_path: pathlib.Path) -> None:
    import h5py

    with h5py.File(box) as file:
        adf.write(file, tmp_path / "old.cgns", is_hexadecimal)
    with ds.read(tmp_path / "old.cgns") as made, ds.read(box) as same:  # VTK reads the cells of both
        assert made.info.volume_count == same.info.volume_count
        assert _sides(made) == _sides(same)


def test_a_damaged_tree_loses_names_but_tells(box: pathlib.Path) -> None:
    def change(_: Any, zone: Any) -> None:
        del zone["3_S_1"]["ElementRange"]

    _edit(box, change)
    try:
        with ds.read(box) as made:
            assert made.surface_names or any("can't be read" in note for note in made.notes)
    except ds.MeshError as error:
        assert "box.cgns" in str(error)


def test_without_h5py_a_note_tells(box: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from dartsweep._door import vtk_files

    monkeypatch.setitem(sys.modules, "h5py", None)
    sides = vtk_files._sides_of_cgns(str(box))
    assert sides is not None and sides[0] == [] and "h5py" in sides[1][0]


def _node(label: str, values: Any = None, **children: Any) -> Any:
    from dartsweep._door.cgns_tree import Node

    inner = []
    for name, child in children.items():
        child.name = name
        inner.append(child)
    return Node("", label, inner, lambda: None if values is None else np.asarray(values))


@pytest.mark.parametrize("has_starts", [True, False])
def test_faces_of_polyhedra_and_mixed_sections(has_starts: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    faces = [[1, 2, 3], [1, 2, 4], [1, 2, 5, 6, 7]]
    flat = [n for face in faces for n in ([] if has_starts else [len(face)]) + face]
    polygons = {"ElementRange": _node("", [1, 3]), "ElementConnectivity": _node("", flat)}
    if has_starts:
        polygons["ElementStartOffset"] = _node("", [0, 3, 6, 11])
    mixed = {"ElementRange": _node("", [4, 6]), "ElementConnectivity": _node("", [10, 1, 2, 3, 4, 7, 1, 2, 3, 4, 5, 3, 2, 1])}
    some = _node("BC_t", None, PointList=_node("", [1, 3]), GridLocation=_node("", _bytes("FaceCenter")))
    zone = _node(
        "Zone_t",
        None,
        ZoneType=_node("", _bytes("Unstructured")),
        polygons=_node("Elements_t", [22, 0], **polygons),
        mixed=_node("Elements_t", [20, 0], **mixed),
        ZoneBC=_node("ZoneBC_t", None, outlet=some),
    )
    base = _node("CGNSBase_t", [3, 3])
    monkeypatch.setattr(cgns_tree, "zones", lambda path: [(base, zone)])
    found = cgns_sides.sides_of("")
    assert found is not None
    sides = {name: [corners[a:b].tolist() for a, b in zip(offsets, offsets[1:])] for name, offsets, corners in found[0][0][1]}
    assert sides == {"outlet": [[0, 1, 2], [0, 1, 4, 5, 6]], "mixed": [[0, 1, 2, 3], [2, 1, 0]]}


def test_points_that_are_not_rectangular_are_told(box: pathlib.Path) -> None:
    def turn(base: Any, zone: Any) -> None:
        grid = zone["GridCoordinates"]
        for old, new in (("X", "R"), ("Y", "Theta")):
            grid.move(f"Coordinate{old}", f"Coordinate{new}")
            grid[f"Coordinate{new}"].attrs["name"] = np.bytes_(f"Coordinate{new}".ljust(33, "\0"))

    _edit(box, turn)
    with pytest.raises(ds.MeshError, match="its points are given by CoordinateR, CoordinateTheta, CoordinateZ, which VTK leaves out"):
        ds.read(box)
