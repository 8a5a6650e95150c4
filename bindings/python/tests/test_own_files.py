"""What plot.grid makes, written to files and read again: the same environment."""

from __future__ import annotations

import pathlib
from typing import Any

import numpy as np
import pytest
import pyvista

import dartsweep as ds
from dartsweep import plot
from dartsweep._door.build import environment_of
from scenario import create_plane
from test_names import block, mesh

ENDINGS = [".vtu", ".vtk", pytest.param(".vtkhdf", marks=pytest.mark.skipif(not hasattr(pyvista, "HDFWriter"), reason="PyVista writes no VTKHDF"))]


def state(environment: ds.Environment) -> dict[str, Any]:
    """All that a file should keep. Cells and faces are named by vertices."""
    volumes = [environment.volume_id(i) for i in range(environment.info.volume_index_count)]
    faces = [[environment.face_id(volume, i) for i in range(environment.volume_counts(volume).faces)] for volume in volumes]

    def corners(cell: Any) -> list[int]:
        return sorted(environment.vertices(cell)["index"].tolist())

    return {
        "points": environment.points().tolist(),
        "types": [environment.volume_counts(volume).type for volume in volumes],
        "cells": [environment.vertices(volume)["index"].tolist() for volume in volumes],
        "faces": [[environment.vertices(face)["index"].tolist() for face in each] for each in faces],
        "regions": [environment.region(volume) for volume in volumes],
        "tags": [environment.tag(volume) for volume in volumes],
        "marked": [environment.is_marked(volume) for volume in volumes],
        "marked faces": sorted({tuple(corners(face)) for each in faces for face in each if environment.is_marked(face)}),
        "marks": [environment.mark_count(kind) for kind in ds.CellKind if kind and (kind != ds.CellKind.EDGE or environment.dimension == 3)],
        "exits": sorted((corners(face), environment.exit_of(face)) for face in environment.exit_faces()),
        "region groups": environment.region_groups,
        "surface names": environment.surface_names,
        "surfaces": {name: sorted(corners(face) for face in environment.faces(name)) for name in environment.surface_names},
        "plane": None if environment.plane is None else [array.tolist() for array in environment.plane],
    }


def every_type() -> ds.Environment:
    """A hexahedron, a pyramid on it, a tetrahedron beside that, a wedge, and a polyhedron, which a cut makes of another hexahedron."""
    points = [(float(x), float(y), float(z)) for z in (0, 1) for y in (0, 1) for x in (0, 1, 2, 3)]
    points += [(0.5, 0.5, 2.0), (1.5, 0.5, 2.25)]
    cells: list[tuple[ds.CellType, list[int]]] = [
        (ds.CellType.HEXAHEDRON, [0, 1, 5, 4, 8, 9, 13, 12]),
        (ds.CellType.HEXAHEDRON, [1, 2, 6, 5, 9, 10, 14, 13]),
        (ds.CellType.PYRAMID, [8, 9, 13, 12, 16]),
        (ds.CellType.TETRA, [9, 13, 16, 17]),
        (ds.CellType.PYRAMID, [9, 10, 14, 13, 17]),
        (ds.CellType.WEDGE, [2, 3, 10, 6, 7, 14]),
    ]
    made = ds.Environment(
        np.array(points, float), np.concatenate([cell for _, cell in cells]), [kind for kind, _ in cells], np.cumsum([0, *(len(cell) for _, cell in cells)]),
        regions=[5, 5, -2, 7, 7, 9], tags=[1, 2, 2**32 - 1, 3, 4, 5], flags=ds.EnvironmentFlag.REORIENT,
        region_names={"box": 5, "roof": (-2, 7), "größe mit Raum": 9},
    )  # fmt: skip
    assert {made.volume_counts(made.volume_id(i)).type for i in range(6)} == {kind for kind, _ in cells}
    made.cut([[(1.4, -1.0, -1.0), (1.4, 2, -1)], [(1.6, -1.0, 3.0), (1.6, 2, 3)]])
    made.mark_volumes(made.locate((2.6, 0.5, 0.25))[0])
    made.mark_faces(made.face_id(made.locate((0.5, 0.5, 0.5))[0], 1))
    made.mark_exits([face for face in all_faces(made) if all(v < 8 for v in made.vertices(face)["index"])], 3)
    made.mark_exits(made.cast((0.5, 0.5, 0.5), (-9, 0.5, 0.5)).contact.wall, 2**32 - 1)
    made.mark_edges(made.find_edges([(0, 8), (16, 17)]))
    made.mark_vertices(made.vertex_id(3))
    made.name_surface("bottom", [face for face in all_faces(made) if all(v < 8 for v in made.vertices(face)["index"])], 77)
    made.name_surface("inner wall", [made.cast((0.5, 0.5, 0.5), (0.5, 9, 0.5)).contact.wall])
    return made


