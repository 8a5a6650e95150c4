"""Curves of environments that deform: halvings, what walls do with what they touch, and volumes that would become invalid."""

from __future__ import annotations

import numpy as np

import dartsweep as ds
from scene import Array, Curve, Point, blocks, chain, lattice, ropes, timed

NOT_MADE = "share of the walls' way not made"


def _bent(points: Array, random: np.random.Generator, by: float) -> Array:
    """Points moved by waves: every volume stays valid up to `by` of about 0.3, and some do not beyond."""
    phase = random.uniform(0, 2 * np.pi, (3, 3))
    wave = np.sin(points @ random.uniform(0.5, 1.5, (3, 3)) + phase[0])
    return np.asarray(points + by * wave + by * random.uniform(-0.5, 0.5, points.shape))


def _deformed(cases: int, options: ds.DeformOptions, by: float = 0.25, steps: int = 4, share: float = 0.1) -> tuple[float, float, int]:
    """Seconds a step, the share of the ways of vertices that was not made, and how many bodies the walls have pushed."""
    seconds = way = left = 0.0
    pushed = 0
    for case in range(cases):
        random = np.random.default_rng(100 + case)
        environment = blocks(6, share, seed=case)
        moves = list(ropes(environment, 6, seed=case))
        with environment, ds.Scene(environment, ds.Feature.DEFORMING) as scene:
            for move in moves:
                scene.create_body(move.start, chain(len(move.start)))
            rest = environment.points().copy()
            kept = [rest]
            for _ in range(steps):
                now = environment.points().copy()
                target = _bent(rest, random, by)
                given = target.copy()
                kept.append(given)  # the environment reads it until the next step
                report, took = timed(lambda: environment.deform(given, options))
                seconds += took
                pushed += report.pushed_count
                at = environment.points()
                way += float(np.linalg.norm(target - now, axis=1).sum())
                left += float(np.linalg.norm(target - at, axis=1).sum())
    return seconds / (cases * steps), left / way, pushed


def most_halvings(cases: int) -> Curve:
    points = []
    for halvings in (1, 2, 3, 4, 6):
        seconds, left, _ = _deformed(cases, ds.options(ds.DeformOptions, most_halvings=halvings), 0.4, 1)
        points.append(Point("dartsweep SWEPT", str(halvings), "halvings", seconds, "deformation", NOT_MADE, left, "", cases))
    return Curve("most_halvings", points, f"Of walls that should move by up to 0.4 cells, {points[0].error:.3g} of the way is not made with 1 halving, {points[-1].error:.3g} "
                 f"with 6, in {points[-1].seconds / points[0].seconds:.0f} times the time.")


def max_holds(cases: int) -> Curve:
    points = []
    for holds in (1, 4, 16, 64, 256, 16384):
        seconds, left, _ = _deformed(cases, ds.options(ds.DeformOptions, max_holds=holds))
        points.append(Point("dartsweep SWEPT", str(holds), "holds", seconds, "deformation", NOT_MADE, left, "", 4 * cases))
    return Curve("max_holds", points, f"A limit of 1 leaves {points[0].error:.3g} of the way, the default of 16384 {points[-1].error:.3g}.")


def wall_response(cases: int) -> Curve:
    """PUSH, INSERT, HOLD, STOP at steps of several lengths, and END_STATE."""
    points = []
    choices = [(f"dartsweep {name}", {"response": getattr(ds.WallResponse, name)}) for name in ("PUSH", "INSERT", "HOLD", "STOP")]
    choices.append(("dartsweep END_STATE", {"method": ds.DeformMethod.END_STATE}))
    for by in (0.05, 0.1, 0.2, 0.3):
        for name, values in choices:
            seconds, left, pushed = _deformed(cases, ds.options(ds.DeformOptions, **values), by)
            points.append(Point(name, f"{by:g}", "cells a step", seconds, "deformation", NOT_MADE, left, "", 4 * cases, f"{pushed} moves made by walls"))
    at = {p.method: p for p in points if p.setting == "0.1"}
    return Curve("wall_response", points, f"In steps of 0.1 cells PUSH leaves {at['dartsweep PUSH'].error:.3g} of the walls' way, INSERT "
                 f"{at['dartsweep INSERT'].error:.3g}, HOLD {at['dartsweep HOLD'].error:.3g}, STOP {at['dartsweep STOP'].error:.3g}.")


def wall_min_part(cases: int) -> Curve:
    points = []
    for part in (0.01, 0.1, 0.25, 0.4, 0.5):
        options = ds.options(ds.DeformOptions, response=ds.WallResponse.INSERT, min_part=part)
        seconds, left, _ = _deformed(cases, options, 0.2)
        points.append(Point("dartsweep INSERT", f"{part:g}", "of an edge", seconds, "deformation", NOT_MADE, left, "", 4 * cases))
    return Curve("wall_min_part", points, f"At 0.25 {points[2].error:.3g} of the walls' way is left, at 0.01 {points[0].error:.3g}.")


def invalid(cases: int) -> Curve:
    """Deformations that would turn volumes over."""
    points = []
    for by in (0.2, 0.35, 0.5):
        for name in ("HOLD", "REFUSE"):
            options = ds.options(ds.DeformOptions, invalid=getattr(ds.InvalidResponse, name), most_halvings=3)
            seconds, left, _ = _deformed(cases, options, by, 1)
            points.append(Point(f"dartsweep {name}", f"{by:g}", "cells a step", seconds, "deformation", NOT_MADE, left, "", cases))
    at = {p.method: p for p in points if p.setting == "0.5"}
    return Curve("invalid_response", points, f"Where volumes would turn over, HOLD leaves {at['dartsweep HOLD'].error:.3g} of the way, REFUSE "
                 f"{at['dartsweep REFUSE'].error:.3g}; REMESH is the curve remesh.")


def remesh(cases: int) -> Curve:
    """A block of tetrahedra is pressed until some of them turn over: the share that is not repaired, by the rings of neighbours and by the faces of a patch."""
    points = []
    for name, choices in (("radius", [1, 2, 3, 4, 8]), ("max_faces", [8, 16, 24, 32, 48, 96, 128])):
        for value in choices:
            seconds, invalid_count, left = 0.0, 0, 0
            for case in range(cases):
                random = np.random.default_rng(case)
                rest, cells = lattice((4, 4, 4))
                tetra = tetrahedra(cells)
                with ds.Environment(rest, tetra) as environment, ds.Scene(environment, ds.Feature.DEFORMING):
                    inner = ((rest > 0) & (rest < 4)).all(axis=1)
                    target = rest + inner[:, None] * random.uniform(-0.7, 0.7, rest.shape)
                    change, took = timed(lambda: environment.remesh(next=target, **{name: value}))
                    seconds += took
                    invalid_count += change.volumes_invalid
                    left += len(change.unrepaired)
            points.append(Point(f"dartsweep {name}", str(value), "rings" if name == "radius" else "faces", seconds / cases, "repair", "share of volumes not repaired",
                                left / max(1, invalid_count), "", invalid_count))
    rings = [p for p in points if p.unit == "rings"]
    return Curve("remesh", points, f"With 1 ring (default) {rings[0].error:.3g} of the invalid volumes are left, with {rings[-1].setting} {rings[-1].error:.3g}.")


def tetrahedra(cells: np.ndarray) -> np.ndarray:
    """Six tetrahedra round the diagonal of each hexahedron; neighbours fit."""
    round_ = [(1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)]
    return np.concatenate([np.stack([cells[:, 0], cells[:, a], cells[:, b], cells[:, 6]], -1) for a, b in round_])
