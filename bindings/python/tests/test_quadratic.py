"""Quadratic cells: by their corners, or divided so that they follow a curved boundary."""

from __future__ import annotations

import itertools
import pathlib
from typing import Any

import meshio
import numpy as np
import pytest

import dartsweep as ds
from dartsweep._door import build, linear, meshio_reader, raw
from volumes import CUBE, PRISM, TETRA, volume_of

PYRAMID = np.array([*CUBE[:4], (0.5, 0.5, 1)])
LOOP4, LOOP3 = [(0, 1), (1, 2), (2, 3), (3, 0)], [(0, 1), (1, 2), (2, 0)]
EDGES: dict[str, tuple[Any, list[tuple[int, int]]]] = {
    "tetra10": (TETRA, [*LOOP3, (0, 3), (1, 3), (2, 3)]),
    "hexahedron20": (CUBE, [*LOOP4, (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]),
    "wedge15": (PRISM, [*LOOP3, (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]),
    "pyramid13": (PYRAMID, [*LOOP4, (0, 4), (1, 4), (2, 4), (3, 4)]),
    "triangle6": (TETRA[:3], LOOP3),
    "quad8": (CUBE[:4], LOOP4),
}
FACES: dict[str, tuple[str, list[tuple[int, ...]]]] = {
    "hexahedron27": ("hexahedron20", [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (2, 3, 7, 6), (0, 1, 2, 3), (4, 5, 6, 7), tuple(range(8))]),
    "wedge18": ("wedge15", [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]),
    "quad9": ("quad8", [(0, 1, 2, 3)]),
}
COUNTS = {"tetra10": 8, "hexahedron20": 8, "hexahedron27": 8, "wedge15": 8, "wedge18": 8, "pyramid13": 10, "triangle6": 4, "quad8": 4, "quad9": 4}
VOLUMES = {"tetra": 1 / 6, "hexahedron": 1, "wedge": 0.5, "pyramid": 1 / 3, "triangle": 0.5, "quad": 1}


TYPES = {
    **{"tetra10": 24, "hexahedron20": 25, "wedge15": 26, "pyramid13": 27, "quad9": 28, "hexahedron27": 29, "wedge18": 32, "triangle6": 22},
    "quad8": 23,
}


def made(kind: str, points: Any, quadratic: str = "corners", **more: Any) -> ds.Environment:
    """An environment of cells of one type that follow each other."""
    cells = linear.uniform(TYPES[kind], np.arange(len(points)).reshape(-1, len(cell(kind))))
    return build.environment_of(raw.mesh_of(raw.Raw(points, cells, **more), quadratic), None, {})


def cell(kind: str) -> Any:
    """Nodes of one straight cell, in the order of VTK."""
    base, faces = FACES.get(kind, (kind, []))
    corners, edges = EDGES[base]
    groups: list[tuple[int, ...]] = [*edges, *faces]
    return np.array([*corners, *(corners[list(group)].mean(axis=0) for group in groups)])


@pytest.mark.parametrize("kind", COUNTS)
def test_straight_cells_keep_their_volume_and_are_divided(kind: str) -> None:
    points = cell(kind)
    expected = VOLUMES[kind.rstrip("0123456789")]
    with made(kind, points) as corners, made(kind, points, "split") as divided:
        assert corners.info.volume_count == 1 and volume_of(corners) == pytest.approx(expected)
        assert "quadratic=\"split\" keeps their nodes" in corners.notes[0] and divided.notes == ()
        assert divided.info.volume_count == COUNTS[kind] and divided.info.part_count == 1 and volume_of(divided) == pytest.approx(expected)
        divided.check()


@pytest.mark.parametrize("kind", COUNTS)
def test_divided_cells_follow_the_curve(kind: str) -> None:
    """Each node moves from the middle of its corners onto a map of degree 2; the division has the nodes as vertices."""
    points = cell(kind)
    curved = points + 0.1 * np.stack([points[:, 1] ** 2, points[:, 0] ** 2, 0 * points[:, 0]], axis=1)
    with made(kind, curved, "split") as divided, made(kind, curved) as corners:
        used = {int(i) for index in range(divided.info.volume_count) for i in divided.vertices(divided.volume_id(index))["index"]}
        assert set(range(len(points))) <= used
        assert "which lie up to 0.025 from" in corners.notes[0]
        assert abs(volume_of(divided) - volume_of(corners)) > 1e-4 or kind not in ("tetra10", "wedge15", "wedge18", "triangle6")


@pytest.mark.parametrize("corners", itertools.permutations(range(4)))
def test_quadratic_tetrahedra_are_divided_round_the_best_diagonal(corners: tuple[int, ...]) -> None:
    """One diagonal leaves the largest least volume, wherever a cell's numbers begin, and in cells that are inside out, as those of MED are."""
    base = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
    middle = {frozenset(ends): (base[ends[0]] + base[ends[1]]) / 2 for ends in itertools.combinations(range(4), 2)}
    for place, moved in zip(middle.values(), [(0, -0.2, -0.1), (0.05, 0, 0.1), (-0.1, 0.1, 0), (0.1, 0, 0.05), (0, 0.1, -0.1), (-0.1, 0, 0.1)]):
        place += moved
    opposite = [(frozenset(pair), frozenset(range(4)) - frozenset(pair)) for pair in ((0, 1), (0, 2), (0, 3))]
    least = []
    for k in range(3):
        (p, q), (a, b), (c, d) = (opposite[(k + i) % 3] for i in range(3))
        ring = [middle[key] for key in (a, c, b, d)]
        least.append(min(abs(np.linalg.det([middle[q] - middle[p], x - middle[p], y - middle[p]])) for x, y in zip(ring, [*ring[1:], ring[0]])))
    ends = [middle[key].tolist() for key in opposite[int(np.argmax(least))]]
    assert sorted(least)[2] > sorted(least)[1] + 1e-3
    own = [middle[frozenset((corners[a], corners[b]))] for a, b in EDGES["tetra10"][1]]
    with made("tetra10", np.array([*base[list(corners)], *own]), "split") as environment:
        points = environment.points()
        cells = [points[environment.vertices(environment.volume_id(i))["index"]].tolist() for i in range(environment.info.volume_count)]
        assert len(cells) == 8 and sum(ends[0] in cell and ends[1] in cell for cell in cells) == 4


def test_cells_beside_each_other_share_the_middles_of_faces() -> None:
    """Two hexahedra of 20 nodes, a wedge and a pyramid: the middles of their faces are made once."""

    points: list[tuple[float, ...]] = []

    def nodes(kind: str, corners: Any) -> list[int]:
        edges = EDGES[kind][1]
        places = [tuple(map(float, p)) for p in [*corners, *((np.array(corners[a]) + corners[b]) / 2 for a, b in edges)]]
        for place in places:
            if place not in points:
                points.append(place)
        return [points.index(place) for place in places]

    parts = [
        linear.uniform(25, [nodes("hexahedron20", CUBE), nodes("hexahedron20", CUBE + (1, 0, 0))]),
        linear.uniform(26, [nodes("wedge15", np.array([(1, 1, 0), (0, 1, 0), (0, 2, 0), (1, 1, 1), (0, 1, 1), (0, 2, 1)])[[1, 0, 2, 4, 3, 5]])]),
        linear.uniform(27, [nodes("pyramid13", np.array([(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (0.5, 0.5, 2)]))]),
    ]
    mesh = raw.mesh_of(raw.Raw(np.array(points), linear.joined(parts)), "split")
    with ds.Environment(mesh.points, mesh.connectivity, mesh.types, mesh.offsets) as environment:
        assert environment.info.volume_count == 8 + 8 + 8 + 10 and environment.info.part_count == 1
        assert volume_of(environment) == pytest.approx(2 + 0.5 + 1 / 3)
        environment.check()
    assert len({tuple(point) for point in mesh.points.tolist()}) == len(mesh.points)


def test_data_and_groups_of_divided_cells_are_those_of_their_cells() -> None:
    points = cell("tetra10")
    with made("tetra10", np.concatenate([points, points + (5, 0, 0)]), "split", regions=np.array([4, 6])) as environment:
        assert [environment.region(environment.volume_id(i)) for i in range(16)] == [4] * 8 + [6] * 8


def test_cells_that_can_not_be_divided_name_the_way_on() -> None:
    cubic = meshio.Mesh(np.random.default_rng(1).random((20, 3)), [("tetra20", [list(range(20))])])
    with pytest.raises(ds.MeshError, match='not divided; take quadratic="corners"'):
        ds.from_meshio(cubic, quadratic="split")
    with pytest.raises(ValueError, match="corners"):
        ds.read(__file__, quadratic="both")


def curved(kind: str) -> Any:
    """Nodes of a cell with curved sides, no two of which are alike."""
    return cell(kind) + np.random.default_rng(7).uniform(-0.04, 0.04, cell(kind).shape)


TEXTS = {  # how a cell stands in a file, and which of our nodes stands where
    ("hexahedron27", "inp"): ("*ELEMENT, TYPE=C3D27", [*range(20), 26, 24, 25, 22, 21, 23, 20]),
    ("wedge18", "inp"): ("*ELEMENT, TYPE=C3D15V", list(range(18))),
    ("wedge18 by Gmsh", "inp"): ("*ELEMENT, TYPE=C3D6", [*range(7), 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16]),
    ("tetra10", "dato"): ("$ELEMENT TYPE=TET10", [0, 4, 1, 5, 2, 6, 7, 8, 9, 3]),
}


@pytest.mark.parametrize(("kind", "ending"), TEXTS)
def test_nodes_of_quadratic_cells_of_texts(kind: str, ending: str, tmp_path: pathlib.Path) -> None:
    """Each format has the middles of sides and faces in an order of its own."""
    head, order = TEXTS[kind, ending]
    points, kind = curved(kind.split()[0]), kind.split()[0]
    between, nodes = (", ", "*NODE") if ending == "inp" else (" ", "$COOR NSET=all")
    rows = "".join(between.join(map(str, (i, *place))) + "\n" for i, place in enumerate(points.tolist(), 1))
    (tmp_path / f"one.{ending}").write_text(f"{nodes}\n{rows}{head}\n1{between}{between.join(str(i + 1) for i in order)}\n")
    for quadratic in ("corners", "split"):
        with ds.read(tmp_path / f"one.{ending}", quadratic=quadratic) as environment, made(kind, points, quadratic) as expected:
            assert volume_of(environment) == pytest.approx(volume_of(expected), rel=1e-12)


def test_wedges_of_gmsh_that_meshio_leaves_in_its_order(tmp_path: pathlib.Path) -> None:
    points, order = curved("wedge18"), [*range(7), 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16]
    meshio.write(tmp_path / "one.msh", meshio.Mesh(points, [("wedge18", [order])]), "gmsh22")
    mesh = raw.mesh_of(meshio_reader.read(str(tmp_path / "one.msh"), "one", "gmsh"), "split")
    with build.environment_of(mesh, None, {}) as environment, made("wedge18", points, "split") as expected:
        assert volume_of(environment) == pytest.approx(volume_of(expected), rel=1e-12)


def test_quadratic_cells_of_which_no_order_is_known_are_told(tmp_path: pathlib.Path) -> None:
    rows = "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(cell("hexahedron20").tolist(), 1))
    (tmp_path / "one.dato").write_text(f"$COOR NSET=all\n{rows}$ELEMENT TYPE=HEXE20\n1 {' '.join(str(i) for i in range(1, 21))}\n")
    with pytest.raises(ds.MeshError, match="does not know the order"):
        ds.read(tmp_path / "one.dato")
