from __future__ import annotations

import ast
import pathlib

import meshio  # type: ignore[import-untyped]
import numpy as np
import pytest
from mypy import api

import dartsweep as ds
from dartsweep import _core
from scenario import vessel

ROOT = pathlib.Path(__file__).parents[3]
PYTHON = ROOT / "bindings" / "python"
OF_SWIG = {"acquire", "append", "disown", "next", "own"}  # in every class


def test_types_are_complete() -> None:
    """The package, these tests and the examples, as strict as mypy can be."""
    sources = [str(PYTHON / "tests"), *map(str, (PYTHON / "examples").glob("*.py"))]
    for arguments in (["-p", "dartsweep"], sources):
        out, _, status = api.run(["--strict", "--cache-dir", "/dev/null", "--config-file", str(PYTHON / "pyproject.toml"), *arguments])
        assert status == 0, out


def test_stubs_are_those_of_the_module() -> None:
    stub = ast.parse((PYTHON / "src" / "dartsweep" / "_core.pyi").read_text())
    classes = [node for node in stub.body if isinstance(node, ast.ClassDef)]
    assert len(classes) > 50
    for node in classes:
        told = {item.target.id for item in node.body if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name)}
        members = {name for name in dir(getattr(_core, node.name)) if not name.startswith("_")}
        assert told == members - {"this", "thisown", "is_null"} - OF_SWIG, node.name


def test_version() -> None:
    assert f"project(Dartsweep VERSION {ds.version()} " in (ROOT / "CMakeLists.txt").read_text()
    assert f'version = "{ds.version()}"' in (PYTHON / "pyproject.toml").read_text()


def test_meshes_of_meshio() -> None:
    points, cells, regions = vessel()
    tetra = [[0, 1, 2, 3]]
    extra = np.array([[100.0, 0, 0], [101, 0, 0], [100, 1, 0], [100, 0, 1]])
    mesh = meshio.Mesh(
        np.concatenate([points, extra]),
        [("hexahedron", cells), ("triangle", [[0, 1, 2]]), ("tetra", np.array(tetra) + len(points))],
        cell_data={"region": [regions, np.array([9]), np.array([3])]},
    )
    with ds.from_meshio(mesh) as environment:
        assert environment.info.volume_count == len(cells) + 1 and environment.info.part_count == 2
        assert environment.region(environment.volume(len(cells))) == 3
        assert environment.counts(environment.volume(len(cells))).type == ds.CellType.TETRA
        assert environment.mark_region(2)[0] == int(np.sum(regions == 2))
    with pytest.raises(ValueError, match="no volume cells"):
        ds.from_meshio(meshio.Mesh(points, [("triangle", [[0, 1, 2]])]))
    with pytest.raises(ValueError, match="tetra10"):
        ds.from_meshio(meshio.Mesh(points, [("tetra10", [list(range(10))])]))


def test_coarsening_and_traces() -> None:
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])
    with ds.Environment(corners, [[0, 1, 2, 3], [1, 2, 3, 4]], flags=ds.EnvironmentFlag.REORIENT) as environment:
        coarse, volumes = environment.coarsen()
        assert coarse.info.volume_count == 1 and volumes.tolist() == [0, 0]
        trace = ds.Trace()
        trace.add_impassable(environment, label=7)
        triangles, labels = trace.triangles
        assert triangles.shape == (6, 3) and set(labels) == {7} and len(trace.points) >= 5
        trace.clear()
        assert len(trace.points) == 0
