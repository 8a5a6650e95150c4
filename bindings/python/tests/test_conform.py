"""Parts of a mesh that lie on each other, sewn when an environment is made."""

from __future__ import annotations

import pickle
import warnings

import numpy as np
import pytest

import dartsweep as ds

CUBE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)


def _beside(*parts: tuple[tuple[float, float, float], float]) -> tuple[np.ndarray, np.ndarray]:
    """A unit cube and others of a place and a size, each with points of its own."""
    points = np.concatenate([CUBE] + [np.asarray(place) + size * CUBE for place, size in parts])
    return points, np.arange(len(points)).reshape(-1, 8)


def _passes(environment: ds.Environment) -> bool:
    return environment.cast((0.25, 0.5, 0.5), (1.375, 0.375, 0.25)).outcome == ds.Outcome.REACHED


def test_points_are_merged_within_a_distance() -> None:
    points, cells = _beside(((1 + 1e-10, 0, 0), 1))
    for distance, parts in ((0.0, 2), (1e-9, 1)):
        with ds.Environment(points, cells, merge_points=distance, inner_walls=True) as environment:
            assert environment.info.part_count == parts
            assert _passes(environment) == (parts == 1)


def test_a_gap_of_rounding_is_told() -> None:
    points, cells = _beside(((1 + 1e-12, 0, 0), 1))
    for options in ({}, {"merge_points": 0.0}, {"conform": True}):
        with pytest.warns(UserWarning, match="^the mesh has several parts, and 4 points lie within 2e-09 of others"):
            ds.Environment(points, cells, **options).close()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for gap, options in ((1e-12, {"inner_walls": True}), (1e-12, {"merge_points": 2e-9}), (1e-6, {})):
            points, cells = _beside(((1 + gap, 0, 0), 1))
            ds.Environment(points, cells, **options).close()


def test_faces_that_smaller_ones_cover_are_split() -> None:
    points, cells = _beside(*[((1, y, z), 0.5) for y in (0, 0.5) for z in (0, 0.5)])
    with ds.Environment(points, cells, inner_walls=True) as loose:
        assert loose.info.part_count == 5 and not _passes(loose)
    with ds.Environment(points, cells, conform=True) as environment:
        assert environment.info.part_count == 1 and _passes(environment)
        assert environment.volume_counts(environment.volume_id(0)).faces == 9
        environment.check()


def test_faces_that_cross_are_refused() -> None:
    points, cells = _beside(((1, 0.25, 0.25), 1))
    with pytest.raises(ds.errors.NotConforming, match="faces of cells 0 and 1 overlap"):
        ds.Environment(points, cells, conform=True)


def test_parts_that_touch_need_a_word() -> None:
    points, cells = _beside(((1, 0, 0), 1))
    with pytest.raises(ds.errors.TouchingParts, match="^2 faces of the boundary .* first face 1 of cell 0, on face 0 of cell 1; merge_points") as caught:
        ds.Environment(points, cells)
    assert isinstance(pickle.loads(pickle.dumps(caught.value)), ds.errors.TouchingParts)
    for options in ({"inner_walls": True}, {"merge_points": 0.0}, {"conform": True}):
        ds.Environment(points, cells, **options).close()
    points, cells = _beside(((1.5, 0, 0), 1))
    ds.Environment(points, cells).close()
    points, cells = _beside(*[((1, y, z), 0.5) for y in (0, 0.5) for z in (0, 0.5)])
    with pytest.raises(ds.errors.TouchingParts, match="^5 faces"):  # the small cubes are sewn to each other
        ds.Environment(points, cells, merge_points=0.0)
    ds.Environment(points, cells, merge_points=0.0, inner_walls=True).close()


def test_files_with_parts_that_touch_are_read_with_an_option() -> None:
    meshio = pytest.importorskip("meshio")
    points, cells = _beside(*[((1, y, z), 0.5) for y in (0, 0.5) for z in (0, 0.5)])
    mesh = meshio.Mesh(points, [("hexahedron", cells)])
    with pytest.raises(ds.errors.MeshError, match="13 faces of the boundary .* conform=True"):
        ds.from_meshio(mesh)
    with ds.from_meshio(mesh, conform=True) as environment:
        assert environment.info.part_count == 1 and _passes(environment)
    with ds.from_meshio(mesh, inner_walls=True) as environment:
        assert environment.info.part_count == 5
