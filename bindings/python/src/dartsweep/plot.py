"""Pictures by PyVista (the extra `plot`): environments, bodies and contacts as its meshes, and a plot of a scene.

PyVista draws, slices and saves what is made here; without a display too (`off_screen=True`, `screenshot`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pyvista
from numpy.typing import NDArray

from ._door import own, vtk_data
from .body import Body
from .enums import CellType
from ._shapes import Records
from .environment import Environment
from .scene import Scene
from .trace import Trace


def grid(environment: Environment) -> pyvista.UnstructuredGrid:
    """The volumes of an environment where they are now, with `volume` (its index), `region`, `tag`, `marked` (by its own mark) and
    `impassable` of each. Wedges are numbered as in the installed VTK. Names and the marks of faces, edges and vertices are fields. A file of it, in .vtu, .vtk or .vtkhdf, is read as
    the same environment.

    For pictures and files: every volume is asked for, one by one.
    """
    volumes = list(own.volumes_of(environment))
    cells, types = [], []
    for volume in volumes:
        counts = environment.volume_counts(volume)
        if counts.type == CellType.POLYHEDRON:
            faces = [environment.vertices(environment.face_id(volume, i))["index"] for i in range(counts.faces)]
            cell = np.concatenate([[len(faces)], *(np.insert(face, 0, len(face)) for face in faces)])
        else:
            cell = environment.vertices(volume)["index"]
            cell = vtk_data.wedge(cell) if counts.type == CellType.WEDGE else cell
        cells.append(np.insert(cell.astype(np.int64), 0, len(cell)))
        types.append(counts.type)
    made = pyvista.UnstructuredGrid(np.concatenate(cells), np.array(types, np.uint8), _in_space(environment.points()))
    made.cell_data["volume"] = [volume.index for volume in volumes]
    made.cell_data["region"] = [environment.region(volume) for volume in volumes]
    made.cell_data["tag"] = [environment.tag(volume) for volume in volumes]
    for name, is_so in (("marked", environment.is_marked), ("impassable", environment.is_impassable)):
        made.cell_data[name] = np.array([is_so(volume) for volume in volumes], np.uint8)  # files have no truth values
    for name, array in own.fields_of(environment).items():
        made.field_data[name] = array
    return made


def walls(environment: Environment, with_boundary: bool = True) -> pyvista.PolyData:
    """Triangles of all walls that border passable volumes; in the plane lines."""
    trace = Trace()
    trace.add_impassable(environment, with_boundary)
    if environment.dimension == 2:
        return pyvista.PolyData(trace.points, lines=_polygons(trace.segments[0]))
    return pyvista.PolyData(trace.points, faces=_polygons(trace.triangles[0]))


def body(body: Body) -> pyvista.PolyData:
    """A body where it is now: its triangles, or its edges where it has none. Points keep their indices."""
    points = _in_space(body.positions())
    if body.counts.face_count != 0:
        return pyvista.PolyData(points, faces=_polygons(body.face_indices()))
    return pyvista.PolyData(points, lines=_polygons(body.edge_indices()))


def contacts(contacts: Records) -> pyvista.PolyData:
    """Points of contact (dtypes.BODY_CONTACT, SWEEP or WALL_CONTACT), with `normal` and `time` of each."""
    made = pyvista.PolyData(np.ascontiguousarray(contacts["point"]))
    if len(contacts) != 0:  # PyVista has no empty arrays
        made.point_data["normal"] = contacts["contact"]["normal"]
        made.point_data["time"] = contacts["time"]
    return made


def draw(scene: Scene, plotter: pyvista.Plotter | None = None) -> pyvista.Plotter:
    """Adds the walls of a scene, its bodies and the contacts of their last moves to a plotter, a new one by default. The plane is seen from
    above."""
    plotter = pyvista.Plotter() if plotter is None else plotter
    is_planar = scene.environment.dimension == 2
    plotter.add_mesh(walls(scene.environment), color="lightcoral", opacity=1.0 if is_planar else 0.25, line_width=2)
    size = float(np.ptp(scene.environment.points(), axis=0).max())
    for number in scene.body_ids():
        moved = scene.body(number)
        plotter.add_mesh(body(moved), color="steelblue" if moved.counts.face_count else "black", line_width=4)
        met = moved.contacts()
        if len(met) != 0:
            plotter.add_mesh(contacts(met), color="gold", point_size=10, render_points_as_spheres=True)
            plotter.add_arrows(met["point"], met["contact"]["normal"], mag=0.05 * size, color="gold")
    if is_planar:
        plotter.view_xy()
    return plotter


def _in_space(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """PyVista's points have three coordinates."""
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def _polygons(corners: NDArray[np.uint32]) -> NDArray[np.int64]:
    """VTK's cells: their sizes among the indices; those of free slots left out."""
    used = corners[corners[:, 0] != np.iinfo(np.uint32).max].astype(np.int64)
    made: NDArray[np.int64] = np.insert(used, 0, used.shape[1], axis=1).ravel()
    return made
