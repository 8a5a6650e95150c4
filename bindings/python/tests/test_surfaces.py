"""Surfaces that are filled: the tetrahedra, the environment they make, and what is said of surfaces that have no inside."""

from __future__ import annotations

import math
import os
import pathlib
import sys
from typing import Any

import meshio
import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

import dartsweep as ds

Surface = tuple[NDArray[np.float64], NDArray[np.int64]]

COUNT, RADIUS, LENGTH = 12, 1.0, 6.0
TUBE_VOLUME = COUNT / 2 * math.sin(2 * math.pi / COUNT) * RADIUS**2 * LENGTH


def tube() -> Surface:
    """A straight tube along z of 8 rings, open at both ends."""
    angles = 2 * np.pi * np.arange(COUNT) / COUNT
    ring = np.stack([RADIUS * np.cos(angles), RADIUS * np.sin(angles), 0 * angles], axis=1)
    points = np.concatenate([ring + (0, 0, z) for z in np.linspace(0, LENGTH, 9)])
    a = np.arange(8 * COUNT)
    b = a // COUNT * COUNT + (a + 1) % COUNT
    return points, np.concatenate([np.stack([a, b, b + COUNT], axis=1), np.stack([a, b + COUNT, a + COUNT], axis=1)])


def ball(radius: float = 1.0, x: float = 0.0, subdivisions: int = 2) -> Surface:
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions, radius=radius)
    return np.array(mesh.vertices) + (x, 0, 0), np.array(mesh.faces)


def together(*surfaces: Surface) -> Surface:
    starts = np.cumsum([0] + [len(points) for points, _ in surfaces])
    return np.concatenate([p for p, _ in surfaces]), np.concatenate([t + start for (_, t), start in zip(surfaces, starts)])


def opened_box() -> Surface:
    """A cube of side 1; the opening in its top has the form of a U, so no point sees all of its rim."""
    mesh = trimesh.creation.box().subdivide().subdivide().subdivide()
    middle = mesh.triangles_center
    is_open = (middle[:, 2] == 0.5) & (np.abs(middle[:, 0]) < 0.375) & (np.abs(middle[:, 1]) < 0.375)
    is_open &= (np.abs(middle[:, 0]) > 0.125) | (middle[:, 1] < -0.125)
    used, triangles = np.unique(mesh.faces[~is_open], return_inverse=True)
    return np.array(mesh.vertices)[used], triangles.reshape(-1, 3)


def pierced_ball() -> Surface:
    """A ball without triangles that share points, but no edges: each opening has three edges, and openings meet."""
    points, triangles = ball()
    is_free = np.ones(len(triangles), bool)
    removed = np.zeros(len(triangles), bool)
    for i, triangle in enumerate(triangles):
        if is_free[i]:
            removed[i] = True
            is_free[[len(set(triangle) & set(other)) > 1 for other in triangles]] = False
    return points, triangles[~removed]


def jagged_bowl() -> Surface:
    """Half a ball whose rim goes up and down."""
    points, triangles = ball()
    used, kept = np.unique(triangles[points[triangles].mean(axis=1)[:, 2] < 0.04], return_inverse=True)
    return points[used], kept.reshape(-1, 3)


def moebius_strip() -> Surface:
    angles = 2 * np.pi * np.arange(20) / 20
    middle = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    across = 0.3 * np.stack([np.cos(angles / 2) * np.cos(angles), np.cos(angles / 2) * np.sin(angles), np.sin(angles / 2)], axis=1)
    points = np.stack([middle - across, middle + across], axis=1).reshape(-1, 3)
    a = 2 * np.arange(20)
    c, d = np.append(a[1:], 1), np.append(a[1:] + 1, 0)
    return points, np.concatenate([np.stack([a, c, a + 1], axis=1), np.stack([a + 1, c, d], axis=1)])


def with_fin(surface: Surface) -> Surface:
    points, triangles = surface
    a, b, _ = triangles[7]
    return np.concatenate([points, [(0.0, 0.0, 3.0)]]), np.concatenate([triangles, [(a, b, len(points))]])


def with_point_at(surface: Surface, point: int, place: tuple[float, float, float]) -> Surface:
    points = surface[0].copy()
    points[point] = place
    return points, surface[1]


def volumes(points: NDArray[np.float64], cells: NDArray[np.int64]) -> NDArray[np.float64]:
    corners = points[cells]
    return np.asarray(np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6)


