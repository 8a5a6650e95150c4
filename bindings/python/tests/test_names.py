"""Names of regions and surfaces: what a mesh calls its cells and faces, and what becomes of the names."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import dartsweep as ds
from dartsweep._door.build import environment_of
from dartsweep._door.mesh import Mesh

COUNT = (2, 2, 4)


def block(counts: tuple[int, int, int] = COUNT) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Unit cubes in a box, in hexahedra; x runs fastest."""
    x, y, z = (np.arange(count + 1) for count in counts)
    points = np.stack(np.meshgrid(z, y, x, indexing="ij")[::-1], axis=-1).reshape(-1, 3).astype(float)
    index = np.arange(len(points)).reshape(counts[2] + 1, counts[1] + 1, counts[0] + 1)
    lower = [index[:-1, :-1, :-1], index[:-1, :-1, 1:], index[:-1, 1:, 1:], index[:-1, 1:, :-1]]
    upper = [index[1:, :-1, :-1], index[1:, :-1, 1:], index[1:, 1:, 1:], index[1:, 1:, :-1]]
    return points, np.stack([each.ravel() for each in (*lower, *upper)], axis=1)


def mesh(**values: Any) -> Mesh:
    """The block, its ends called inlet and outlet, its sides wall, and all of these boundary."""
    points, cells = block()
    quads = cells[:, [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]].reshape(-1, 4)
    keys, first, count = np.unique(np.sort(quads, axis=1), axis=0, return_index=True, return_counts=True)
    outer = quads[first[count == 1]]
    z = points[outer][:, :, 2]
    groups = {
        "boundary": np.arange(len(outer)),
        "inlet": np.flatnonzero((z == 0).all(axis=1)),
        "outlet": np.flatnonzero((z == COUNT[2]).all(axis=1)),
        "wall": np.flatnonzero((z != z[:, :1]).any(axis=1)),
    }
    made = Mesh(points, np.full(len(cells), 12, np.uint8), np.arange(0, cells.size + 1, 8), cells.ravel())
    made.face_offsets, made.face_vertices, made.face_groups = np.arange(0, outer.size + 1, 4), outer.ravel(), groups
    made.face_numbers = {"inlet": 11, "outlet": 12}
    for name, value in values.items():
        setattr(made, name, value)
    return made


def make(by: str | None = None, options: dict[str, Any] | None = None, **values: Any) -> ds.Environment:
    return environment_of(mesh(**values), by, options or {})


def name_of(environment: ds.Environment, contact: Any) -> tuple[int, str]:
    told = environment.surfaces_of(contact)
    return int(told["tag"]), str(told["name"])


# --- surfaces


def test_contacts_name_the_surface() -> None:
    with make() as environment, ds.Scene(environment) as scene:
        assert environment.surface_names == {"inlet": 11, "outlet": 12, "boundary": 13, "wall": 14}
        middle = (1.0, 1.25, 2.25)
        assert name_of(environment, environment.cast(middle, (1, 1.25, 9))) == (12, "outlet")
        assert name_of(environment, environment.cast(middle, (1, 1.25, -9))) == (11, "inlet")
        assert name_of(environment, environment.cast(middle, (9, 1.25, 2.25))) == (14, "wall")
        assert name_of(environment, environment.cast(middle, (1, 1.5, 2.25))) == (0, "")
        flights = environment.cast_segments([middle] * 3, [(1, 1.25, 9), (1, 1.5, 2.25), (-9, 1.25, 2.25)])
        for contacts in (flights, flights["contact"], flights["contact"]["wall"], [*flights]):
            assert environment.surfaces_of(contacts).tolist() == [(12, "outlet"), (0, ""), (14, "wall")]
        body = scene.create_body([middle, (1, 1.25, 3)], [(0, 1)])
        body.move([(1, 1.25, 8), (1, 1.25, 9)])
        assert set(environment.surfaces_of(body.contacts())["name"]) == {"outlet"}
        assert name_of(environment, body.contacts()[0]) == name_of(environment, body.contacts()[0]["contact"]) == (12, "outlet")
        assert name_of(environment, environment.find_nearest((1, 1.25, 3.9))) == (12, "outlet")
        near = environment.find_nearest_to_points([(1, 1.25, 3.9), (0.1, 1, 2)])
        assert environment.surfaces_of(near)["name"].tolist() == ["outlet", "wall"]
        near = environment.find_nearest_to_segments([(1, 1.25, 3.9)], [(1, 1.25, 3.8)])
        assert environment.surfaces_of(near)["name"].tolist() == ["outlet"]
        path = environment.cast_path((0.5, 0.5, 0.5), (1.5, 0.5, 0.5))
        environment.name_surface("between", [path[1]["face"]])
        assert environment.surfaces_of(path)["name"].tolist() == ["", "between"]
        assert len(environment.surfaces_of(flights[:0])) == 0
        with pytest.raises(TypeError, match="ids of faces are needed, not int"):
            environment.surfaces_of(5)


