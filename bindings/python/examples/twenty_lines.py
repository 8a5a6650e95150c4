"""The first program of the project's README, in Python."""

from __future__ import annotations

import dartsweep as ds

POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]

with ds.Environment(POINTS, [[0, 1, 2, 3, 4, 5, 6, 7]]) as cube:  # a hexahedron, numbered as in VTK
    flight = cube.cast((0.5, 0.5, 0.5), (0.5, 0.5, 2.5))
    print(f"wall met at z = {flight.position[2]:g} after {flight.time:g} of the way")  # z = 1, 0.25
    assert (flight.position[2], flight.time) == (1.0, 0.25)

    with ds.Scene(cube) as scene:
        body = scene.create_body([(0.5, 0.5, 0.25), (0.5, 0.5, 0.75)], edges=[(0, 1)])
        body.move([(0.75, 0.5, 0.25), (1.5, 0.5, 0.75)])
        for contact in body.contacts():  # vertex 1 stops at x = 1, after 0.5 of its way, normal -1 0 0
            print(f"vertex {contact['vertex']['index']} stops at {contact['point']} after {contact['time']:g}")
        assert body.contacts()["time"].tolist() == [0.5]
