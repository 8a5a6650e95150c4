"""A surface, filled, and a ray in it: surface.py [SURFACE]    STL, OBJ or PLY; without one an octahedron"""

import sys

import dartsweep as ds

corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
triangles = [(x, y, z) for x in (0, 1) for y in (2, 3) for z in (4, 5)]
with ds.from_surface(sys.argv[1] if len(sys.argv) > 1 else (corners, triangles), outside="tissue") as environment:
    start = environment.centre(environment.volume_id(0))  # the first cells are those of the lumen
    flight = environment.cast(start, start + (0, 0, 1e6))
    print(f"{environment}: wall met at {flight.position}, normal {flight.contact.normal}")
