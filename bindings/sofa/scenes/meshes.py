#!/usr/bin/env python3
"""Writes the meshes of the scenes: a vessel of tetrahedra, and the triangles of its wall for SOFA's own collision models. Millimetres.

usage: meshes.py FOLDER
"""
import math
import pathlib
import sys


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def times(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return times(a, 1 / math.sqrt(dot(a, a)))


def winding_axis(length, layer, straight):
    """Points of an axis along x that is straight at first and then winds in space, its directions, and normals that do not turn about it."""
    point, normal, points, directions, normals = (-10.0, 0.0, 0.0), (0.0, 1.0, 0.0), [], [], []
    for k in range(int(length / layer) + 1):
        way = max(k * layer - straight, 0.0)
        tilt, turn = 0.9 * math.sin(way / 28), way / 60
        direction = (math.cos(tilt), math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn))
        normal = unit(add(normal, times(direction, -dot(normal, direction))))
        points.append(point)
        directions.append(direction)
        normals.append(normal)
        point = add(point, times(direction, layer))
    return points, directions, normals


def tube(axis, directions, normals, radius, sides, rings):
    """Points, tetrahedra and wall triangles of a tube round an axis. `rings` circles of points lie between the axis and the wall."""
    points, tetrahedra, wall = [], [], []
    stride = 1 + sides * rings
    for point, direction, normal in zip(axis, directions, normals):
        across = cross(direction, normal)
        points.append(point)
        for ring in range(1, rings + 1):
            for side in range(sides):
                angle = 2 * math.pi * side / sides
                offset = add(times(normal, math.cos(angle)), times(across, math.sin(angle)))
                points.append(add(point, times(offset, radius * ring / rings)))

    def at(layer, ring, side):
        return layer * stride + (0 if ring == 0 else 1 + (ring - 1) * sides + side % sides)

    for layer in range(len(axis) - 1):
        for side in range(sides):
            add_wedge(tetrahedra, *(at(layer + k, ring, s) for k in (0, 1) for ring, s in ((0, 0), (1, side), (1, side + 1))))
            for ring in range(1, rings):
                quad = ((ring, side), (ring + 1, side), (ring + 1, side + 1), (ring, side + 1))
                lower, upper = ([at(layer + k, r, s) for r, s in quad] for k in (0, 1))
                for a, b, c in ((0, 1, 2), (0, 2, 3)) if min(lower) in (lower[0], lower[2]) else ((1, 2, 3), (1, 3, 0)):
                    add_wedge(tetrahedra, lower[a], lower[b], lower[c], upper[a], upper[b], upper[c])
    count = {}
    for tetrahedron in tetrahedra:
        for a, b, c in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)):
            face = (tetrahedron[a], tetrahedron[b], tetrahedron[c])
            count.setdefault(tuple(sorted(face)), []).append(face)
    ends = [set(range(stride)), set(range((len(axis) - 1) * stride, len(axis) * stride))]
    for faces in count.values():
        if len(faces) == 1 and not any(end.issuperset(faces[0]) for end in ends):
            wall.append(faces[0][::-1])  # it looks into the vessel
    return points, tetrahedra, wall


def add_wedge(tetrahedra, *corners):
    """Three tetrahedra of a wedge: diagonals begin at the lower index, so neighbours agree."""
    order = sorted(range(3), key=lambda i: corners[i])
    a, b, c = (corners[i] for i in order)
    x, y, z = (corners[3 + i] for i in order)
    turned = order in ([1, 0, 2], [0, 2, 1], [2, 1, 0])
    for tetrahedron in ((a, b, c, z), (a, b, z, y), (a, y, z, x)):
        tetrahedra.append((tetrahedron[1], tetrahedron[0]) + tetrahedron[2:] if turned else tetrahedron)


