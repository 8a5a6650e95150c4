"""Rays against closed surfaces, beside crossings by rational arithmetic; and objects in free space."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import trimesh

import dartsweep as ds
from dartsweep.rays import RayMeshIntersector
from dartsweep.surfaces import SurfaceError


def pair() -> trimesh.Trimesh:
    return trimesh.util.concatenate([trimesh.creation.icosphere(2), trimesh.creation.torus(3, 0.5, 16, 8)])


@pytest.fixture(scope="module")
def rays() -> RayMeshIntersector:
    return RayMeshIntersector(pair())


Vector = list[Fraction]


def fractions(values: Any) -> Vector:
    return [Fraction(float(x)) for x in values]


def minus(u: Vector, v: Vector) -> Vector:
    return [x - y for x, y in zip(u, v)]


def cross(u: Vector, v: Vector) -> Vector:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def dot(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def crossings(origin: Any, direction: Any) -> list[tuple[Fraction, int]]:
    """Times and triangles where a ray meets a triangle of `pair` inside; it must meet no edge."""
    o, d = fractions(origin), fractions(direction)
    found = []
    for number, corners in enumerate(pair().triangles):
        a, b, c = map(fractions, corners)
        signs = [dot(d, cross(minus(p, o), minus(q, o))) for p, q in ((a, b), (b, c), (c, a))]
        assert all(sign != 0 for sign in signs)
        if len({sign > 0 for sign in signs}) == 1:
            normal = cross(minus(b, a), minus(c, a))
            time = dot(normal, minus(a, o)) / dot(normal, d)
            if time > 0:
                found.append((time, number))
    return sorted(found)


def test_rays_as_rational_arithmetic_has_them(rays: RayMeshIntersector) -> None:
    random = np.random.default_rng(4)
    origins, directions = 4 * random.normal(size=(16, 3)), random.normal(size=(16, 3))
    directions[::2] -= origins[::2]  # many meet
    triangles, of = rays.intersects_id(origins, directions)
    places, again, same = rays.intersects_location(origins, directions)
    assert np.array_equal(triangles, same) and np.array_equal(of, again) and len(triangles) > 12
    first, ones = rays.intersects_first(origins, directions), rays.intersects_id(origins, directions, multiple_hits=False)
    for i, (origin, direction) in enumerate(zip(origins, directions)):
        right = crossings(origin, direction)
        assert triangles[of == i].tolist() == [number for _, number in right]
        assert np.allclose(places[of == i], [origin + float(time) * direction for time, _ in right] or np.empty((0, 3)), atol=1e-12)
        assert first[i] == (right[0][1] if right else -1)
    assert np.array_equal(rays.intersects_any(origins, directions), first >= 0)
    assert np.array_equal(ones[0], first[first >= 0]) and np.array_equal(ones[1], np.flatnonzero(first >= 0))


def test_no_ray_slips_through_or_meets_twice(rays: RayMeshIntersector) -> None:
    """Through vertices and middles of edges a line enters as often as it leaves."""
    random, mesh = np.random.default_rng(5), pair()
    aims = np.concatenate([mesh.vertices, mesh.triangles[:, :2].mean(axis=1)])
    origins = 2 * random.normal(size=(len(aims), 3))
    _, of = rays.intersects_id(origins, aims - origins)
    assert np.array_equal(np.bincount(of, minlength=len(aims)) % 2 == 1, rays.contains_points(origins))


def test_inside(rays: RayMeshIntersector) -> None:
    assert rays.contains_points([(0, 0, 0), (2, 0, 0), (3, 0, 0), (99, 0, 0)]).tolist() == [True, False, True, False]


def test_rays_that_are_none(rays: RayMeshIntersector) -> None:
    for bad in ([(0, 0, 0)], [(0, np.nan, 1)], [(np.inf, 0, 0)]):
        with pytest.raises(ValueError, match="no direction is 0"):
            rays.intersects_any([(0, 0, 0)], bad)
    with pytest.raises(ValueError, match="shape"):
        rays.intersects_any([(0, 0, 0)], [(1, 0, 0), (0, 1, 0)])
    assert rays.intersects_first(np.empty((0, 3)), np.empty((0, 3))).tolist() == []
    assert rays.intersects_first([(0, 0, 0), (99, 0, 99)], [(0, 0, 1e-300), (0, 1, 0)]).tolist() != [-1, -1]
    with pytest.raises(SurfaceError, match="open"):
        RayMeshIntersector(trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3)]))


def test_an_object_in_free_space() -> None:
    ball = trimesh.creation.icosphere(2)
    with ds.from_surface(ball, outside="space") as environment, ds.Scene(environment) as scene:
        assert environment.region_names == {"object": 1, "space": 2}
        flight = environment.cast((1.5, 0.125, 0.25), (-1.5, 0.125, 0.25))
        assert flight.contact.tag == 1 and 0.9 < np.linalg.norm(flight.position) < 1
        cord = scene.create_body([(1.5, -0.5, 0.1), (1.5, 0.5, 0.1)], edges=[(0, 1)])
        cord.move([(-1.5, -0.5, 0.1), (-1.5, 0.5, 0.1)])
        assert cord.positions()[:, 0].max() > 0.8 and len(cord.contacts()) > 0
