"""Curves of what a move does at a contact: the responses and their dials.

A rope's vertices can each go to their targets for themselves, so only the edges between them are in the way. A response that gives
nothing up makes all of the way: the error is the share of the ways that is left.
"""

from __future__ import annotations

import numpy as np

import dartsweep as ds
from scene import Curve, Move, Point, blocks, chain, lattice, move_all, ropes, timed

LEFT = "share of the way left"
RESPONSES = {
    "stop": (ds.Response.STOP, ds.Response.STOP),
    "slide": (ds.Response.SLIDE, ds.Response.SLIDE),
    "adaptive, one": (ds.Response.STOP, ds.Response.ADAPTIVE_ONE),
    "adaptive, many": (ds.Response.STOP, ds.Response.ADAPTIVE_MANY),
    "hybrid": (ds.Response.STOP, ds.Response.HYBRID),
    "adaptive slide": (ds.Response.SLIDE, ds.Response.ADAPTIVE_SLIDE),
}


def _options(name: str, **values: object) -> ds.MoveOptions:
    vertex, edge = RESPONSES[name]
    if edge == ds.Response.ADAPTIVE_MANY:
        values["search"] = ds.Search.EXHAUSTIVE
    return ds.options(ds.MoveOptions, vertex_response=vertex, edge_response=edge, **values)


def _of_setting(
    curve: str, unit: str, values: list[float], moves: int, method: str, options: dict[str, object], advice: str, member: str = ""
) -> Curve:
    """A curve of one member of the options, over the same ropes."""
    environment = blocks()
    cases = list(ropes(environment, moves))
    points = []
    with ds.Scene(environment) as scene:
        for value in values:
            setting = _options(method, **options, **{member or curve: value})
            seconds, left, places = move_all(scene, cases, setting)
            inserted = sum(len(at) for at in places) - sum(len(case.start) for case in cases)
            note = f"{inserted} vertices inserted"
            points.append(Point(f"dartsweep {method}", f"{value:g}", unit, seconds, "move of a rope", LEFT, left, "", len(cases), note))
    return Curve(curve, points, advice.format(best=min(points, key=lambda p: (p.error, p.seconds)), points=points))


def responses(moves: int) -> Curve:
    environment = blocks()
    points = []
    with ds.Scene(environment) as scene:
        for step in (0.125, 0.25, 0.5, 1.0, 2.0):
            cases = list(ropes(environment, moves, step=step))
            for name in RESPONSES:
                seconds, left, places = move_all(scene, cases, _options(name))
                inserted = sum(len(at) for at in places) - sum(len(case.start) for case in cases)
                note = f"{inserted} vertices inserted"
                points.append(Point(f"dartsweep {name}", f"{step:g}", "cells a step", seconds, "move of a rope", LEFT, left, "", len(cases), note))
    longest = {p.method: p for p in points if p.setting == "1"}
    least = min(longest.values(), key=lambda p: p.error)
    stop = longest["dartsweep stop"]
    return Curve("response", points, f"In steps of a cell {least.method.removeprefix('dartsweep ')} leaves least of the way, {least.error:.3f}, "
                 f"in {least.seconds / stop.seconds:.1f} times the time of stop, which leaves {stop.error:.3f}.")


def min_part(moves: int) -> Curve:
    return _of_setting("min_part", "of an edge", [0.01, 0.05, 0.1, 0.15, 0.25, 0.35, 0.45, 0.5], moves, "adaptive, one", {},
                       "{best.setting} leaves least of the way, {best.error:.3f}; at [JCD10] 4.2's 0.25 it is {points[4].error:.3f}.")


def min_length(moves: int) -> Curve:
    return _of_setting("min_length", "cells", [0.0, 0.025, 0.05, 0.1, 0.2, 0.4], moves, "adaptive, one", {"min_part": 0.01},
                       "Without a least length {points[0].error:.3f} of the way is left, with 0.1 {points[3].error:.3f}: it bounds how small edges become.")


def passes(moves: int) -> Curve:
    return _of_setting("passes", "passes", [0, 1, 2, 4, 8, 16], moves, "stop", {},
                       "What one vertex frees for another is found by the first pass: it leaves {points[1].error:.3f} of the way, none leaves "
                       "{points[0].error:.3f}, 16 leave {points[5].error:.3f}.")