def all_faces(environment: ds.Environment) -> list[Any]:
    volumes = [environment.volume_id(i) for i in range(environment.info.volume_count)]
    return [environment.face_id(volume, i) for volume in volumes for i in range(environment.volume_counts(volume).faces)]


@pytest.mark.parametrize("ending", ENDINGS)
def test_every_type_comes_back(tmp_path: pathlib.Path, ending: str) -> None:
    path = str(tmp_path / f"own{ending}")
    with every_type() as environment:
        assert ds.CellType.POLYHEDRON in state(environment)["types"]
        plot.grid(environment).save(path)
        with ds.meshes.read(path) as again:
            assert state(again) == state(environment)
            assert again.info.boundary_face_count == environment.info.boundary_face_count


@pytest.mark.parametrize("ending", ENDINGS)
def test_names_and_groups_come_back(tmp_path: pathlib.Path, ending: str) -> None:
    path = str(tmp_path / f"own{ending}")
    with environment_of(mesh(cell_groups={"all": np.arange(16), "low": np.arange(3)}), None, {}) as environment:
        environment.mark_region("low")
        environment.mark_surface("outlet")
        plot.grid(environment).save(path)
        with ds.meshes.read(path) as again:
            assert state(again) == state(environment)
            assert again.surfaces_of(again.cast((1, 1.25, 2.25), (1, 1.25, 9)))["name"] == "outlet"


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_plane_comes_back(tmp_path: pathlib.Path, ending: str) -> None:
    path = str(tmp_path / f"own{ending}")
    with create_plane() as environment:
        environment.mark_region(2)
        environment.name_surface("door", [environment.cast((40, 40), (40, 999)).contact.wall])
        plot.grid(environment).save(path)
        with ds.meshes.read(path) as again:
            assert again.dimension == 2 and state(again) == state(environment)


def test_where_a_plane_lay_comes_back(tmp_path: pathlib.Path) -> None:
    path = str(tmp_path / "own.vtu")
    points, _ = block((2, 2, 0))
    made = mesh()
    made = type(made)(points[:, [0, 2, 1]] + (0, 5, 0), np.full(4, 9, np.uint8), np.arange(0, 17, 4), np.array([0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7]))
    with environment_of(made, None, {}) as environment:
        plot.grid(environment).save(path)
        with ds.meshes.read(path) as again:
            assert state(again) == state(environment) and again.plane is not None and again.plane.origin.tolist() == [0, 5, 0]


def test_what_removed_cells_leave(tmp_path: pathlib.Path) -> None:
    path = str(tmp_path / "own.vtu")
    with environment_of(mesh(), None, {}) as environment:
        environment.remove_volumes([environment.volume_id(5)])
        plot.grid(environment).save(path)
        with ds.meshes.read(path) as again:
            assert again.info.volume_count == 15
            assert {name: len(again.faces(name)) for name in again.surface_names} == {
                name: len(environment.faces(name)) for name in environment.surface_names
            }


def test_a_damaged_field_is_an_error(tmp_path: pathlib.Path) -> None:
    path = str(tmp_path / "own.vtu")
    with environment_of(mesh(), None, {}) as environment:
        grid = plot.grid(environment)
    grid.field_data["dartsweep"] = np.array(grid.field_data["dartsweep"])[:-5]
    grid.save(path)
    with pytest.raises(ds.errors.MeshError, match=r"own.vtu'.*field 'dartsweep' is damaged.*"):
        ds.meshes.read(path)