def test_faces_of_a_surface() -> None:
    with make() as environment:
        assert len(environment.faces("outlet")) == len(environment.faces(12)) == 4
        assert len(environment.faces("boundary")) == environment.info.boundary_face_count
        for face in environment.faces("inlet"):
            assert all(environment.vertex_position(vertex)[2] == 0 for vertex in environment.vertices(face))
        with pytest.raises(ValueError, match=r"no surface is called 'outlets'; surfaces are 11 \(inlet\), 12 \(outlet\), 13 \(boundary\), 14 \(wall\)"):
            environment.faces("outlets")
        with pytest.raises(ValueError, match="no surface has tag 5; surfaces are 11"):
            environment.mark_surface(5)
    with make(face_groups={}) as plain, pytest.raises(ValueError, match="no surface is called 'wall'; there are no surfaces"):
        plain.faces("wall")


def test_a_baffle_is_marked() -> None:
    points, cells = block()
    offsets, corners = np.array([0, 4, 8]), np.concatenate([cells[4, 4:], cells[5, 4:]])  # between z = 1 and 2
    with make(face_offsets=offsets, face_vertices=corners, face_groups={"baffle": np.arange(2)}, face_numbers={}) as environment:
        assert environment.cast((0.5, 0.5, 0.5), (0.5, 0.5, 3.5)).outcome == ds.Outcome.REACHED
        assert environment.mark_surface("baffle") == 2
        flight = environment.cast((0.5, 0.5, 0.5), (0.5, 0.5, 3.5))
        assert flight.position.tolist() == [0.5, 0.5, 2] and name_of(environment, flight) == (1, "baffle")
        assert environment.mark_surface("baffle", ds.Mark.PASSABLE) == 2
        assert environment.cast((0.5, 0.5, 0.5), (0.5, 0.5, 3.5)).outcome == ds.Outcome.REACHED


def test_hosts_name_surfaces() -> None:
    with make(face_groups={}) as environment:
        wall = environment.cast((1, 1.25, 2.25), (1, 1.25, 9)).contact.wall
        environment.name_surface("door", [wall], 7)
        assert environment.surface_names == {"door": 7} and len(environment.faces("door")) == 1
        assert name_of(environment, environment.cast((1, 1.25, 2.25), (1, 1.25, 9))) == (7, "door")


def test_faces_that_are_none_are_told() -> None:
    offsets, corners = np.array([0, 4, 8]), np.array([0, 1, 4, 3, 0, 1, 2, 44])
    with make(face_offsets=offsets, face_vertices=corners, face_groups={"lost": np.arange(2)}, face_numbers={}) as environment:
        assert environment.notes == ("1 of 2 faces of the surface 'lost' are faces of no cell",)
        assert len(environment.faces("lost")) == 1


def test_labels_of_faces_without_names() -> None:
    base = mesh()
    labels = np.zeros(len(base.face_offsets) - 1, np.int32)
    labels[base.face_groups["outlet"]] = 3
    with make(face_groups={}, face_numbers={}, face_data={"CellEntityIds": labels, "Area": labels * 0.5}) as environment:
        assert environment.surface_names == {"0": 0, "3": 3} and len(environment.faces(3)) == 4
        assert name_of(environment, environment.cast((1, 1.25, 2.25), (1, 1.25, 9))) == (3, "3")


def test_names_stay_when_cells_change() -> None:
    with make() as environment:
        area = len(environment.faces("wall"))
        environment.cut([[(-1.0, -1, 1.3), (9, -1, 1.3)], [(-1.0, 9, 1.4), (9, 9, 1.4)]])
        assert len(environment.faces("wall")) == area + 8 and len(environment.faces("inlet")) == 4
        for z in (1.1, 1.6):  # below and above the cut
            assert name_of(environment, environment.cast((1.5, 1.25, z), (9, 1.25, z))) == (14, "wall")
        copied = copy.deepcopy(environment)
        assert copied.surface_names == environment.surface_names
        assert np.array_equal(copied.faces("wall"), environment.faces("wall"))
        environment.remove_volumes([environment.locate((0.5, 0.5, 3.5))[0]])
        assert len(environment.faces("outlet")) == 3
        assert name_of(environment, environment.cast((0.5, 0.5, 2.5), (0.5, 0.5, 9))) == (0, "")