def work_limit(moves: int) -> Curve:
    """Long moves through small cells, of which each sweep may visit so many."""
    points, cells = lattice((24, 24, 24), 1 / 3)
    environment = ds.Environment(points, cells)
    cases = list(ropes(environment, moves, step=3.0))
    rows = []
    with ds.Scene(environment) as scene:
        for limit in (1, 4, 16, 64, 256, 1024, 0):
            seconds, left, _ = move_all(scene, cases, ds.options(ds.MoveOptions, max_volumes=limit))
            method = "dartsweep limited" if limit else "dartsweep exact"
            rows.append(Point(method, str(limit or "none"), "volumes", seconds, "move of a rope", LEFT, left, "", len(cases)))
    enough = next(p for p in rows if p.error <= rows[-1].error)
    return Curve("max_volumes", rows, f"From {enough.setting} volumes a sweep on the limit takes no way. It bounds the worst move, and saves nothing on others.")


def casts_limited(moves: int) -> Curve:
    """Casts through small cells, and swept edges: those that the limit ends have no answer."""
    points, cells = lattice((30, 10, 10), 1 / 3)
    with ds.Environment(points, cells) as environment:
        random = np.random.default_rng(5)
        start, end = random.uniform(0.1, 3.2, (moves * 20, 3)), random.uniform(0.1, 3.2, (moves * 20, 3))
        end[:, 0] *= 3
        rows = []
        for limit in (1, 4, 16, 64, 256, 0):
            options = ds.options(ds.CastOptions, max_volumes=limit)
            flights, seconds = timed(lambda: environment.cast_segments(start, end, options=options))
            left = float((flights["outcome"] == ds.Outcome.WORK_LIMIT).mean())
            method = "dartsweep limited" if limit else "dartsweep exact"
            rows.append(Point(method, str(limit or "none"), "volumes", seconds / len(start), "cast", "share of casts without an answer", left, "", len(start)))
        for limit in (1, 4, 16, 64, 256, 0):
            options = ds.options(ds.SweepOptions, max_volumes=limit)
            sweeps, seconds = timed(lambda: environment.sweep_edges(start[:moves], end[:moves], start[:moves] + (0, 0, 0.1), options=options))
            left = float((sweeps["outcome"] == ds.Outcome.WORK_LIMIT).mean())
            method = "dartsweep sweep limited" if limit else "dartsweep sweep exact"
            rows.append(Point(method, str(limit or "none"), "volumes", seconds / moves, "swept edge", "share of sweeps without an answer", left, "", moves))
    return Curve("query_limit", rows, "A limit ends long queries without an answer, and makes no answer less exact.")


def noise_share(moves: int) -> Curve:
    """Ropes are drawn over blocks and back, with and without the removal of what lies in line: how far the corners come to lie apart."""
    environment = blocks()
    cases = list(ropes(environment, moves))

    def drawn(share: float) -> tuple[list[np.ndarray], float, int]:
        places, seconds, vertices = [], 0.0, 0
        options = _options("adaptive slide", noise_share=share)
        with ds.Scene(environment) as scene:
            for case in cases:
                body = scene.create_body(case.start, chain(len(case.start)))
                for step in range(6):
                    now = body.positions()
                    target = now.copy()
                    target[: len(case.start)] += (case.target - case.start) * (1 if step < 3 else -1)
                    _, took = timed(lambda: body.move(target, options))
                    seconds += took
                places.append(body.positions()[: len(case.start)])
                vertices += body.counts.vertex_count
                body.destroy()
        return places, seconds / (6 * len(cases)), vertices

    exact, seconds, vertices = drawn(0.0)
    points = [Point("dartsweep none removed (exact)", "0", "of the line", seconds, "move of a rope", "distance of the corners", 0.0, "cells", len(cases),
                    f"{vertices} vertices at the end")]
    for share in (1e-9, 1e-6, 1e-3, 1e-2, 3e-2, 0.1):
        places, seconds, vertices = drawn(share)
        off = float(np.mean([np.linalg.norm(a - b, axis=1).mean() for a, b in zip(exact, places)]))
        points.append(Point("dartsweep", f"{share:g}", "of the line", seconds, "move of a rope", "distance of the corners", off, "cells", len(cases),
                            f"{vertices} vertices at the end"))
    return Curve("noise_share", points, f"At 1e-3 corners are {points[3].error:.2g} cells beside where they are without removal, "
                 f"with {points[3].note}, against {points[0].note}.")


