"""python releases.py write FOLDER | read FOLDER: wedges, prisms and polyhedra, written and read by the VTK that is found first. Prints what is read."""

from __future__ import annotations

import json
import pathlib
import sys
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import dartsweep as ds
from volumes import CUBE, CUBE_FACES, PRISM, content, volume_of

AS_IN_GMSH = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 7)
LOWER, UPPER = ([0, 1, 2], [3, 4, 5]) if AS_IN_GMSH else ([0, 2, 1], [3, 5, 4])


def grid(points: Any, cells: list[tuple[int, Any]]) -> vtkUnstructuredGrid:
    """Cells of one type each; polyhedra are lists of faces."""
    made, places = vtkUnstructuredGrid(), vtkPoints()
    places.SetData(numpy_to_vtk(np.array(points, float), deep=True))
    made.SetPoints(places)
    for kind, corners in cells:
        ids = vtkIdList()
        stream = [len(corners), *(number for face in corners for number in (len(face), *face))] if kind == 42 else corners
        for number in stream:
            ids.InsertNextId(int(number))
        made.InsertNextCell(kind, ids)
    return made


def prism_with_nodes() -> tuple[Any, list[int]]:
    """A wedge of 15 nodes in the order of the installed VTK."""
    corners = [*LOWER, *UPPER]
    pairs = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
    middles = [(PRISM[corners[a]] + PRISM[corners[b]]) / 2 for a, b in pairs]
    return [*PRISM, *middles], [*corners, *range(6, 15)]


def grids() -> dict[str, vtkUnstructuredGrid]:
    turned = [face[::-1] if i % 2 else face for i, face in enumerate(CUBE_FACES)]
    angles = 2 * np.pi * np.arange(6) / 6
    prism = [(np.cos(a), np.sin(a), z) for z in (0, 1) for a in angles]
    return {
        "wedge": grid(PRISM, [(13, [*LOWER, *UPPER])]),
        "wedge15": grid(prism_with_nodes()[0], [(26, prism_with_nodes()[1])]),
        "polyhedron": grid([*CUBE, *(CUBE + (1, 0, 0))], [(42, turned), (12, range(8, 16))]),
        "prism": grid(prism, [(16, range(12))]),
        "voxel": grid(CUBE[[0, 1, 3, 2, 4, 5, 7, 6]], [(11, range(8))]),
    }


def main(what: str, folder: pathlib.Path) -> None:
    version = vtkVersion.GetVTKVersion()
    if what == "write":
        for name, made in grids().items():
            for writer, ending in ((vtkXMLUnstructuredGridWriter(), "vtu"), (vtkUnstructuredGridWriter(), "vtk")):
                writer.SetInputData(made)
                if ending == "vtk":
                    writer.SetFileTypeToBinary()  # as text it has 11 digits
                writer.SetFileName(str(folder / f"{name}-{version}.{ending}"))
                writer.Write()
        return
    found = {}
    for path in sorted(folder.glob("*.vt?")):
        try:
            with ds.read(path, inner_walls=True) as environment:
                found[path.name] = [volume_of(environment), len(environment.notes), content(environment)]
        except ds.MeshError as error:
            found[path.name] = [str(error)]
    print(json.dumps({"version": version, "read": found}))


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
