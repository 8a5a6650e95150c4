"""Curves of changes of the environment: how near a cut is to its blade, a crack to its width, few large volumes to the fewest."""

from __future__ import annotations

import numpy as np

import dartsweep as ds
from scene import Array, Curve, Point, lattice, timed
from walls import tetrahedra

SNAPS = (1e-6, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.25)


def _block(case: int, cubes: int = 5) -> ds.Environment:
    """Shaken tetrahedra."""
    points, cells = lattice((cubes,) * 3)
    inner = ((points > 0) & (points < cubes)).all(axis=1)
    return ds.Environment(points + inner[:, None] * np.random.default_rng(case).uniform(-0.15, 0.15, points.shape), tetrahedra(cells))


def _blade(case: int, cubes: int = 5) -> Array:
    random = np.random.default_rng(50 + case)
    middle, (u, v) = random.uniform(0.4, 0.6, 3) * cubes, random.normal(size=(2, 3))
    u /= np.linalg.norm(u)
    v = v - (v @ u) * u
    v /= np.linalg.norm(v)
    side = np.linspace(-1.2, 1.2, 4)
    return np.asarray(middle + side[:, None, None] * u + side[None, :, None] * v)


def _shape(case: int, cubes: int = 5) -> tuple[Array, np.ndarray]:
    """An octahedron inside of the block."""
    random = np.random.default_rng(80 + case)
    corners = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], np.float64)
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    return 1.3 * corners @ turn + random.uniform(0.45, 0.55, 3) * cubes, np.array(faces)


def snap(cases: int) -> Curve:
    """Cut, carving and tie by `snap`: the distance of the cut from the blade; points that carving puts on the wrong side of the shape."""
    points = []
    for value in SNAPS:
        distance = seconds = 0.0
        added = done = 0
        for case in range(cases):
            with _block(case) as environment:
                before = environment.info.volume_count
                change, took = timed(lambda: environment.cut(_blade(case), flags=1, snap=value))
                seconds, distance, done = seconds + took, distance + change.distance, done + 1
                added += environment.info.volume_count - before
        points.append(Point("dartsweep cut", f"{value:g}", "of an edge", seconds / done, "cut", "distance from the blade", distance / done, "edges", done,
                            f"{added / done:.0f} volumes more"))
    for value in SNAPS:
        seconds = off = 0.0
        for case in range(cases):
            with _block(case) as environment:
                environment.mark_volumes([environment.volume_id(i) for i in range(environment.info.volume_count)])
                corners, faces = _shape(case)
                _, took = timed(lambda: environment.carve(corners, faces, snap=value))
                seconds += took
                asked = np.random.default_rng(case).uniform(0.1, 4.9, (2000, 3))
                middle, half = corners.mean(axis=0), (corners[:6:2] - corners[1::2]) / 2
                inside = np.abs((asked - middle) @ half.T / 1.3**2).sum(axis=1) < 1
                off += float((inside != (environment.locate_points(asked)[1] == ds.Location.PASSABLE)).mean())
        points.append(Point("dartsweep carve", f"{value:g}", "of an edge", seconds / cases, "carving", "share of points on the wrong side", off / cases, "", 2000 * cases))
    at = {(p.method, p.setting): p for p in points}
    return Curve("snap", points, f"At the default of 0.01 a cut is {at['dartsweep cut', '0.01'].error:.2g} edges beside its blade, at 0.25 {at['dartsweep cut', '0.25'].error:.2g}; "
                 f"carving puts {at['dartsweep carve', '0.01'].error:.2g} and {at['dartsweep carve', '0.25'].error:.2g} of the points on the wrong side.")


