"""Surfaces as the usual programs write them, and surfaces that have to be repaired."""

from __future__ import annotations

import pathlib
import re
import struct
from collections.abc import Callable
from typing import Any

import meshio
import numpy as np
import pytest
import pyvista
import trimesh

import dartsweep as ds
from test_surfaces import TUBE_VOLUME, Surface, ball, inside, together, tube, volumes, with_fin, with_point_at


def volume(filled: ds.surfaces.FilledSurface) -> float:
    return float(volumes(filled.points, filled.cells).sum())


# --- scanners: STL whose normals mean nothing


def scan(normal: Any, header: bytes = b"solid made by a scanner") -> bytes:
    points, triangles = tube()
    rows = b"".join(struct.pack("<12fH", *normal, *points[triangle].ravel(), 7) for triangle in triangles)
    return header.ljust(80) + struct.pack("<I", len(triangles)) + rows


@pytest.mark.parametrize("normal", [(0, 0, 0), (0, 0, -1), (float("nan"),) * 3, (9e30, 0, 0)])
def test_normals_of_scanners_do_not_count(tmp_path: pathlib.Path, normal: Any) -> None:
    """The header begins with "solid", as that of text does."""
    (tmp_path / "scan.stl").write_bytes(scan(normal))
    filled = ds.surfaces.fill(tmp_path / "scan.stl")
    assert volume(filled) == pytest.approx(TUBE_VOLUME, rel=1e-6) and filled.hole_count == 2 and filled.notes == ()


def test_text_of_several_solids(tmp_path: pathlib.Path) -> None:
    points, triangles = tube()
    lines = []
    for part in np.array_split(triangles, 2):
        lines.append("SOLID a part")
        for triangle in part:
            corners = [f"VERTEX {x:.9E} {y:.9E} {z:.9E}" for x, y, z in points[triangle]]
            lines += ["FACET NORMAL 0 0 0", "OUTER LOOP", *corners, "ENDLOOP", "ENDFACET"]
        lines.append("ENDSOLID a part")
    (tmp_path / "scan.stl").write_bytes("\r\n".join(lines).encode())
    assert volume(ds.surfaces.fill(tmp_path / "scan.stl")) == pytest.approx(TUBE_VOLUME, rel=1e-6)


# --- 3D Slicer and vmtk: PolyData of triangles, quads and strips


def slicer() -> pyvista.PolyData:
    points, _ = tube()
    a = np.arange(8 * 12)
    b = a // 12 * 12 + (a + 1) % 12
    made = pyvista.PolyData(points, np.stack([np.full(96, 4), a, b, b + 12, a + 12], axis=1).ravel())
    made.cell_data["CellEntityIds"] = np.ones(made.n_cells, np.int32)
    made.point_data["Normals"] = np.zeros((made.n_points, 3))
    return made


@pytest.mark.parametrize("name", ["quads.vtp", "quads.vtk", "quads.ply", "strips.vtp", "triangles.vtp"])
def test_polydata_of_files(tmp_path: pathlib.Path, name: str) -> None:
    data = slicer()
    {"quads": data, "triangles": data.triangulate(), "strips": data.triangulate().strip()}[name.partition(".")[0]].save(tmp_path / name)
    filled = ds.surfaces.fill(tmp_path / name)
    assert volume(filled) == pytest.approx(TUBE_VOLUME, rel=1e-6) and filled.hole_count == 2
    assert (~filled.is_cap).sum() == 2 * 96


def test_polydata_of_pyvista_and_vtk() -> None:
    vtk = pytest.importorskip("vtk")
    raw = vtk.vtkPolyData()
    raw.ShallowCopy(slicer())
    for data in (slicer(), raw):
        assert volume(ds.surfaces.fill(data)) == pytest.approx(TUBE_VOLUME, rel=1e-6)


def test_files_of_vtk_without_a_surface(tmp_path: pathlib.Path) -> None:
    pyvista.PolyData(np.zeros((3, 3))).save(tmp_path / "points.vtp")
    pyvista.ImageData(dimensions=(2, 2, 2)).cast_to_unstructured_grid().save(tmp_path / "volumes.vtk")
    (tmp_path / "text.vtp").write_text("hello")
    for name, message in (("points.vtp", "no triangles"), ("volumes.vtk", "volume cells; dartsweep.meshes.read"), ("text.vtp", "PyVista can't read it")):
        with pytest.raises(ds.surfaces.SurfaceError, match=f"^surface '.*{name}': .*{message}"):
            ds.surfaces.fill(tmp_path / name)