def keep_walls(moves: int) -> Curve:
    """Points slide into corners: with the flag they stay before six walls, without it before two, and go on in their next step."""
    environment = blocks(share=0.25, seed=7)
    random = np.random.default_rng(3)
    starts = []
    while len(starts) < moves:
        at = random.uniform(0.1, 7.9, (1, 3))
        if environment.locate(at[0])[1] == ds.Location.PASSABLE:
            starts.append(Move(at, at + random.normal(size=3) * 3))
    points = []
    with ds.Scene(environment) as scene:
        for flags, name in ((0, "two walls"), (ds.MoveFlag.KEEP_WALLS, "KEEP_WALLS")):
            for count in (1, 2, 4, 8):
                options = ds.options(ds.MoveOptions, vertex_response=ds.Response.SLIDE, flags=flags)
                seconds = left = way = 0.0
                for move in starts:
                    body = scene.create_body(move.start, level=ds.Level.POINTS)
                    for part in range(count):
                        _, took = timed(lambda: body.move(move.start + (move.target - move.start) * (part + 1) / count, options))
                        seconds += took
                    # How much of the way that walls do not forbid is left: what another hundred slides find.
                    at = body.positions()
                    for _ in range(20):
                        body.move(move.target, ds.options(ds.MoveOptions, vertex_response=ds.Response.SLIDE))
                    left += float(np.linalg.norm(body.positions() - at))
                    way += float(np.linalg.norm(move.target - move.start))
                    body.destroy()
                points.append(Point(f"dartsweep {name}", str(count), "steps", seconds / moves, "way of a point", LEFT, left / way, "", moves))
    two, kept = points[0], points[4]
    return Curve("keep_walls", points, f"In one step, KEEP_WALLS leaves {kept.error:.3g} of the way that twenty more slides find, without it {two.error:.3g} is left.")