def test_pickles_and_coarse_environments_have_names() -> None:
    points, cells = block()
    tetrahedra = cells[:, [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]].reshape(-1, 4)
    made = mesh(types=np.full(len(tetrahedra), 10, np.uint8), offsets=np.arange(0, tetrahedra.size + 1, 4), connectivity=tetrahedra.ravel())
    with ds.Environment(points, tetrahedra) as plain:
        quads = made.face_vertices.reshape(-1, 4)
        triangles = np.concatenate([quads[:, [i, (i + 1) % 4, (i + 2) % 4]] for i in range(4)])
        triangles = triangles[plain.find_faces(np.arange(0, triangles.size + 1, 3), triangles.ravel())["generation"] != 0]
    top = np.flatnonzero((points[triangles][:, :, 2] == COUNT[2]).all(axis=1))
    made.face_offsets, made.face_vertices, made.face_groups = np.arange(0, triangles.size + 1, 3), triangles.ravel(), {"outlet": top}
    made.cell_groups = {"low": np.arange(24), "all": np.arange(len(tetrahedra))}
    with environment_of(made, None, {}) as environment:
        assert len(environment.faces("outlet")) == 8
        coarse, _ = environment.coarsen()
        again = pickle.loads(pickle.dumps(environment))
        for other in (coarse, again):
            assert other.surface_names == {"outlet": 12} and len(other.faces("outlet")) == 8
            assert other.region_groups == environment.region_groups
            assert name_of(other, other.cast((1, 1.25, 2.25), (1, 1.25, 9))) == (12, "outlet")


def test_sides_of_the_plane_have_names() -> None:
    made = Mesh(np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float), np.array([9], np.uint8), np.array([0, 4]), np.arange(4))
    made.face_offsets, made.face_vertices, made.face_groups = np.array([0, 2, 4]), np.array([1, 2, 3, 0]), {"right": np.array([0]), "left": np.array([1])}
    with environment_of(made, None, {}) as environment:
        flights = environment.cast_segments([(0.5, 0.5)] * 3, [(9, 0.5), (-9, 0.5), (0.5, 9)])
        assert environment.surfaces_of(flights).tolist() == [(1, "right"), (2, "left"), (0, "")]
        environment.cut([(-1.0, 0.25), (2.0, 0.25)])
        assert len(environment.faces("right")) == 2


# --- regions


def of_cells(environment: ds.Environment) -> list[int]:
    return [environment.region(environment.volume_id(i)) for i in range(environment.info.volume_count)]


def test_groups_that_overlap() -> None:
    groups = {"all": np.arange(16), "lumen": np.arange(6), "tissue": np.arange(6, 16), "thick": np.arange(4, 8)}
    with make(cell_groups=groups) as environment:
        assert len(environment.regions()) == 4 and environment.region_names == {}
        for name, cells in groups.items():
            assert environment.mark_region(name) == (len(cells), 0)
            marked = [environment.is_impassable(environment.volume_id(i)) for i in range(16)]
            assert np.flatnonzero(marked).tolist() == cells.tolist()
            environment.mark_region("all", ds.Mark.PASSABLE)
        assert environment.mark_between("lumen", "tissue") == 4 + 2
        with ds.Scene(environment) as scene:
            scene.create_particles([(0.5, 0.5, 1.5)])  # in cell 4
            with pytest.raises(ds.errors.Occupied):
                environment.mark_region("thick")
            assert environment.mark_count(ds.CellKind.VOLUME) == 0
            assert environment.mark_region("thick", flags=ds.MarkFlag.SKIP_OCCUPIED) == (3, 1)


def test_groups_that_do_not_overlap() -> None:
    with make(cell_groups={"lumen": np.arange(6), "none": np.arange(0), "tissue": np.arange(6, 10)}) as environment:
        assert environment.region_names == {"lumen": 1, "none": 2, "tissue": 3}
        assert of_cells(environment) == [1] * 6 + [3] * 4 + [0] * 6
        with pytest.raises(ValueError, match=r"no volume has region 'none'; regions are 0, 1 \(lumen\), 3 \(tissue\)"):
            environment.mark_region("none")
        with pytest.raises(ValueError, match=r"no region is called 'air'; regions are 0, 1 \(lumen\), 3 \(tissue\)"):
            environment.mark_region("air")


def test_groups_and_labels() -> None:
    labels = np.repeat([7, 3], 8)
    with make(regions=labels, region_names={"wall": 3}, cell_groups={"all": np.arange(16), "low": np.arange(8)}) as environment:
        assert of_cells(environment) == labels.tolist() and environment.notes == ()
        assert environment.region_groups == {"wall": (3,), "all": (3, 7), "low": (7,)}
    with make(regions=labels, region_names={"wall": 3}, cell_groups={"part": np.arange(4, 12)}) as environment:
        assert environment.mark_region("part") == (8, 0) and environment.mark_region("wall") == (8, 0)
        assert of_cells(environment)[4:8] == [7] * 4 and len(environment.regions()) == 4
        assert [note.partition(" into")[0] for note in environment.notes] == ["region 3 is divided", "region 7 is divided"]


