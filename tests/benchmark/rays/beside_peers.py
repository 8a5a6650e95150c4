#!/usr/bin/env python3
"""Signed distances of points beside Open3D, libigl, VTK and trimesh, and what bodies that are far away add to casts.

usage: beside_peers.py [--points N] [--json FILE]     with the package dartsweep; peers are left out where they are not installed

A sphere with bumps, 81,920 triangles, filled with tetrahedra, and random points in a cube around it. All times are of the processor, with one
thread each for the peers; ours counts all of its threads. Open3D has single precision. signed_distance.vs_best_peer is our time over that of the
quickest peer, rays.over_walls that of Scene.cast over Environment.cast_segments for segments of a mean edge, with 100 bodies beside their box.
"""
import argparse
import json
import time

import dartsweep as ds
import numpy as np
import trimesh


def bumpy_sphere(subdivisions):
    sphere = trimesh.creation.icosphere(subdivisions)
    points = np.array(sphere.vertices)
    x, y, z = points.T
    return points * (1 + 0.15 * np.sin(5 * x) * np.cos(4 * y + 1) * np.sin(3 * z + 0.5))[:, None], np.array(sphere.faces)


def microseconds(count, call):
    call()
    times = []
    for _ in range(3):
        start = time.process_time()
        call()
        times.append((time.process_time() - start) / count * 1e6)
    return sorted(times)[1]


def peers(points, corners, places):
    found = {}
    try:
        import open3d

        scene = open3d.t.geometry.RaycastingScene(nthreads=1)
        scene.add_triangles(points.astype(np.float32), corners.astype(np.uint32))
        single = places.astype(np.float32)
        found["open3d"] = microseconds(len(places), lambda: scene.compute_signed_distance(single, nthreads=1))
    except ImportError as error:
        print("without Open3D:", error)
    try:
        import igl

        some = places[: len(places) // 20]
        found["igl"] = microseconds(len(some), lambda: igl.signed_distance(some, points, corners))
    except ImportError as error:
        print("without libigl:", error)
    try:
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

        surface, triangles, places_of = vtk.vtkPolyData(), vtk.vtkCellArray(), vtk.vtkPoints()
        places_of.SetData(numpy_to_vtk(points, deep=True))
        triangles.SetData(3, numpy_to_vtkIdTypeArray(corners.astype(np.int64).ravel(), deep=True))
        surface.SetPoints(places_of)
        surface.SetPolys(triangles)
        distance, answers = vtk.vtkImplicitPolyDataDistance(), vtk.vtkDoubleArray()
        distance.SetInput(surface)
        few = numpy_to_vtk(places[: len(places) // 50], deep=True)
        found["vtk"] = microseconds(len(places) // 50, lambda: distance.FunctionValue(few, answers))
    except ImportError as error:
        print("without VTK:", error)
    try:
        import rtree  # noqa: F401  trimesh needs it

        mesh, few_places = trimesh.Trimesh(points, corners, process=False), places[: len(places) // 500]
        found["trimesh"] = microseconds(len(few_places), lambda: trimesh.proximity.signed_distance(mesh, few_places))
    except ImportError as error:
        print("without trimesh's distances:", error)
    return found


def largest_error(points, corners, places, distances):
    """Beside the nearest point of each triangle, in long doubles, for a few places."""
    worst = 0.0
    a, b, c = (points[corners[:, k]].astype(np.longdouble) for k in range(3))
    for place, distance in zip(places.astype(np.longdouble), distances):
        least = min(to_edges(place, a, b), to_edges(place, b, c), to_edges(place, c, a), to_planes(place, a, b, c))
        worst = max(worst, float(abs(abs(distance) - np.sqrt(least))))
    return worst / np.ptp(points, axis=0).max()


def to_edges(place, a, b):
    way = b - a
    share = np.clip(((place - a) * way).sum(1) / (way * way).sum(1), 0, 1)
    return ((a + share[:, None] * way - place) ** 2).sum(1).min()


def to_planes(place, a, b, c):
    normal = np.cross(b - a, c - a)
    inside = np.ones(len(a), bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(q - p, place - p) * normal).sum(1) >= 0
    height = ((place - a) * normal).sum(1) ** 2 / (normal * normal).sum(1)
    return height[inside].min() if inside.any() else np.inf


def over_walls(environment, rng):
    with ds.Scene(environment, features=ds.Feature.BODY_CONTACTS) as scene:
        for place in rng.uniform(-0.05, 0.05, (100, 3)):
            scene.create_body([place, place + 1e-5], edges=[(0, 1)])
        starts = rng.normal(size=(20000, 3))
        starts *= (0.6 / np.linalg.norm(starts, axis=1))[:, None]
        ends = starts + rng.uniform(-0.02, 0.02, starts.shape)
        volumes, _ = environment.locate_points(starts)
        options = ds.options(ds.CastOptions, flags=ds.CastFlag.START_KNOWN)
        ratios = []
        for _ in range(5):
            alone = microseconds(len(starts), lambda: environment.cast_segments(starts, ends, volumes, options))
            ratios.append(microseconds(len(starts), lambda: scene.cast(starts, ends, volumes, options)) / alone)
        return sorted(ratios)[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=100000)
    parser.add_argument("--json")
    arguments = parser.parse_args()
    points, corners = bumpy_sphere(6)
    tetrahedra = np.column_stack([np.full(len(corners), len(points)), corners])
    rng = np.random.default_rng(1)
    places = rng.uniform(-1.6, 1.6, (arguments.points, 3))
    with ds.Environment(np.vstack([points, np.zeros(3)]), tetrahedra) as environment:
        distances = environment.signed_distances(places)
        figures = {"signed_distance.us": microseconds(len(places), lambda: environment.signed_distances(places))}
        _, locations = environment.locate_points(places)
        figures["signed_distance.wrong_signs_beside_locate"] = int(((distances < 0) != (locations != ds.Location.OUTSIDE)).sum())
        figures["signed_distance.largest_error"] = largest_error(points, corners, places[:200], distances)
        figures["rays.over_walls"] = over_walls(environment, rng)
    found = peers(points, corners, places)
    figures.update({f"signed_distance.{name}_us": took for name, took in found.items()})
    if found:
        figures["signed_distance.vs_best_peer"] = figures["signed_distance.us"] / min(found.values())
    print(json.dumps(figures, indent=2))
    if arguments.json:
        with open(arguments.json, "w") as out:
            json.dump(figures, out, indent=2)


if __name__ == "__main__":
    main()