def _ball(radius: float) -> tuple[np.ndarray, np.ndarray]:
    """A closed surface: an octahedron with faces in sixteen, turned outwards."""
    corners = [np.array(c, np.float64) for c in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(2):
        middles: dict[tuple[int, int], int] = {}

        def middle(a: int, b: int, known: dict[tuple[int, int], int] = middles) -> int:
            key = (min(a, b), max(a, b))
            if key not in known:
                known[key] = len(corners)
                corners.append((corners[a] + corners[b]) / 2)
            return known[key]

        faces = [part for a, b, c in faces for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                 for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    return radius * np.array([c / np.linalg.norm(c) for c in corners]), np.array(faces)


def back_edges(moves: int) -> Curve:
    """[JCD10] 6.1, 6.2 and 6.3 on balls that fall among blocks and change their shape: contacts that they miss, and places that differ."""
    both = ds.BodyFlag.SKIP_BY_ENVIRONMENT | ds.BodyFlag.SKIP_BACK_EDGES
    methods = {"none (exact at EDGES)": 0, "6.1": ds.BodyFlag.SKIP_BY_ENVIRONMENT, "6.2": ds.BodyFlag.SKIP_BACK_EDGES, "6.3": both,
               "6.2, left": ds.BodyFlag.SKIP_BACK_EDGES | ds.BodyFlag.LEAVE_BACK_EDGES, "6.3, left": both | ds.BodyFlag.LEAVE_BACK_EDGES}
    shape, faces = _ball(0.45)
    environment = blocks(share=0.2, seed=5)
    points = []
    for step in (0.05, 0.1, 0.2, 0.4):
        random = np.random.default_rng(9)
        ways = []
        with ds.Scene(environment) as scene:
            while len(ways) < moves:
                at = shape + random.uniform(0.6, 7.4, 3)
                try:
                    scene.create_body(at, triangles=faces, level=ds.Level.EDGES).destroy()
                except ds.Error:
                    continue
                ways.append((at, step * (random.normal(size=3) + random.uniform(-0.5, 0.5, shape.shape))))
            found: dict[str, list[set[int]]] = {}
            for name, flags in methods.items():
                seconds, skipped, swept, found[name] = 0.0, 0, 0, []
                for at, way in ways:
                    body = scene.create_body(at, triangles=faces, level=ds.Level.EDGES, flags=flags)
                    report, took = timed(lambda: body.move(at + way))
                    seconds, skipped, swept = seconds + took, skipped + report.edges_skipped, swept + report.edges_swept
                    found[name].append({int(c["vertex"]["index"]) for c in body.contacts()})
                    body.destroy()
                contacts = sum(len(each) for each in found["none (exact at EDGES)"])
                missed = sum(len(a - b) for a, b in zip(found["none (exact at EDGES)"], found[name]))
                points.append(Point(f"dartsweep {name}", f"{step:g}", "cells a step", seconds / moves, "move of a ball", "share of contacts missed",
                                    missed / max(1, contacts), "", contacts, f"{skipped / max(1, skipped + swept):.2f} of the sweeps left out"))
    at = {p.method: p for p in points if p.setting == "0.2"}
    none, back, left = at["dartsweep none (exact at EDGES)"], at["dartsweep 6.2"], at["dartsweep 6.2, left"]
    return Curve("back_edges", points, f"In steps of 0.2 cells 6.2 takes {back.seconds / none.seconds:.2f} of the time of none and misses {back.error:.2g} of the contacts: "
                 f"an edge that goes inwards is cast where it arrives, so that all is free afterwards. Left untested, as the paper has it, 6.2 takes "
                 f"{left.seconds / none.seconds:.2f} and misses {left.error:.2g}.")


def _column(sides: int, layers: int = 40) -> ds.Environment:
    """Prisms of so many sides on each other, as polyhedra."""
    angle = np.arange(sides) * 2 * np.pi / sides + 0.1
    ring = np.stack([np.cos(angle), np.sin(angle)], -1)
    points = np.concatenate([np.column_stack([ring, np.full(sides, float(layer))]) for layer in range(layers + 1)])
    cells: list[int] = []
    offsets = [0]
    for layer in range(layers):
        low, high = layer * sides, (layer + 1) * sides
        faces = [[low + i for i in reversed(range(sides))], [high + i for i in range(sides)]]
        faces += [[low + i, low + (i + 1) % sides, high + (i + 1) % sides, high + i] for i in range(sides)]
        cells += [len(faces), *(number for face in faces for number in [len(face), *face])]
        offsets.append(len(cells))
    return ds.Environment(points, np.array(cells), np.full(layers, int(ds.CellType.POLYHEDRON), np.uint8), np.array(offsets))


def faces_of_cells(moves: int) -> Curve:
    """[JCD10] 7.1: what a particle costs in a cell, by the number of the cell's faces. Particles go up and down a column of prisms."""
    points = []
    for sides in (3, 4, 6, 8, 12, 16, 24, 32, 64):
        with _column(sides) as environment, ds.Scene(environment, ds.Feature.STATISTICS) as scene:
            random = np.random.default_rng(1)
            start = np.column_stack([random.uniform(-0.3, 0.3, (moves, 2)), random.uniform(0.1, 0.9, moves)])
            ids = scene.create_particles(start)
            scene.reset_statistics()
            seconds = 0.0
            for height in (39.5, 0.5, 39.5, 0.5):
                target = np.column_stack([random.uniform(-0.3, 0.3, (moves, 2)), np.full(moves, height)])
                _, took = timed(lambda: scene.move_particles(ids, target))
                seconds += took
            counted = scene.statistics
            tests = counted.orientation_tests / counted.volumes_visited
            points.append(Point("dartsweep", str(sides + 2), "faces", seconds / counted.volumes_visited, "cell that a particle enters", "orientation tests in a cell", tests, "",
                                int(counted.volumes_visited)))
    few, many = points[1], points[-1]
    return Curve("faces_of_cells", points, f"A cell of {many.setting} faces takes {many.error:.3g} orientation tests, {many.error / few.error:.1f} times those of a cell of {few.setting}, where it has "
                 f"{int(many.setting) / int(few.setting):.0f} times as many faces: about one test a face, so the cost is O(deg c) and no less.")
