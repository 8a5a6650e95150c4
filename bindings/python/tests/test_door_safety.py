"""Gmsh reads a large file in the caller's process only if the file is whole; and what a process of its own needs."""

from __future__ import annotations

import pathlib
import struct
import sys
from typing import Any

import numpy as np
import pytest

import dartsweep as ds
from dartsweep._door import apart, gmsh_reader, msh_walk


@pytest.fixture
def boxes(tmp_path: pathlib.Path) -> dict[str, pathlib.Path]:
    """A box of tetrahedra as binary and as text, of two versions, with names."""
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [1], 7, "lumen")
        gmsh.model.addPhysicalGroup(2, [1, 2], 8, "wall")
        gmsh.model.mesh.generate(3)
        found = {}
        for name, version, binary in (("binary", 4.1, 1), ("text", 4.1, 0), ("old", 2.2, 1)):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            gmsh.option.setNumber("Mesh.Binary", binary)
            found[name] = tmp_path / f"{name}.msh"
            gmsh.write(str(found[name]))
    finally:
        gmsh.finalize()
    return found


@pytest.mark.cold
def test_only_whole_binary_files_are_read_in_the_process(boxes: dict[str, pathlib.Path], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gmsh_reader, "_LARGE", 0)
    apart = {name: gmsh_reader.is_apart(str(path), "msh") for name, path in boxes.items()}
    assert apart == {"binary": False, "text": True, "old": True}
    read = [ds.read(path) for path in boxes.values()]
    assert len({made.info.volume_count for made in read}) == 1
    assert all(made.region_names == {"lumen": 7} and len(made.faces("wall")) > 0 for made in read)


def _number(data: bytes, section: bytes, at: int, layout: str, value: int) -> bytes:
    """The file with another number so many bytes behind the name of a section."""
    place = data.index(section) + len(section) + 1 + at
    return data[:place] + struct.pack(layout, value) + data[place + struct.calcsize(layout) :]


DAMAGES: dict[str, Any] = {
    "cut short": lambda data: data[: len(data) // 2],
    "the last section is missing": lambda data: data[: data.index(b"$Elements")],
    "a section of which nothing is known": lambda data: data + b"$Strange\n\n$EndStrange\n",
    "a section twice": lambda data: data + data[data.index(b"$Elements") :],
    "more entities than there are": lambda data: _number(data, b"$Entities", 16, "<Q", 1 << 60),
    "more blocks of nodes than there are": lambda data: _number(data, b"$Nodes", 0, "<Q", 1 << 40),
    "a node fewer than it says": lambda data: _number(data, b"$Nodes", 8, "<Q", struct.unpack_from("<Q", data, data.index(b"$Nodes") + 15)[0] + 1),
    "a node beyond the largest": lambda data: _number(data, b"$Nodes", 32 + 20, "<Q", 1 << 62),
    "an element fewer than it says": lambda data: _number(data, b"$Elements", 8, "<Q", 3),
    "elements of an unknown type": lambda data: _number(data, b"$Elements", 32 + 8, "<i", 9999),
    "an element with a node that is not there": lambda data: _number(data, b"$Elements", 32 + 20 + 8, "<Q", 1 << 40),
    "more elements in a block than the file has": lambda data: _number(data, b"$Elements", 32 + 12, "<Q", 1 << 59),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_large_file_is_read_apart(damage: str, boxes: dict[str, pathlib.Path], monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path) -> None:
    monkeypatch.setattr(gmsh_reader, "_LARGE", 0)
    path = tmp_path / "damaged.msh"
    path.write_bytes(DAMAGES[damage](boxes["binary"].read_bytes()))
    assert msh_walk.is_whole(str(boxes["binary"]))
    assert gmsh_reader.is_apart(str(path), "msh")
    try:
        ds.read(path)
    except ds.MeshError as error:
        assert "damaged.msh" in str(error)


@pytest.mark.cold
def test_a_process_of_its_own_needs_no_compiled_library(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The demo reads meshes with the sources of the package alone: here only NumPy is beside them."""
    for name in ("numpy", "numpy.libs"):
        folder = pathlib.Path(np.__file__).parents[1] / name
        if folder.exists():
            (tmp_path / name).symlink_to(folder)
    monkeypatch.setattr(sys, "path", [str(tmp_path), *(each for each in sys.path if "-packages" not in each)])
    file = tmp_path / "tetrahedron.off"
    file.write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
    assert len(apart.read("NumPy", "dartsweep._door.off_reader", str(file), "the file", "off").cells.types) == 4