def inside(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> float:
    """The volume that a closed surface encloses, with normals that point out."""
    return float(np.linalg.det(points[triangles]).sum() / 6)


def of(mesh: trimesh.Trimesh) -> Surface:
    return np.array(mesh.vertices), np.array(mesh.faces)


def make(filled: ds.surfaces.FilledSurface) -> ds.Environment:
    return ds.Environment(filled.points, filled.cells, regions=filled.regions)


@pytest.mark.cold
def test_a_surface_of_a_file(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "ball.stl"
    trimesh.creation.icosphere(radius=2.0).export(path)
    with ds.from_surface(path, outside="tissue") as environment:
        flight = environment.cast((0, 0, 0), (0, 0, 4))
        assert flight.outcome == ds.Outcome.CONTACT and flight.position.tolist() == [0, 0, 2]
        assert flight.contact.tag == environment.region_names["tissue"]
        outside = environment.cast((0, 0, 3), (0, 0, 4))
        assert outside.outcome == ds.Outcome.IMPASSABLE and outside.time == 0


SOLIDS = {
    "ball": (ball(), 1, 0),
    "torus": (of(trimesh.creation.torus(3.0, 1.0)), 1, 0),
    "box": (of(trimesh.creation.box((1.0, 2.0, 3.0))), 1, 0),
    "tube": (tube(), 1, 2),
    "opened box": (opened_box(), 1, 1),
    "pierced ball": (pierced_ball(), 1, len(ball()[1]) - len(pierced_ball()[1])),
    "bowl": (jagged_bowl(), 1, 1),
    "two balls": (together(ball(), ball(0.5, 3.0)), 2, 0),
    "thick wall": (together(ball(), ball(0.5)), 2, 0),
    "nested": (together(ball(), ball(0.7), ball(0.3)), 3, 0),
}
EXACT = {
    "box": 6.0,
    "tube": TUBE_VOLUME,
    "opened box": 1.0,
    "pierced ball": inside(*ball()),
    "two balls": inside(*ball()) * (1 + 0.5**3),
    "thick wall": inside(*ball()) * (1 - 0.5**3),
    "nested": inside(*ball()) * (1 - 0.7**3 + 0.3**3),
}


@pytest.mark.parametrize("outside", ["nothing", "tissue"])
@pytest.mark.parametrize("name", SOLIDS)
def test_the_inside_is_filled_and_the_triangles_are_the_wall(name: str, outside: str) -> None:
    surface, part_count, hole_count = SOLIDS[name]
    filled = ds.surfaces.fill(surface, outside, parts="all")
    assert (filled.part_count, filled.hole_count) == (part_count, hole_count)
    points, triangles = surface
    assert np.array_equal(filled.points[: len(points)], points)
    assert np.array_equal(np.sort(filled.wall[~filled.is_cap]), np.sort(triangles))
    assert filled.is_cap.any() == (hole_count > 0)

    in_lumen = filled.regions == ds.surfaces.LUMEN
    assert set(filled.regions) == ({1, 2} if outside == "tissue" else {1})
    each = volumes(filled.points, filled.cells)
    assert each.min() > 0
    lumen = each[in_lumen].sum()
    assert lumen == pytest.approx(inside(filled.points, filled.wall), rel=1e-12)
    assert lumen == pytest.approx(EXACT.get(name, lumen), rel=1e-12)
    if outside == "tissue":
        size = np.ptp(filled.points, axis=0)
        assert each.sum() == pytest.approx(size.prod(), rel=1e-12)
        assert np.all(size > np.ptp(points, axis=0))

    with make(filled) as environment:
        environment.check()
        walls = environment.find_faces(np.arange(0, filled.wall.size + 1, 3), filled.wall.ravel())
        for wall in walls:
            both = [ds.surfaces.LUMEN, ds.surfaces.TISSUE]
            sides = [environment.region(volume) for volume in environment.face_volumes(wall) if volume.generation != 0]
            assert sorted(sides) == (both if outside == "tissue" else both[:1])


@pytest.mark.parametrize("outside", ["nothing", "tissue"])
def test_casts_meet_the_triangles(outside: str) -> None:
    """Rays from the middle through each triangle's centre; of a tube from the point of its axis beside it."""
    for surface in (ball(), tube()):
        filled = ds.surfaces.fill(surface, outside)
        wall = filled.wall[~filled.is_cap]
        corners = filled.points[wall]
        targets = corners.mean(axis=1)
        starts = targets * (0, 0, 1) if surface[0][:, 2].max() == LENGTH else np.zeros_like(targets)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        with ds.from_surface(surface, outside) as environment:
            faces = environment.find_faces(np.arange(0, wall.size + 1, 3), wall.ravel())
            flights = environment.cast_segments(starts, 2 * targets - starts)
            assert np.array_equal(flights["contact"]["wall"], faces)
            assert np.allclose(flights["time"], 0.5) and np.allclose(flights["position"], targets)
            assert np.allclose(flights["contact"]["normal"], -normals)  # into the lumen
            assert set(flights["contact"]["tag"]) == {2 if outside == "tissue" else 1}


def test_tissue_is_impassable() -> None:
    with ds.from_surface(tube(), "tissue", thickness=0.5) as environment:
        for index in range(environment.info.volume_count):
            volume = environment.volume_id(index)
            assert environment.is_impassable(volume) == (environment.region(volume) == environment.region_names["tissue"])
            assert environment.tag(volume) == environment.region(volume)
        flight = environment.cast((1.2, 0, 3), (5, 0, 3))
        assert flight.outcome == ds.Outcome.IMPASSABLE and flight.time == 0
        assert environment.info.lower.tolist() == pytest.approx([-1.5, -1.5, -0.5])
        assert environment.info.upper.tolist() == pytest.approx([1.5, 1.5, 6.5])


def test_tissue_can_be_deformed_and_cut() -> None:
    with ds.from_surface(tube(), "tissue") as environment, ds.Scene(environment, ds.Feature.DEFORMING):
        count = environment.info.vertex_count
        positions = np.concatenate([environment.points(), np.zeros((4 * count, 3))])  # with room for vertices of the cut
        positions[:count, 0] += 0.1 * np.sin(positions[:count, 2])
        targets = positions.copy()
        environment.deform(positions)
        assert np.array_equal(environment.points()[:count], targets[:count])
        change = environment.cut([[(-9.0, -9.0, 2.9), (9.0, -9.0, 2.9)], [(-9.0, 9.0, 3.1), (9.0, 9.0, 3.1)]])
        assert {environment.region(volume) for volume in change.volumes["after"]} == {ds.surfaces.LUMEN, ds.surfaces.TISSUE}


def test_options() -> None:
    points, triangles = ball(subdivisions=3)
    usual = ds.surfaces.fill((points, triangles))
    fine = ds.surfaces.fill((points, triangles), size=0.1)
    assert len(fine.cells) > 5 * len(usual.cells)
    lengths = [np.linalg.norm(fine.points[fine.cells[:, i]] - fine.points[fine.cells[:, j]], axis=1) for i in range(3) for j in range(i)]
    assert np.median(np.concatenate(lengths)) == pytest.approx(0.1, rel=0.5)

    small = ds.surfaces.fill((points, triangles), scale=0.001)
    assert np.allclose(small.points[: len(points)], points * 0.001, rtol=1e-15)
    assert volumes(small.points, small.cells).sum() == pytest.approx(inside(points, triangles) * 1e-9, rel=1e-12)

    assert ds.surfaces.fill(tube(), largest_hole=2.0 + 1e-9).hole_count == 2
    two = together(ball(), ball(0.5, 3.0))
    largest = ds.surfaces.fill(two, parts="largest")
    assert largest.part_count == 2 and len(largest.wall) == len(ball()[1]) and largest.points[:, 0].max() <= 1


def test_triangles_may_be_turned_either_way() -> None:
    points, triangles = tube()
    turned = np.where(np.random.default_rng(1).random(len(triangles))[:, np.newaxis] < 0.5, triangles, triangles[:, ::-1])
    assert not np.array_equal(turned, triangles)
    filled = ds.surfaces.fill((points, turned))
    assert inside(filled.points, filled.wall) == pytest.approx(TUBE_VOLUME, rel=1e-12)


@pytest.mark.parametrize("kind", ["binary.stl", "ascii.stl", "binary.ply", "ascii.ply", "plain.obj"])
def test_files(tmp_path: pathlib.Path, kind: str) -> None:
    """A tube with points that floats of 32 bits hold; text has 8 digits of them. STL has each point six times."""
    points, triangles = tube()
    points = points.astype(np.float32).astype(np.float64)
    encoding, ending = kind.split(".")
    mesh = trimesh.Trimesh(points, triangles, process=False)
    options: dict[str, Any] = {"stl": {"file_type": f"stl{'_ascii' * (encoding == 'ascii')}"}, "ply": {"encoding": encoding}}.get(ending, {})
    path = tmp_path / kind
    mesh.export(path, **options)
    filled = ds.surfaces.fill(path)
    corners = filled.points[filled.wall[~filled.is_cap]]
    assert len(corners) == len(triangles) and not filled.is_cap[: len(triangles)].any()
    assert np.allclose(corners, points[triangles], rtol=0, atol=0 if encoding == "binary" else 1e-7)
    with ds.from_surface(str(path)) as environment:
        flight = environment.cast((0, 0, 3), (0, 0, 9))
        assert flight.position.tolist() == [0, 0, 6]


def test_polygons_and_textures_in_files(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "box.obj"
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    sides = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    lines = [*("v {} {} {}".format(*corner) for corner in corners), "vt 0 0", "vt 1 0", "vt 1 1"]
    path.write_text("\n".join([*lines, *("f " + " ".join(f"{i}/{1 + k % 3}" for k, i in enumerate(side)) for side in sides)]))
    filled = ds.surfaces.fill(path)
    assert len(filled.wall) == 12
    assert volumes(filled.points, filled.cells).sum() == pytest.approx(1.0, rel=1e-12)


FLAT = ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
BAD: dict[str, tuple[Any, dict[str, Any], str]] = {
    "no triangles": (([(0, 0, 0)], []), {}, "it has no triangles"),
    "repeated corners": (([(0, 0, 0), (1, 0, 0), (0, 0, 0)], [(0, 1, 2)]), {}, "no triangles with three different points"),
    "points of the plane": (([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)]), {}, r"shape \(n, 3\), not \(3, 2\)"),
    "ragged points": (([(0, 0, 0), (1, 0)], [(0, 1, 2)]), {}, "make no array"),
    "quads": ((FLAT[0], [(0, 1, 2, 3)]), {}, r"integers of shape \(m, 3\)"),
    "fractions": ((FLAT[0], [(0.0, 1.0, 2.5)]), {}, "integers of shape"),
    "index": ((FLAT[0], [(0, 1, 2), (0, 1, 4)]), {}, r"triangle 1 has points \[0, 1, 4\], there are 0 .. 3"),
    "negative index": ((FLAT[0], [(0, 1, -1)]), {}, r"triangle 0 has points \[0, 1, -1\]"),
    "not finite": (with_point_at(ball(), 5, (0, math.nan, 0)), {}, r"point 5 is not finite: \(0, nan, 0\)"),
    "three triangles": (with_fin(ball()), {}, r"1 edge has more than two triangles, the first from \("),
    "twice the same": ((ball()[0], np.concatenate([ball()[1], ball()[1][:1]])), {}, "3 edges have more than two"),
    "one side": (moebius_strip(), {}, "only one side, as a Moebius strip has, near"),
    "crossing": (with_point_at(ball(), 0, (0.5, -0.9, 0.2)), {}, r"of its triangles cross others, at \(-0.17\d*, .*\), \(0.55.*\); repair=True"),
    "crossing balls": (together(ball(), ball(1.0, 1.0)), {"parts": "all"}, "triangles cross others"),
    "flat": (FLAT, {}, "it is flat near .* encloses no volume"),
    "parts": (together(ball(), ball(0.5, 3.0)), {}, "2 parts .* parts='largest'"),
    "open end": (tube(), {"largest_hole": 1.9}, r"open end at \(.*, 0\) is 2 wide, and largest_hole is 1.9"),
    "no open end": ((ball()[0], ball()[1][1:]), {"largest_hole": 0}, "largest_hole is 0"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_surfaces_are_named(name: str, tmp_path: pathlib.Path) -> None:
    surface, options, message = BAD[name]
    with pytest.raises(ds.surfaces.SurfaceError, match=f"^surface: .*{message}"):
        ds.from_surface(surface, **options)
    if isinstance(surface[0], np.ndarray):
        path = tmp_path / "bad.ply"
        trimesh.Trimesh(*surface, process=False).export(path)
        with pytest.raises(ds.surfaces.SurfaceError, match=f"^surface '{path}': .*{message}"):
            ds.from_surface(path, **options)


def test_bad_files_are_named(tmp_path: pathlib.Path) -> None:
    with pytest.raises(FileNotFoundError, match="none.stl"):
        ds.from_surface(tmp_path / "none.stl")
    with pytest.raises(OSError, match="folder.stl"):
        (tmp_path / "folder.stl").mkdir()
        ds.from_surface(tmp_path / "folder.stl")
    contents = {
        "empty.stl": (b"", "no triangles"),
        "text.stl": (b"hello", "no triangles"),
        "points.obj": (b"v 0 0 0\n", "no triangles"),
        "word.obj": (b"v 0 0 x\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "can't read it"),
        "index.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "can't read it .*out of bounds"),
        "text.ply": (b"hello", "can't read it"),
        "notes.txt": (b"hello", "files ending in '.txt' are not read"),
    }
    box = bytes(trimesh.creation.box().export(file_type="stl"))
    contents["cut.stl"] = (box[:-20], "no triangles")
    for name, (content, message) in contents.items():
        (tmp_path / name).write_bytes(content)
        with pytest.raises(ds.surfaces.SurfaceError, match=f"^surface '.*{name}': .*{message}"):
            ds.from_surface(tmp_path / name)


def test_readers_name_one_another(tmp_path: pathlib.Path) -> None:
    trimesh.creation.box().export(tmp_path / "box.stl")
    with ds.meshes.read(str(tmp_path / "box.stl")) as environment:
        assert environment.region_names == {"lumen": 1, "tissue": 2} and environment.regions() == [1]
    tetra = meshio.Mesh(np.vstack([np.zeros(3), np.eye(3)]), [("tetra", [[0, 1, 2, 3]])])
    tetra.write(tmp_path / "box.vtu")
    with pytest.raises(ds.surfaces.SurfaceError, match=r"surface '.*box.vtu': .*dartsweep.meshes.read"):
        ds.from_surface(tmp_path / "box.vtu")


def test_bad_arguments() -> None:
    bad: list[tuple[str, Any]] = [("outside", "air"), ("parts", "some"), ("size", 0), ("size", math.nan), ("thickness", -1), ("scale", 0)]
    for name, value in [*bad, ("largest_hole", -1)]:
        with pytest.raises(ValueError, match=name):
            ds.surfaces.fill(ball(), **{name: value})
    with pytest.raises(TypeError, match="a surface is a path, a pair"):
        ds.from_surface(5)


@pytest.mark.parametrize("package", ["trimesh", "pymeshfix", "tetgen"])
def test_a_missing_package_names_the_extra(package: str, monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "ball.stl"
    trimesh.creation.icosphere().export(path)
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=rf"{package}.*pip install dartsweep\[surfaces\]"):
        ds.from_surface(path)


@pytest.mark.cold
def test_a_crash_of_the_tools_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ds.surfaces, "_START", "import os; os.abort()")
    with pytest.raises(ds.surfaces.SurfaceError, match="^surface: .*crashed"):
        ds.surfaces.fill(ball())


@pytest.mark.skipif("DARTSWEEP_DATA" not in os.environ, reason="DARTSWEEP_DATA names no folder of meshes")
@pytest.mark.parametrize("name", ["dental_probe", "hand_8k", "hand_12k", "malleus"])
def test_real_surfaces(name: str) -> None:
    filled = ds.surfaces.fill(pathlib.Path(os.environ["DARTSWEEP_DATA"]) / "surfaces" / f"{name}.obj")
    assert volumes(filled.points, filled.cells).sum() == pytest.approx(inside(filled.points, filled.wall), rel=1e-12)
    with make(filled) as environment:
        environment.check()


@pytest.mark.skipif("DARTSWEEP_DATA" not in os.environ, reason="DARTSWEEP_DATA names no folder of meshes")
def test_a_real_surface_that_crosses_itself() -> None:
    path = pathlib.Path(os.environ["DARTSWEEP_DATA"]) / "surfaces" / "pliers_dirty.obj"
    with pytest.raises(ds.surfaces.SurfaceError, match="'.*pliers_dirty.obj': it has 8 parts"):
        ds.surfaces.fill(path)
    with pytest.raises(ds.surfaces.SurfaceError, match="'.*pliers_dirty.obj': .* of its triangles cross others"):
        ds.surfaces.fill(path, parts="all")
