"""The curve of the margin of near rows: contacts of the next step that no row has announced."""

from __future__ import annotations

import numpy as np

import dartsweep as ds
from scene import Curve, Point, blocks, chain, ropes, timed


def margin(cases: int) -> Curve:
    """Margins in lengths of the step. A contact is announced if a row names its face, or a vertex of the body that it stops."""
    environment = blocks()
    moves = list(ropes(environment, cases, seed=21, step=0.5))
    points = []
    with ds.Scene(environment) as scene:
        for factor in (0.0, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0):
            seconds, contacts, missed, rows_made = 0.0, 0, 0, 0
            for move in moves:
                body = scene.create_body(move.start, chain(len(move.start)))
                longest = float(np.linalg.norm(move.target - move.start, axis=1).max())
                rows, took = timed(lambda: body.near_rows(factor * longest))
                seconds += took
                rows_made += len(rows)
                near = {int(v) for row in rows for v in row["vertices"]}
                body.move(move.target)
                for contact in body.contacts():
                    contacts += 1
                    missed += int(contact["vertex"]["index"]) not in near
                body.destroy()
            points.append(Point("dartsweep", f"{factor:g}", "steps", seconds / cases, "question for rows", "share of contacts without a row", missed / max(1, contacts), "",
                                contacts, f"{rows_made / cases:.1f} rows"))
    return Curve("near_margin", points, f"A margin of the longest way of a step announces {1 - points[4].error:.3g} of its contacts with {points[4].note}, one of half the way "
                 f"{1 - points[3].error:.3g}.")