def write_vtk(path, points, tetrahedra):
    lines = ["# vtk DataFile Version 3.0", "vessel", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(points)} double"]
    lines += [" ".join(repr(x) for x in point) for point in points]
    lines.append(f"CELLS {len(tetrahedra)} {5 * len(tetrahedra)}")
    lines += ["4 " + " ".join(map(str, tetrahedron)) for tetrahedron in tetrahedra]
    lines.append(f"CELL_TYPES {len(tetrahedra)}")
    lines += ["10"] * len(tetrahedra)
    path.write_text("\n".join(lines) + "\n")


def write_obj(path, points, triangles):
    used = {vertex: k for k, vertex in enumerate(sorted({vertex for triangle in triangles for vertex in triangle}))}
    lines = ["v " + " ".join(repr(x) for x in points[vertex]) for vertex in used]
    lines += ["f " + " ".join(str(used[vertex] + 1) for vertex in triangle) for triangle in triangles]
    path.write_text("\n".join(lines) + "\n")


def write_thread(path, count):
    """A thread that goes once and a half round a post, the z axis, and then away from it: lines of an .obj file."""
    lines = []
    for k in range(count):
        way = k / (count - 1) * 2 - 1
        angle = min(max(way / 0.7, -1), 1) * 1.5 * math.pi
        beyond = max(abs(way) - 0.7, 0.0) * 18
        side = 1 if way > 0 else -1
        point = (2 * math.cos(angle) + side * beyond * -math.sin(angle), 2 * math.sin(angle) + side * beyond * math.cos(angle), 2 * way)
        lines.append("v " + " ".join(repr(x) for x in point))
    lines += [f"l {k} {k + 1}" for k in range(1, count)]
    path.write_text("\n".join(lines) + "\n")


def write_ball(path, radius, sides):
    """A closed triangle mesh near a ball: two poles and rings, turned outwards."""
    points = [(0.0, 0.0, radius)]
    for ring in range(1, sides // 2):
        polar = 2 * math.pi * ring / sides
        points += [(radius * math.sin(polar) * math.cos(2 * math.pi * k / sides), radius * math.sin(polar) * math.sin(2 * math.pi * k / sides),
                    radius * math.cos(polar)) for k in range(sides)]
    points.append((0.0, 0.0, -radius))
    last = len(points) - 1
    faces = []
    for k in range(sides):
        n = (k + 1) % sides
        faces.append((0, 1 + k, 1 + n))
        for ring in range(sides // 2 - 2):
            a, b = 1 + ring * sides, 1 + (ring + 1) * sides
            faces += [(a + k, b + k, b + n), (a + k, b + n, a + n)]
        faces.append((last, last - sides + n, last - sides + k))
    lines = ["v " + " ".join(repr(x) for x in point) for point in points]
    lines += ["f " + " ".join(str(vertex + 1) for vertex in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def write_block(path, cells, size):
    """A block of cubes, each of six tetrahedra round its diagonal."""
    points = [(size * x, size * y, size * z) for z in range(cells[2] + 1) for y in range(cells[1] + 1) for x in range(cells[0] + 1)]
    step = (1, cells[0] + 1, (cells[0] + 1) * (cells[1] + 1))
    tetrahedra = []
    for z in range(cells[2]):
        for y in range(cells[1]):
            for x in range(cells[0]):
                first = x * step[0] + y * step[1] + z * step[2]
                for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
                    way = (first, first + step[i], first + step[i] + step[j], first + sum(step))
                    tetrahedra.append(way if (i, j, k) in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else (way[1], way[0]) + way[2:])
    write_vtk(path, points, tetrahedra)


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, layer, sides, rings in (("vessel", 4.0, 12, 1), ("vessel_fine", 1.5, 24, 2)):
        axis = winding_axis(330.0, layer, 30.0)
        points, tetrahedra, wall = tube(*axis, 3.0, sides, rings)
        write_vtk(folder / f"{name}.vtk", points, tetrahedra)
        write_obj(folder / f"{name}_wall.obj", points, wall)
    write_thread(folder / "thread.obj", 121)
    write_ball(folder / "ball.obj", 1.5, 12)
    write_block(folder / "block.vtk", (10, 10, 10), 2.0)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
