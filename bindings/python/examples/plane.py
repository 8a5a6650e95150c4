"""The plane: a floor of squares, a pillar on it, and a rope that is pulled against the pillar and bends round it."""

from __future__ import annotations

import numpy as np

import dartsweep as ds

SIDE, PILLAR = 9, 1

corners = [(x, y) for y in range(SIDE + 1) for x in range(SIDE + 1)]  # two coordinates: so this is the plane
squares = [(a, a + 1, a + SIDE + 2, a + SIDE + 1) for y in range(SIDE) for a in range(y * (SIDE + 1), y * (SIDE + 1) + SIDE)]
regions = [PILLAR if divmod(i, SIDE) == (4, 4) else 0 for i in range(len(squares))]

with ds.Environment(corners, squares, regions=regions) as floor, ds.Scene(floor) as scene:
    floor.mark_region(PILLAR)
    flight = floor.cast((0.5, 4.5), (8.5, 4.5))
    print(f"pillar met at {flight.position[:2]} after {flight.time:g} of the way")  # (4, 4.5), 0.4375
    assert flight.time == 0.4375 and flight.contact.normal.tolist() == [-1.0, 0.0, 0.0]  # structs have three coordinates, the last one 0

    rope = scene.create_body([(1.0, 2.0), (8.0, 2.0)], edges=[(0, 1)])
    bend = ds.options(ds.MoveOptions, edge_response=ds.Response.ADAPTIVE_ONE)
    for _ in range(10):
        targets = rope.positions()
        targets[:2] += (0.0, 0.5)  # the ends; vertices that the pillar has put in stay
        rope.move(targets, bend)
        for contact in rope.contacts():
            print(f"rope bends at {contact['point'][:2]}")  # (4, 4), (5, 4)
    assert rope.counts.vertex_count > 2 and np.all(rope.positions()[:2, 1] > 5.0)
