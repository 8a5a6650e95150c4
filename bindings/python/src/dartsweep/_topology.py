"""Changes of the topology of an environment: sewing, splitting and merging of cells, cuts, and what the last change was."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._core import BodyId, Change, EdgeId, FaceId, VertexId, VolumeId
from ._names import changes_topology
from ._shapes import IdOrIds, Ids, Records, kind_of_rows, rows_of
from .options import options as described


class Topology:
    """The methods of an environment that change its cells, not only their marks or places."""

    __slots__ = ()
    _core: Any

    @changes_topology
    def sew_faces(self, a: Ids, b: Ids) -> None:
        """Two faces on the outer boundary with the same vertices become one, for each pair."""
        self._core.sew_faces(a, b)

    @changes_topology
    def unsew_face(self, face: Any) -> None:
        """One face between two volumes becomes two faces of the outer boundary, which nothing passes."""
        self._core.unsew_face(face)

    @changes_topology
    def remove_volumes(self, volumes: IdOrIds) -> None:
        """Removes volumes; the faces that they shared with others are then on the outer boundary."""
        self._core.remove_volumes(volumes)

    @changes_topology
    def merge_volumes(self, face: Any) -> VolumeId:
        """Merges the two volumes of a face."""
        return self._core.merge_volumes(face)  # type: ignore[no-any-return]

    @changes_topology
    def split_volume(self, volume: Any, loop: Ids) -> tuple[VolumeId, VolumeId, FaceId]:
        """Splits a volume along a loop of its vertices: the part to the left, the other, the new face."""
        parts = self._core.split_volume(volume, loop)
        return parts.left, parts.right, parts.face

    @changes_topology
    def merge_faces(self, edge: Any) -> FaceId:
        """Merges the two faces of an edge that has no others."""
        return self._core.merge_faces(edge)  # type: ignore[no-any-return]

    @changes_topology
    def split_face(self, face: Any, a: Any, b: Any) -> tuple[FaceId, FaceId, EdgeId]:
        """Splits a face between two of its vertices: the part from a to b, the other, the new edge."""
        parts = self._core.split_face(face, a, b)
        return parts.left, parts.right, parts.edge

    @changes_topology
    def split_edge(self, edge: Any, edge_parameter: float = 0.5) -> tuple[VertexId, EdgeId, EdgeId]:
        """Splits an edge, in the plane a side by an EdgeId: the new vertex, and the parts at the first and the second of its vertices.
        The parameter is the place on the edge, 0 to 1 from its first vertex."""
        parts = self._core.split_edge(edge, edge_parameter)
        return parts.vertex, parts.first, parts.second

    @changes_topology
    def merge_edges(self, edge: Any, vertex: Any) -> EdgeId:
        """Merges the two edges of a vertex that has no others, and removes the vertex."""
        return self._core.merge_edges(edge, vertex)  # type: ignore[no-any-return]

    @changes_topology
    def collapse_edge(self, edge: Any, vertex: Any) -> None:
        """Merges an end of an edge, `vertex`, into the other."""
        self._core.collapse_edge(edge, vertex)

    @changes_topology
    def add_volumes(
        self, vertices: Ids, points: ArrayLike, cells: ArrayLike, *, regions: ArrayLike | None = None,
        tags: ArrayLike | None = None, sew_to: Ids | None = None,
    ) -> Records:
        """Adds cells of one type, as in the constructor, of vertices (0 .. len(vertices) - 1) and new points (from there on)."""
        cells = np.asarray(cells)
        kind, types, offsets = kind_of_rows(cells, self._core.dimension())
        desc = described(_core.VolumesDesc, uniform_cell_type=int(kind))
        return self._core.add_volumes(vertices, points, cells, offsets, types, regions, tags, sew_to, desc)  # type: ignore[no-any-return]

    @changes_topology
    def cut(self, blade: ArrayLike, *, flags: int = 0, start: Any = None, snap: float = 0.0) -> Change:
        """Cuts along the surface that a blade sweeps: points of shape (rows, columns, 3); in the plane along a line of points (n, 2)."""
        blade = np.ascontiguousarray(blade, np.float64)
        if self._core.dimension() == 2 and blade.ndim == 2:
            blade = blade[:, np.newaxis]
        if blade.ndim != 3:
            raise ValueError("a blade has shape (rows, columns, 3), or (n, 2) in the plane")
        desc = described(_core.CutDesc, flags=int(flags), snap=snap)
        if start is not None:
            desc.start = start
        return self._core.cut(blade.reshape(-1, blade.shape[2]), blade.shape[0], blade.shape[1], desc)  # type: ignore[no-any-return]

    @changes_topology
    def tear_faces(self, faces: Ids, loads: ArrayLike, threshold: float) -> Change:
        """Unsews faces with a load above the threshold; the change has them in `faces`."""
        return self._core.tear_faces(faces, loads, threshold)  # type: ignore[no-any-return]

    @changes_topology
    def open_crack(self, faces: Records, width: float, *, region: int = 0, tag: int = 0) -> Change:
        """Opens a crack (faces as in `faces` of a change) by a width."""
        desc = described(_core.OpenCrackDesc, width=width, region=region, tag=tag)
        return self._core.open_crack(faces, desc)  # type: ignore[no-any-return]

    @changes_topology
    def carve(
        self, points: ArrayLike, triangles: ArrayLike, *, flags: int = 0, start: Any = None, snap: float = 0.0, finest: float = 0.0
    ) -> Change:
        """Makes the inside of a closed surface passable; in the plane `triangles` are segments, (n, 2), of closed lines."""
        desc = described(_core.CarveDesc, flags=int(flags), snap=snap, finest=finest)
        if start is not None:
            desc.start = start
        return self._core.carve(points, rows_of(triangles, self._core.dimension(), "triangles"), desc)  # type: ignore[no-any-return]

    @changes_topology
    def tie(self, loop: ArrayLike, *, start: Any = None, snap: float = 0.0) -> Change:
        """Closes passable space along a closed loop of points, in the plane along a line of points."""
        desc = described(_core.TieDesc, snap=snap)
        if start is not None:
            desc.start = start
        return self._core.tie(loop, desc)  # type: ignore[no-any-return]

    @changes_topology
    def remesh(
        self, volumes: Ids | None = None, next: ArrayLike | None = None, *, radius: int = 0, max_faces: int = 0
    ) -> Change:
        """Repairs volumes that are invalid, now or with the positions `next`; all of them by default."""
        desc = described(_core.RemeshDesc, radius=radius, max_faces=max_faces)
        return self._core.remesh(volumes, next, desc)  # type: ignore[no-any-return]

    @changes_topology
    def detach(self, volume: Any, max_volumes: int = 0, **values: Any) -> tuple[BodyId, Change]:
        """Makes a body of the piece of impassable volumes round one: `scene.body` gives the body of the id. `values` are members of
        DetachDesc."""
        body = self._core.detach(described(_core.DetachDesc, volume=volume, max_volumes=max_volumes, **values))
        return body, self.change()

    def change(self) -> Change:
        """The last change of the topology: numbers, and arrays of volumes, vertices and faces."""
        return self._core.get_change()  # type: ignore[no-any-return]
