from __future__ import annotations

import ast
import inspect
import pathlib
from typing import Any

import numpy as np
from mypy import api

import dartsweep as ds
from dartsweep import _core, plot, rod

ROOT = pathlib.Path(__file__).parents[3]
PYTHON = ROOT / "bindings" / "python"
OF_SWIG = {"acquire", "append", "disown", "next", "own"}  # in every class


def test_types_are_complete(tmp_path: pathlib.Path) -> None:
    """The package, these tests and the examples, as strict as mypy can be. What both runs read of other packages is kept for the second."""
    sources = [str(PYTHON / "tests"), *map(str, (PYTHON / "examples").glob("*.py"))]
    for arguments in (["-p", "dartsweep"], sources):
        out, _, status = api.run(["--strict", "--cache-dir", str(tmp_path), "--config-file", str(PYTHON / "pyproject.toml"), *arguments])
        assert status == 0, out
    assert pathlib.Path(ds.__file__).with_name("py.typed").exists()


def test_stubs_are_those_of_the_module() -> None:
    stub = ast.parse(pathlib.Path(_core.__file__).with_name("_core.pyi").read_text())
    classes = [node for node in stub.body if isinstance(node, ast.ClassDef)]
    assert len(classes) > 50
    for node in classes:
        told = {item.target.id for item in node.body if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name)}
        members = {name for name in dir(getattr(_core, node.name)) if not name.startswith("_")}
        assert told == members - {"this", "thisown", "is_null"} - OF_SWIG, node.name


def test_everything_has_words() -> None:
    classes = [item for item in vars(ds).values() if inspect.isclass(item) and item.__module__.startswith("dartsweep")]
    named: dict[str, Any] = {item.__name__: item for item in classes}
    owners: list[Any] = [*classes, ds, ds.meshes, ds.surfaces, plot, rod, rod.Rod]
    for owner in owners:
        for name, value in vars(owner).items():
            if not name.startswith("_") and (inspect.isfunction(value) or isinstance(value, (property, classmethod))):
                named[f"{owner.__name__}.{name}"] = value
    assert len(named) > 150 and [name for name, value in named.items() if not value.__doc__] == []


def test_version() -> None:
    assert f"project(Dartsweep VERSION {ds.version()} " in (ROOT / "CMakeLists.txt").read_text()
    assert f'version = "{ds.version()}"' in (PYTHON / "pyproject.toml").read_text()


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