# --- Blender: quads and polygons, also such that are not convex

L = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])


def l_shape() -> tuple[Any, list[list[int]]]:
    """A prism over an L. Fans of its ends from their first corners fold over themselves."""
    corners = np.concatenate([np.insert(L, 2, z, axis=1) for z in (0, 1)])
    sides = [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    return corners, [[1, 0, 5, 4, 3, 2], [7, 8, 9, 10, 11, 6], *sides]


def write_obj(path: pathlib.Path, corners: Any, faces: list[list[int]]) -> None:
    lines = ["# Blender", "mtllib l.mtl", "o L", *("v {:f} {:f} {:f}".format(*corner) for corner in corners), "vt 0 0", "vn 0 0 1", "s off"]
    path.write_text("\n".join([*lines, *("f " + " ".join(f"{i + 1}/1/1" for i in face) for face in faces)]) + "\n")


def write_ply(path: pathlib.Path, corners: Any, faces: list[list[int]]) -> None:
    head = ["ply", "format binary_little_endian 1.0", "comment Blender", f"element vertex {len(corners)}"]
    head += [f"property float {axis}" for axis in "xyz"]
    head += [f"element face {len(faces)}", "property list uchar uint vertex_indices", "end_header", ""]
    body = np.asarray(corners, "<f4").tobytes() + b"".join(struct.pack(f"<B{len(face)}I", len(face), *face) for face in faces)
    path.write_bytes("\n".join(head).encode() + body)


@pytest.mark.parametrize("write, name", [(write_obj, "l.obj"), (write_ply, "l.ply")])
def test_polygons_that_are_not_convex(tmp_path: pathlib.Path, write: Callable[..., None], name: str) -> None:
    write(tmp_path / name, *l_shape())
    filled = ds.surfaces.fill(tmp_path / name)
    assert volume(filled) == pytest.approx(3, rel=1e-12) and len(filled.wall) == 20


# --- CAD: long triangles, slivers, corners that differ by rounding


def cylinder(count: int = 48) -> Surface:
    """Its ends are fans of long triangles from one corner."""
    angles = 2 * np.pi * np.arange(count) / count
    ring = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    i = np.arange(count)
    j = (i + 1) % count
    sides = np.concatenate([np.stack([i, j, count + j], axis=1), np.stack([i, count + j, count + i], axis=1)])
    ends = np.stack([0 * i[1:-1], i[2:], i[1:-1]], axis=1)
    return np.concatenate([ring, ring + (0, 0, 4)]), np.concatenate([sides, ends, count + ends[:, ::-1]])


def box_with_sliver(height: float) -> Surface:
    """An edge of the box has another point on one side only; a flat triangle joins both."""
    box = trimesh.creation.box()
    points, triangles = np.array(box.vertices), np.array(box.faces)
    a, b, c = triangles[0]
    middle = (points[a] + points[b]) / 2 + height * np.array([1, 2, 3])
    k = len(points)
    return np.vstack([points, middle]), np.concatenate([triangles[1:], [(a, k, c), (k, b, c), (a, b, k)]])


def loose(surface: Surface, size: float) -> Surface:
    """Every triangle has corners of its own."""
    points, triangles = surface
    corners = points[triangles].reshape(-1, 3)
    return corners + np.random.default_rng(5).normal(size=corners.shape) * size, np.arange(len(corners)).reshape(-1, 3)


def test_long_triangles() -> None:
    surface = cylinder()
    assert volume(ds.surfaces.fill(surface)) == pytest.approx(inside(*surface), rel=1e-9)


REPAIRS: dict[str, tuple[Surface, float, dict[str, Any], str]] = {
    "crossing": (with_point_at(ball(), 0, (0.5, -0.9, 0.2)), 4.0, {}, r"MeshFix has taken away \d+ of 320 triangles, at \("),
    "fin": (with_fin(ball()), 4.0, {}, "1 edge has more than two triangles"),
    "flat sliver": (box_with_sliver(0.0), 1.0, {}, "MeshFix has taken away"),
    "thin sliver": (box_with_sliver(1e-7), 1.0, {}, "MeshFix has taken away"),
    "loose corners": (loose(cylinder(), 1e-9), 12.5, {}, "468 of 564 points lay nearer"),
    "in metres": (loose((cylinder()[0] * 1e-4, cylinder()[1]), 1e-13), 12.5e-12, {}, "468 of 564 points"),
    "small": ((with_point_at(ball(), 0, (0.5, -0.9, 0.2))[0] * 1e-5, ball()[1]), 4e-15, {}, "MeshFix has put in"),
}


@pytest.mark.parametrize("name", REPAIRS)
def test_repairs_say_what_they_change(name: str) -> None:
    surface, size, options, note = REPAIRS[name]
    with pytest.raises(ds.surfaces.SurfaceError, match="; repair=True may mend it$"):
        ds.surfaces.fill(surface, **options)
    filled = ds.surfaces.fill(surface, repair=True, **options)
    assert volume(filled) == pytest.approx(size, rel=0.1)
    assert filled.notes[0].startswith("the surface could not be filled: ")
    assert re.search(note, "; ".join(filled.notes)), filled.notes


def test_an_environment_tells_what_was_repaired() -> None:
    with ds.from_surface(with_point_at(ball(), 0, (0.5, -0.9, 0.2)), "tissue", repair=True) as environment:
        environment.check()
        assert len(environment.notes) == 3 and "could not be filled" in environment.notes[0]


def test_what_can_be_filled_is_not_repaired() -> None:
    filled, usual = ds.surfaces.fill(ball(), repair=True), ds.surfaces.fill(ball())
    assert filled.notes == () and np.array_equal(filled.cells, usual.cells) and np.array_equal(filled.points, usual.points)


def test_repairs_that_would_change_too_much_are_refused() -> None:
    with pytest.raises(ds.surfaces.SurfaceError, match=r"MeshFix would close .* at \(.*, and largest_hole is 0.1"):
        ds.surfaces.fill(with_point_at(ball(), 0, (0.5, -0.9, 0.2)), repair=True, largest_hole=0.1)
    with pytest.raises(ds.surfaces.SurfaceError, match=r"triangles cross others.*MeshFix would take away \d+ of 640 triangles"):
        ds.surfaces.fill(together(ball(), ball(1.0, 1.0)), parts="all", repair=True)


def test_walls_and_caps_are_surfaces() -> None:
    with ds.from_surface(tube()) as environment:
        assert environment.surface_names == {"wall": 1, "caps": 2} and len(environment.faces("caps")) == 24
        flights = environment.cast_segments([(0, 0, 3)] * 2, [(0, 0, 9), (9, 0.1, 3)])
        assert environment.surfaces_of(flights)["name"].tolist() == ["caps", "wall"]
    with ds.from_surface(ball(), "tissue") as environment:
        assert environment.surface_names == {"wall": 1}
        assert environment.surfaces_of(environment.cast((0, 0, 0), (3, 0, 0)))["name"] == "wall"


def test_crossings_are_named_by_places() -> None:
    balls = together(*(ball(1.0, 1.5 * i) for i in range(2)), *(ball(1.0, 20 + 1.5 * i) for i in range(2)))
    with pytest.raises(ds.surfaces.SurfaceError, match=r"of its triangles cross others, at \((0.7|20.7)\d*, .*\), .*\((0.7|20.7)\d*, .*\)"):
        ds.surfaces.fill(balls, parts="all")


def test_read_fills_all_parts_of_a_surface_and_tells_it(tmp_path: pathlib.Path) -> None:
    points, triangles = together(ball(2.0), ball(1.0), ball(1.0, 5.0))
    trimesh.Trimesh(points, triangles, process=False).export(tmp_path / "parts.stl")
    meshio.Mesh(points, [("triangle", triangles)]).write(tmp_path / "parts.vtu")
    for name in ("parts.stl", "parts.vtu"):
        with ds.read(tmp_path / name) as environment:
            assert "its 3 parts were all filled; a part that lies within another is a hole in it" in environment.notes
            assert [environment.locate((x, 0, 0))[1] for x in (0, 1.5, 5)] == [ds.Location.OUTSIDE, ds.Location.PASSABLE, ds.Location.PASSABLE]
        with ds.read(tmp_path / name, parts="largest") as environment:
            assert not any("parts" in note for note in environment.notes) and environment.locate((5, 0, 0))[1] == ds.Location.OUTSIDE
        with pytest.raises(ds.MeshError, match="it has 3 parts"):
            ds.read(tmp_path / name, parts="one")
