"""Polyhedra in files of Fluent (cells of type 7), as text and in binary, alone and beside hexahedra."""

from __future__ import annotations

import pathlib

import numpy as np
import pytest

import dartsweep as ds
from volumes import volume_of

pytest.importorskip("vtkmodules")

HEXAGON = [(2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2)]
POINTS = [(x, y, z) for z in (0, 1, 2) for x, y in HEXAGON]
INTERIOR, WALL, INLET, OUTLET = 2, 3, 10, 5


def _zones(turned: bool) -> dict[str, tuple[int, list[tuple[list[int], int, int]]]]:
    """Faces of two hexagonal prisms, one on the other: points from 1 on, and the cells on both sides."""
    ring = [list(range(6 * level + 1, 6 * level + 7)) for level in range(3)]
    sides = [([6 * c + k + 1, 6 * c + (k + 1) % 6 + 1, 6 * c + (k + 1) % 6 + 7, 6 * c + k + 7], c + 1, 0) for c in (0, 1) for k in range(6)]
    found = {"inner": (INTERIOR, [(ring[1], 1, 2)]), "low": (INLET, [(ring[0][::-1], 1, 0)]), "high": (OUTLET, [(ring[2], 2, 0)]), "side": (WALL, sides)}
    return {name: (kind, [(face[::-1] if turned else face, a, b) for face, a, b in faces]) for name, (kind, faces) in found.items()}


def _write(path: pathlib.Path, turned: bool, cells: str, binary: bool) -> None:
    """A case of Fluent; cells: its section of cells."""
    out = [b"(2 3)", b"(4 (60 0 0 1 2 4 4 4 8 8 4))", f"(10 (0 1 {len(POINTS):x} 0 3))".encode()]
    head = f"(1 1 {len(POINTS):x} 1 3)"
    if binary:
        out.append(f"(3010 {head}(".encode() + np.array(POINTS, "<f8").tobytes() + b")\nEnd of Binary Section   3010)")
    else:
        out.append(f"(10 {head}(\n".encode() + "\n".join(" ".join(map(str, p)) for p in POINTS).encode() + b"\n))")
    out += [b"(12 (0 1 2 0))", cells.encode()]
    zones, first = _zones(turned), 1
    out.append(f"(13 (0 1 {sum(len(faces) for _, faces in zones.values()):x} 0))".encode())
    for zone, (kind, faces) in enumerate(zones.values(), 3):
        head, rows = f"({zone:x} {first:x} {first + len(faces) - 1:x} {kind:x} 5)", [[len(face), *face, a, b] for face, a, b in faces]
        first += len(faces)
        if binary:
            out.append(f"(2013 {head}(".encode() + np.array([n for row in rows for n in row], "<i4").tobytes() + b")\nEnd of Binary Section   2013)")
        else:
            out.append(f"(13 {head}(\n".encode() + "\n".join(" ".join(f"{n:x}" for n in row) for row in rows).encode() + b"\n))")
    out.append(b"(45 (2 fluid lumen)())")
    names = {INTERIOR: "interior", WALL: "wall", INLET: "velocity-inlet", OUTLET: "pressure-outlet"}
    out += [f"(45 ({zone} {names[kind]} {name})())".encode() for zone, (name, (kind, _)) in enumerate(zones.items(), 3)]
    path.write_bytes(b"\n".join(out) + b"\n")


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("cells", ["(12 (2 1 2 1 7))", "(12 (2 1 2 1 0)(\n7 7\n))"])
@pytest.mark.parametrize("ending", ["msh", "cas"])
def test_polyhedra_of_fluent(ending: str, cells: str, turned: bool, binary: bool, tmp_path: pathlib.Path) -> None:
    _write(tmp_path / f"prisms.{ending}", turned, cells, binary)
    with ds.read(tmp_path / f"prisms.{ending}") as made:
        assert made.info.volume_count == 2 and made.info.part_count == 1 and made.info.boundary_face_count == 14
        assert [made.volume_counts(made.volume_id(i)).type for i in (0, 1)] == [ds.CellType.POLYHEDRON] * 2
        assert volume_of(made) == pytest.approx(24)
        assert {name: len(made.faces(name)) for name in made.surface_names} == {"low": 1, "high": 1, "side": 12}
        assert made.region_names == {"lumen": 1}
        flight = made.cast((0, 0, 0.5), (0, 0, 3))
        assert flight.position[2] == 2 and made.surfaces_of(flight.contact.wall)[1] == "high"
