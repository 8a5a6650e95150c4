"""Curves of moves in which all vertices go at once: who stops at a touch, in how many rounds; and rigid motion."""

from __future__ import annotations

import numpy as np

import dartsweep as ds
from scene import Curve, Point, blocks, chain, ropes, timed

LEFT = "share of the way left"


def _moved(cases: int, options: ds.TogetherOptions) -> tuple[float, float]:
    """Ropes of one scene that move at once: seconds a move, and the share of the ways that is left."""
    seconds = left = way = 0.0
    for case in range(cases):
        with blocks(6, 0.08, seed=case) as environment, ds.Scene(environment, ds.Feature.BODY_CONTACTS) as scene:
            moves = list(ropes(environment, 12, seed=case))
            bodies, targets = [], []
            for move in moves:
                try:
                    bodies.append(scene.create_body(move.start, chain(len(move.start))))
                    targets.append(move.target)
                except ds.Error:  # meets another rope
                    continue
            ids = [body.id for body in bodies]
            start = np.concatenate([body.positions() for body in bodies])
            aim = np.concatenate(targets)
            _, took = timed(lambda: scene.move_together(ids, aim, options))
            seconds += took
            at = np.concatenate([body.positions() for body in bodies])
            left += float(np.linalg.norm(aim - at, axis=1).sum())
            way += float(np.linalg.norm(aim - start, axis=1).sum())
    return seconds / cases, left / way


def stop(cases: int) -> Curve:
    """ALL, ISLAND, and FEATURE by its rounds."""
    points = []
    for name in ("ALL", "ISLAND"):
        seconds, left = _moved(cases, ds.options(ds.TogetherOptions, stop=getattr(ds.TogetherStop, name)))
        points.append(Point(f"dartsweep {name}", "", "", seconds, "move of 12 ropes", LEFT, left, "", cases))
    for rounds in (1, 2, 4, 8, 16, 64, 256):
        seconds, left = _moved(cases, ds.options(ds.TogetherOptions, stop=ds.TogetherStop.FEATURE, max_rounds=rounds))
        points.append(Point("dartsweep FEATURE", str(rounds), "rounds", seconds, "move of 12 ropes", LEFT, left, "", cases))
    return Curve("together_stop", points, f"ALL leaves {points[0].error:.3g} of the way, ISLAND {points[1].error:.3g}, FEATURE {points[2].error:.3g} after one round "
                 f"and {points[7].error:.3g} after 64 (default).")


def response(cases: int) -> Curve:
    points = []
    for name in ("STOP", "SLIDE", "CARRY"):
        for rounds in (4, 16, 64, 256):
            options = ds.options(ds.TogetherOptions, stop=ds.TogetherStop.FEATURE, response=getattr(ds.TogetherResponse, name), max_rounds=rounds)
            seconds, left = _moved(cases, options)
            points.append(Point(f"dartsweep {name}", str(rounds), "rounds", seconds, "move of 12 ropes", LEFT, left, "", cases))
    at = {p.method: p for p in points if p.setting == "64"}
    return Curve("together_response", points, f"In 64 rounds STOP leaves {at['dartsweep STOP'].error:.3g} of the way, SLIDE {at['dartsweep SLIDE'].error:.3g} in "
                 f"{at['dartsweep SLIDE'].seconds / at['dartsweep STOP'].seconds:.1f} times the time.")


def _turned(start: np.ndarray, centre: np.ndarray, angle: float, way: np.ndarray) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray((start - centre) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + centre + way)


def rigid(cases: int) -> Curve:
    """A bar turns: exactly along its arcs, and as vertices that go straight in so many steps, which have another first contact and bend the shape."""
    environment = blocks()
    moves = list(ropes(environment, cases, seed=11, vertices=3))
    random = np.random.default_rng(4)
    turns = [(float(random.uniform(0.5, 2.5)), random.normal(size=3)) for _ in moves]
    points = []
    with ds.Scene(environment) as scene:
        exact, took = [], 0.0
        for move, (angle, way) in zip(moves, turns):
            body = scene.create_body(move.start, chain(3), flags=ds.BodyFlag.RIGID)
            rotation = (0, 0, np.sin(angle / 2), np.cos(angle / 2))
            report, seconds = timed(lambda: body.move_rigid(way, rotation, move.start[1]))
            took += seconds
            exact.append(report.fraction)
            body.destroy()
        points.append(Point("dartsweep arcs (exact)", "", "", took / cases, "rigid motion", "error of the free part", 0.0, "of the motion", cases,
                            f"{sum(f < 1 for f in exact)} of {cases} touch"))
        for steps in (1, 2, 4, 8, 16, 64, 256):
            took, off = 0.0, 0.0
            for move, (angle, way), free in zip(moves, turns, exact):
                body = scene.create_body(move.start, chain(3))
                made = 0
                for step in range(1, steps + 1):
                    target = _turned(move.start, move.start[1], angle * step / steps, way * step / steps)
                    report, seconds = timed(lambda: body.move(target))
                    took += seconds
                    if report.vertices_stopped:
                        break
                    made = step
                off += abs(made / steps - free)
                body.destroy()
            points.append(Point("dartsweep straight steps", str(steps), "steps", took / cases, "rigid motion", "error of the free part", off / cases,
                                "of the motion", cases))
    return Curve("rigid", points, f"256 straight steps are {points[-1].error:.2g} of the motion off and take {points[-1].seconds / points[0].seconds:.0f} times the time of the "
                 f"exact arcs.")


def rigid_slide(cases: int) -> Curve:
    """SLIDE_WHOLE by its further motions: the way that is left beside that of very many."""
    environment = blocks()
    moves = list(ropes(environment, cases, seed=12, vertices=3))
    points = []
    with ds.Scene(environment) as scene:
        for count in (0, 1, 2, 4, 8, 16, 32, 64):
            took, left, way = 0.0, 0.0, 0.0
            flags = ds.MoveFlag.SLIDE_WHOLE if count else 0
            for move in moves:
                body = scene.create_body(move.start, chain(3), flags=ds.BodyFlag.RIGID)
                go = 2 * (move.target - move.start).mean(axis=0)
                _, seconds = timed(lambda: body.move_rigid(go, options=ds.options(ds.MoveOptions, flags=flags, passes=count)))
                took += seconds
                left += float(np.linalg.norm(move.start + go - body.positions(), axis=1).sum())
                way += 3 * float(np.linalg.norm(go))
                body.destroy()
            name = "dartsweep SLIDE_WHOLE" if count else "dartsweep stop"
            points.append(Point(name, str(count), "motions", took / cases, "rigid motion", LEFT, left / way, "", cases))
    return Curve("rigid_slide", points, f"Without sliding {points[0].error:.3g} of the way is left, with 8 motions {points[4].error:.3g}, with 64 {points[7].error:.3g}.")