@pytest.mark.parametrize("name", ["tetgen:ref", "nastran:ref", "netgen:index", "CellEntityIds", "material", "attribute", "gmsh:physical", "medit:ref", "cell_tags"])
@pytest.mark.parametrize("kind", [np.int8, np.uint8, np.int32, np.int64, np.uint64])
def test_usual_labels(name: str, kind: Any) -> None:
    with make(cell_data={"pressure": np.zeros(16), name: np.repeat([7, 3], 8).astype(kind)}) as environment:
        assert environment.regions() == [3, 7] and of_cells(environment)[0] == 7


@pytest.mark.parametrize("labels", [np.full(16, 2**31), np.full(16, -(2**31) - 1), np.full(16, 1.0), np.full(16, 1.5), np.full((16, 2), 1), np.full(15, 1)])
def test_labels_are_never_cast(labels: Any) -> None:
    with pytest.raises(ds.errors.MeshError, match="the mesh: the array 'mine' .*; labels of regions"):
        make("mine", cell_data={"mine": labels})


def test_a_wrong_array_lists_those_that_exist() -> None:
    with pytest.raises(ds.errors.MeshError, match="no array or group of cells called 'nope'; those that it has: 'material', 'low'"):
        make("nope", cell_data={"material": np.ones(16, int)}, cell_groups={"low": np.arange(3)})
    with make("low", cell_data={"material": np.ones(16, int)}, cell_groups={"low": np.arange(3), "high": np.arange(2, 16)}) as environment:
        assert environment.region_names == {"low": 1} and of_cells(environment) == [1] * 3 + [0] * 13


def test_numbers_that_are_no_labels_are_told() -> None:
    with make(cell_data={"material": np.linspace(0, 1, 16)}) as environment:
        assert environment.regions() == [0] and environment.notes == ("the array 'material' has no integers: it is not taken as labels",)


def test_damaged_groups_are_errors() -> None:
    with pytest.raises(ds.errors.MeshError, match="the group 'low' names cell 16, there are 16"):
        make(cell_groups={"low": np.array([3, 16])})


def test_cells_that_are_refused_name_the_mesh() -> None:
    connectivity = block()[1]
    connectivity[3, 4] = 99
    with pytest.raises(ds.errors.MeshError, match="mesh 'x.vtu': .*cell 3 names a point that does not exist") as caught:
        make(connectivity=connectivity.ravel(), source="mesh 'x.vtu'")
    assert isinstance(caught.value.__cause__, ds.errors.IndexOutOfRange) and isinstance(caught.value, ValueError)
    connectivity = block()[1]
    connectivity[3] = connectivity[3, [4, 5, 6, 7, 0, 1, 2, 3]]
    with pytest.raises(ds.errors.MeshError, match="mesh 'x.vtu': 1 of 16 cells .* inside out, the first is cell 3; flags=EnvironmentFlag.REORIENT"):
        make(connectivity=connectivity.ravel(), source="mesh 'x.vtu'")


# --- the plane in space


def square(points: Any, cells: Any = ((0, 1, 2), (0, 2, 3))) -> Mesh:
    cells = np.array(cells)
    return Mesh(np.array(points, float), np.full(len(cells), 5, np.uint8), np.arange(0, cells.size + 1, 3), cells.ravel())


CORNERS = np.array([(0.1, 0), (1, 0), (1, 0.7), (0, 0.7)])


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("turned", [False, True])
def test_planes_across_an_axis(axis: int, turned: bool) -> None:
    points = np.insert(CORNERS, axis, 5.0, axis=1)
    cells = [(0, 2, 1), (0, 3, 2)] if turned else [(0, 1, 2), (0, 2, 3)]
    with environment_of(square(points, cells), None, {}) as environment:
        assert environment.dimension == 2 and np.array_equal(environment.points(), CORNERS)
        assert f"in the plane {'xyz'[axis]} = 5" in environment.notes[0] and len(environment.notes) == 1 + turned
        plane = environment.plane
        assert plane is not None and np.array_equal(plane.origin + environment.points() @ plane.axes, points)


def test_planes_anywhere() -> None:
    rng = np.random.default_rng(3)
    for _ in range(20):
        axes = np.linalg.qr(rng.normal(size=(3, 3)))[0][:2]
        points = (rng.normal(size=3) * 10 + CORNERS @ axes).astype(np.float32)
        with environment_of(square(points), None, {}) as environment:
            plane = environment.plane
            assert plane is not None and np.allclose(plane.origin + environment.points() @ plane.axes, points, atol=1e-5)
            assert environment.info.volume_count == 2 and "of its extent" in environment.notes[0]


def test_a_bent_surface_is_no_plane() -> None:
    points = np.insert(CORNERS, 2, [0, 0, 0, 0.01], axis=1) @ np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    with pytest.raises(ds.errors.MeshError, match="2 cells that lie in no plane.*from_surface"):
        environment_of(square(points), None, {})
