"""Rays against closed surfaces with the methods of trimesh's RayMeshIntersector, exact: no ray slips through between two triangles, and
none meets two at their common edge. Needs the extra `surfaces`.

The space round the surface and within it is filled with tetrahedra once, which takes as long as dartsweep.from_surface, and kept twice. A
ray then costs the tetrahedra that it crosses; all hits of rays are asked for ray by ray.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import surfaces
from ._names import keys_of
from ._shapes import Records
from .environment import Environment


class RayMeshIntersector:
    """Rays that begin anywhere, with directions of any length but 0. A ray is the segment from its origin, or from where it enters a box
    round the surface, to where it leaves the box, both rounded; what such segments meet is exact. A ray that begins on the surface begins on
    one of its sides.

    mesh: a closed surface as of dartsweep.from_surface, such as a trimesh.Trimesh; all of its parts count. filling: its options size,
    thickness, scale and repair. Raises SurfaceError for a surface that is not closed or passes through itself.
    """

    def __init__(self, mesh: Any, **filling: Any) -> None:
        filled = surfaces.fill(mesh, "space", parts="all", largest_hole=0.0, **filling)
        self.environment: Environment = Environment(filled.points, filled.cells, regions=filled.regions)
        """The space round the surface and within it, without walls but at its outer boundary."""
        faces = self.environment.find_faces(np.arange(0, filled.wall.size + 1, 3), filled.wall.ravel())
        self._walled = Environment.load(self.environment.save())  # for first hits
        self._walled.mark_faces(faces)
        keys = keys_of(faces)
        self._order = np.argsort(keys)
        self._keys = keys[self._order]
        lower, upper = filled.points.min(axis=0), filled.points.max(axis=0)
        self._box = lower + 1e-6 * (upper - lower), upper - 1e-6 * (upper - lower)  # within the mesh, and far from the surface
        self._inside = filled.regions == surfaces.LUMEN

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.bool_]:
        """Whether each ray meets the surface."""
        return self.intersects_first(ray_origins, ray_directions) >= 0

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.int64]:
        """The triangle that each ray meets first; -1 for none."""
        return self._first(*self._segments(ray_origins, ray_directions))[0]

    def intersects_id(
        self, ray_origins: ArrayLike, ray_directions: ArrayLike, return_locations: bool = False, multiple_hits: bool = True
    ) -> tuple[NDArray[Any], ...]:
        """Triangles that rays meet, in the order of rays and along each; the ray of each; and, where asked for, the places, rounded."""
        starts, ends = self._segments(ray_origins, ray_directions)
        triangles, rays, places = self._all(starts, ends) if multiple_hits else self._first_ones(starts, ends)
        return (triangles, rays, places) if return_locations else (triangles, rays)

    def intersects_location(
        self, ray_origins: ArrayLike, ray_directions: ArrayLike, multiple_hits: bool = True
    ) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
        """Places where rays meet the surface, rounded; the ray of each, and the triangle."""
        triangles, rays, places = self.intersects_id(ray_origins, ray_directions, True, multiple_hits)
        return places, rays, triangles

    def contains_points(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Whether each point is within the surface. A point on it is on one of its sides."""
        volumes, _ = self.environment.locate_points(points)
        return np.where(volumes["generation"] == 0, False, self._inside[volumes["index"]])

    def _segments(self, origins: ArrayLike, directions: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The part of each ray within the box. A ray that misses the box becomes a corner of it, where there is no surface."""
        origins, directions = np.atleast_2d(np.asarray(origins, np.float64)), np.atleast_2d(np.asarray(directions, np.float64))
        if origins.shape != directions.shape or origins.shape[1:] != (3,):
            raise ValueError(f"origins and directions have shape (n, 3), not {origins.shape} and {directions.shape}")
        largest = np.abs(directions).max(axis=1, keepdims=True, initial=0)
        if not (np.isfinite(origins).all() and np.isfinite(largest).all() and (largest > 0).all()):
            raise ValueError("origins and directions are finite, and no direction is 0")
        directions = directions / largest
        with np.errstate(divide="ignore", invalid="ignore"):
            sides = np.sort((np.stack(self._box)[:, None, :] - origins) / directions, axis=0)
        away = (directions == 0) & ((origins < self._box[0]) | (origins > self._box[1]))
        sides[:, directions == 0] = np.array([[-np.inf], [np.inf]])
        enter, leave = np.maximum(sides[0].max(axis=1), 0), sides[1].min(axis=1)
        missed = (enter >= leave) | away.any(axis=1)
        times = (np.where(missed, 0, time)[:, None] for time in (enter, leave))
        ends: list[NDArray[np.float64]] = [np.clip(origins + time * directions, *self._box) for time in times]
        for end in ends:
            end[missed] = self._box[0]
        begins_within = (enter == 0) & ~missed
        ends[0][begins_within] = origins[begins_within]
        return ends[0], ends[1]

    def _triangles(self, faces: Records) -> NDArray[np.int64]:
        """Triangles of the surface by ids of faces; -1 for other faces."""
        keys = keys_of(faces)
        at = np.minimum(np.searchsorted(self._keys, keys), len(self._keys) - 1)
        return np.where((self._keys[at] == keys) & (faces["generation"] != 0), self._order[at], -1)

    def _first(self, starts: NDArray[np.float64], ends: NDArray[np.float64]) -> tuple[NDArray[np.int64], Records]:
        flights = self._walled.cast_segments(starts, ends)
        return self._triangles(flights["contact"]["wall"]), flights

    def _first_ones(self, starts: NDArray[np.float64], ends: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
        triangles, flights = self._first(starts, ends)
        rays = np.flatnonzero(triangles >= 0)
        return triangles[rays], rays, flights["position"][rays]

    def _all(self, starts: NDArray[np.float64], ends: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
        triangles, rays, places = [np.empty(0, np.int64)], [np.empty(0, np.int64)], [np.empty((0, 3))]
        for ray, (start, end) in enumerate(zip(starts, ends)):
            path = self.environment.cast_path(start, end)
            met = self._triangles(path["face"])
            here = np.flatnonzero(met >= 0)
            triangles.append(met[here])
            rays.append(np.full(len(here), ray))
            places.append(start + path["time"][here, None] * (end - start))
        return np.concatenate(triangles), np.concatenate(rays), np.concatenate(places)