def tie(cases: int) -> Curve:
    """Passable space is closed along loops: how far the faces that close it are beside the loop's surface, by `snap`."""
    points = []
    for value in SNAPS:
        seconds = distance = 0.0
        for case in range(cases):
            with _block(case) as environment:
                angle = np.linspace(0, 2 * np.pi, 13)[:-1]
                blade = _blade(case)
                u, v = blade[1, 0] - blade[0, 0], blade[0, 1] - blade[0, 0]
                loop = np.asarray(blade.mean(axis=(0, 1)) + np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * v)
                change, took = timed(lambda: environment.tie(loop, snap=value))
                seconds, distance = seconds + took, distance + change.distance
        points.append(Point("dartsweep", f"{value:g}", "of an edge", seconds / cases, "tie", "distance from the loop's surface", distance / cases, "edges", cases))
    return Curve("tie_snap", points, f"At the default of 0.01 the closed faces are {points[3].error:.2g} edges beside the loop's surface, at 0.25 {points[-1].error:.2g}.")


def crack_width(cases: int) -> Curve:
    """Cracks opened by a width: how much narrower they are where a volume would have become invalid."""
    points = []
    for width in (0.001, 0.01, 0.05, 0.1, 0.2, 0.4):
        seconds = off = 0.0
        shortened = parted = 0
        for case in range(cases):
            with _block(case) as environment:
                cut = environment.cut(_blade(case), flags=1)
                faces = cut.faces.copy()
                change, took = timed(lambda: environment.open_crack(faces, width))
                seconds += took
                off += 1 - change.largest_width / width if change.vertices_parted else 0
                shortened, parted = shortened + change.vertices_shortened, parted + change.vertices_parted
        points.append(Point("dartsweep", f"{width:g}", "cells", seconds / cases, "crack", "share of vertices that open less", shortened / max(1, parted), "", parted,
                            f"the widest place is {off / cases:.2g} narrower"))
    return Curve("crack_width", points, f"Cracks of 0.01 cells open less at {points[1].error:.2g} of their vertices, those of 0.2 cells at {points[4].error:.2g}.")


def coarsen(cases: int) -> Curve:
    """Large volumes made of tetrahedra: the area of passable faces that is left, by the faces allowed and by the work allowed."""
    points = []
    for name, values in (("max_faces", [4, 6, 8, 12, 16, 20, 28]), ("max_trials", [10, 100, 1000, 10000])):
        for value in values:
            seconds = area = 0.0
            count = [0, 0]
            for case in range(cases):
                with _block(case, 3) as environment:
                    options = ds.options(ds.CoarsenOptions, **{name: value})
                    (coarse, _), took = timed(lambda: environment.coarsen(options))
                    seconds += took
                    count[0] += environment.info.volume_count
                    count[1] += coarse.info.volume_count
                    coarse.close()
            points.append(Point(f"dartsweep {name}", str(value), "faces" if name == "max_faces" else "unions", seconds / cases, "coarsening",
                                "share of the volumes that is left", count[1] / count[0], "", cases))
    at = {(p.method, p.setting): p for p in points}
    return Curve("coarsen", points, f"16 faces (default) leave {at['dartsweep max_faces', '16'].error:.2g} of the volumes, 28 leave {at['dartsweep max_faces', '28'].error:.2g} in "
                 f"{at['dartsweep max_faces', '28'].seconds / at['dartsweep max_faces', '16'].seconds:.1f} times the time; no contact changes.")


def detach(cases: int) -> Curve:
    """A piece becomes a body, `gap` away from its walls: how far its vertices are from where they were."""
    points = []
    for name, values in (("gap", [1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.25]), ("halvings", [1, 4, 16, 32])):
        for value in values:
            seconds = distance = 0.0
            failed = 0
            for case in range(cases):
                points_, cells = lattice((5, 5, 5))
                with ds.Environment(points_, cells) as environment, ds.Scene(environment) as scene:
                    piece = environment.volume_id(62 + case % 2)
                    environment.mark_volumes([piece])
                    try:
                        (_, change), took = timed(lambda: scene.environment.detach(piece, **{name: value}))
                    except ds.Error:
                        failed += 1
                        continue
                    seconds += took
                    distance += change.distance
            done = cases - failed
            points.append(Point(f"dartsweep {name}", f"{value:g}", "of an edge" if name == "gap" else "halvings", seconds / max(1, done), "detached piece", "distance of its vertices from where they were",
                                distance / max(1, done), "cells", done))
    return Curve("detach", points, f"With the default gap of 0.01 vertices are {points[3].error:.2g} cells beside where they were.")
