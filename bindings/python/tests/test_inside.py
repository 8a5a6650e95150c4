"""Points on the boundary, as of catheters that start on an inlet: they are told as such, and the nearest places inside are found."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from numpy.typing import NDArray

import dartsweep as ds
from test_names import block

TURN = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])


def tetrahedra(turn: NDArray[np.float64] | None = None) -> ds.Environment:
    """A block of cubes, six tetrahedra each."""
    points, cells = block()
    corners = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
    return ds.Environment(points if turn is None else points @ turn.T, cells[:, corners].reshape(-1, 4))


PLACES = [(0.4, 0.3, 0.0), (0.4, 0.3, 4.0), (2.0, 0.3, 0.7), (0.3, 2.0, 0.7), (0.0, 0.0, 0.0), (2.0, 2.0, 4.0), (2.0, 0.4, 0.0)]


@pytest.mark.parametrize("place", PLACES)
def test_a_point_on_the_boundary_is_told(place: tuple[float, float, float]) -> None:
    with tetrahedra() as environment, ds.Scene(environment) as scene:
        near = environment.find_nearest(place)
        assert near.distance == 0 and near.point.tolist() == list(place) and near.cell.kind == ds.CellKind.FACE
        assert environment.find_nearest_to_points([place], 1.0)["distance"].tolist() == [0]
        assert environment.find_nearest_to_segments([place], [(1, 1, 2)])["nearest"]["distance"].tolist() == [0]
        try:
            scene.create_particle(place)
        except ds.errors.Outside as error:
            assert f"is on the boundary, at face {near.cell.local} of volume {near.cell.index}" in str(error)
        for by in (0.0, 0.25):
            inside = environment.inside(place, by)
            scene.create_body(np.stack([inside, (1.0, 1.0, 2.0)]), [(0, 1)])
            assert inside.shape == (3,) and environment.find_nearest(inside).distance > 0
            assert np.linalg.norm(inside - place) == pytest.approx(by, rel=1e-12, abs=1e-14)


def test_points_beyond_the_boundary_go_to_the_nearest_place() -> None:
    with tetrahedra() as environment:
        volumes = np.empty(4, ds.dtypes.VOLUME_ID)
        points = [(0.5, 0.5, 5.0), (-3.0, 0.5, 1.5), (1.0, 0.75, 1.5), (0.5, 0.5, 4.0)]
        inside = environment.inside(points, 0.125, volumes=volumes)
        assert np.allclose(inside, [(0.5, 0.5, 3.875), (0.125, 0.5, 1.5), (1.0, 0.75, 1.5), (0.5, 0.5, 3.875)], rtol=0, atol=1e-15)
        assert inside[2].tolist() == list(points[2]) and np.all(volumes["generation"] == 1)
        assert np.array_equal(environment.locate_points(inside)[0], volumes)
        with pytest.raises(ds.errors.OutOfRange):
            environment.inside(points, -1.0)
        with pytest.raises(ds.errors.WrongSize):
            environment.inside([(0.5, 0.5)])


def test_rounded_points_of_an_inlet() -> None:
    """In a turned mesh rounding puts points of the inlet on either side of it. Points that are told to lie on it do so exactly."""
    with tetrahedra(TURN) as environment:
        flat = np.insert(np.random.default_rng(0).uniform(0.1, 1.9, (3000, 2)), 2, 0, axis=1)
        points = flat @ TURN.T
        locations = environment.locate_points(points)[1]
        outside = locations == ds.Location.OUTSIDE
        assert 0 < outside.sum() < len(points)
        near = environment.find_nearest_to_points(points)
        places = environment.points()
        for i in np.flatnonzero(outside):
            cell = near[i]["cell"]
            if near[i]["distance"] == 0:
                face = environment.vertices(ds.FaceId(int(cell["index"]), int(cell["generation"]), int(cell["local"])))["index"]
                a, b, c, d = ([Fraction(float(x)) for x in row] for row in (*places[face], points[i]))
                u, v, w = ([x - y for x, y in zip(row, a)] for row in (b, c, d))
                assert sum(w[k] * (u[k - 2] * v[k - 1] - u[k - 1] * v[k - 2]) for k in range(3)) == 0
            else:
                assert np.isinf(near[i]["distance"])
        inside = environment.inside(points, 0.01)
        assert np.all(environment.locate_points(inside)[1] == ds.Location.PASSABLE)
        assert np.abs(inside[outside] - points[outside] - 0.01 * TURN[:, 2]).max() < 1e-14


def test_the_plane() -> None:
    with ds.Environment([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2, 3)]) as environment:
        assert environment.find_nearest((1.0, 0.25)).distance == 0
        assert environment.inside([(1.0, 0.25), (0.5, 3.0)], 0.125).tolist() == [[0.875, 0.25], [0.5, 0.875]]


def test_the_wall_of_tissue() -> None:
    """A point on the face between a passable and an impassable volume."""
    with tetrahedra() as environment:
        solid = [environment.volume_id(i) for i in range(environment.info.volume_count) if environment.centre(environment.volume_id(i))[2] > 2]
        environment.mark_volumes(solid)
        place = (0.4, 0.3, 2.0)
        assert environment.locate(place)[1] == ds.Location.IMPASSABLE and environment.find_nearest(place).distance == 0
        assert np.allclose(environment.inside([place, (0.4, 0.3, 3.0)], 0.25), (0.4, 0.3, 1.75), rtol=0, atol=1e-15)
        with ds.Scene(environment) as scene, pytest.raises(ds.errors.Impassable, match="on the boundary, at face .* in an impassable volume"):
            scene.create_particle(place)
