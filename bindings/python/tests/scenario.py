"""The scenario of bindings/tests/README.md, in Python."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import dartsweep as ds

SHAPE = NX, NY, NZ = 6, 6, 12
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
LINKS = 12
SIDE = 10


def pattern(value: Any) -> str:
    if isinstance(value, (float, np.floating)):
        return struct.pack(">d", value).hex()
    return f"{int(value):016x}"


class Result(dict[str, list[str]]):
    """Patterns by stage; say() takes numbers and arrays of them."""

    def stage(self, name: str) -> None:
        self._now = self.setdefault(name, [])

    def say(self, *values: Any) -> None:
        for value in values:
            if np.ndim(value):
                self.say(*value)
            else:
                self._now.append(pattern(value))


class Draw:
    """Random points that every language draws alike."""

    def __init__(self) -> None:
        self.seed = 1

    def __call__(self, count: int) -> NDArray[np.float64]:
        drawn = np.empty((count, 3))
        for out in drawn:
            for axis in range(3):
                self.seed = (self.seed * 4093 + 1021) % 65536
                out[axis] = 1.5 * self.seed / 1024 if axis == 2 else 4 + 0.625 * (self.seed / 1024)
        return drawn

    def plane(self, count: int) -> NDArray[np.float64]:
        drawn = np.empty((count, 2))
        for i in range(2 * count):
            self.seed = (self.seed * 4093 + 1021) % 65536
            drawn.flat[i] = 11 + 0.90625 * (self.seed / 1024)
        return drawn


def vessel() -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int32]]:
    """Points, cells and regions."""

    def at(i: int, j: int, k: int) -> int:
        return (k * (NY + 1) + j) * (NX + 1) + i

    points = [
        (8.0 * i + j * k % 3, 8.0 * j + i * k % 3, 8.0 * k + i * j % 3)
        for k in range(NZ + 1)
        for j in range(NY + 1)
        for i in range(NX + 1)
    ]
    places = [(i, j, k) for k in range(NZ) for j in range(NY) for i in range(NX)]
    cells = [[at(i + a, j + b, k + c) for a, b, c in CORNERS] for i, j, k in places]
    regions = [1 if 0 < i < NX - 1 and 0 < j < NY - 1 else 2 for i, j, _ in places]
    return np.array(points), np.array(cells, np.int64), np.array(regions, np.int32)


def create() -> ds.Environment:
    points, cells, regions = vessel()
    return ds.Environment(points, cells, regions=regions)


def create_catheter(scene: ds.Scene) -> ds.Body:
    positions = [(24.5, 25.25, 8.125 + 2.0 * i) for i in range(LINKS)]
    return scene.create_body(positions, [(i, i + 1) for i in range(LINKS - 1)])


def status_of(call: Callable[[], object]) -> ds.Status:
    try:
        call()
    except ds.Error as error:
        return error.status
    return ds.Status.OK


def say_moves(result: Result, flights: Iterable[Any]) -> None:
    for flight in flights:
        result.say(flight["outcome"], flight["time"], flight["position"])


def say_flight(result: Result, flight: Any) -> None:
    result.say(flight["outcome"], flight["time"], flight["position"], flight["contact"]["normal"])
    wall = flight["contact"]["wall"]
    result.say(wall["volume"], wall["local"], flight["volumes_visited"])


def say_sweep(result: Result, sweep: Any) -> None:
    result.say(sweep["outcome"], sweep["time"], sweep["point"], sweep["edge_parameter"])


def say_contacts(result: Result, stage: str, contacts: NDArray[np.void]) -> None:
    result.stage(stage)
    result.say(len(contacts))
    for contact in contacts:
        touched = contact["contact"]
        result.say(contact["vertex"]["index"], touched["kind"], contact["time"], contact["point"], touched["normal"])
        result.say(touched["wall"]["volume"])


def say_nearest(result: Result, environment: ds.Environment, point: NDArray[np.float64], volume: Any) -> None:
    nearest = environment.find_nearest(point, 20.0, volume)
    result.say(nearest.distance, nearest.cell.kind, nearest.cell.index)


def queries(result: Result, environment: ds.Environment, draw: Draw) -> None:
    result.stage("locate")
    start = draw(64)
    volumes, locations = environment.locate_points(start)
    for location, volume in zip(locations, volumes):
        result.say(location, volume["index"], volume["generation"])

    result.stage("cast")
    end = draw(64)
    for flight in environment.cast_segments(start, end):
        say_flight(result, flight)

    result.stage("sweep")
    for sweep in environment.sweep_edges(start[:16], end[:16], draw(16)):
        say_sweep(result, sweep)

    result.stage("nearest")
    for point, volume, location in zip(start, volumes, locations):
        if location == ds.Location.PASSABLE:
            say_nearest(result, environment, point, volume)


def pushes(result: Result, stage: str, body: ds.Body, way: NDArray[np.float64]) -> None:
    result.stage(stage)
    slide = ds.options(ds.MoveOptions, vertex_response=ds.Response.SLIDE, edge_response=ds.Response.SLIDE)
    for _ in range(10):
        report = body.move(body.positions() + way, slide)
        result.say(report.vertices_stopped, report.contact_count, body.positions())


def push(result: Result, body: ds.Body) -> None:
    index = np.arange(LINKS)
    pushes(result, "catheter", body, np.stack([np.full(LINKS, 1.75), -0.5 * (index % 3), np.full(LINKS, 3.0)], axis=1))
    say_contacts(result, "contacts", body.contacts())


def snapshots(result: Result, scene: ds.Scene, particles: NDArray[np.void], draw: Draw) -> None:
    result.stage("snapshot")
    block, scene_block = scene.environment.save(), scene.save()
    for saved in (block, scene_block):
        result.say(len(saved), sum(saved))
    with ds.Environment.load(block) as other, ds.Scene.load(other, scene_block) as copy:
        say_moves(result, copy.move_particles(particles, draw(len(particles))))

    result.stage("damaged")
    result.say(status_of(lambda: ds.Environment.load(block[: len(block) // 2])))
    flipped = bytearray(block)
    flipped[len(block) // 2] ^= 1
    result.say(status_of(lambda: ds.Environment.load(bytes(flipped))))


def errors(result: Result, scene: ds.Scene, particles: NDArray[np.void]) -> None:
    environment = scene.environment
    inside, outside = (24.0, 24.0, 48.0), (-9.0, 0.0, 0.0)
    stale = ds.VolumeId(3, 7)
    result.stage("errors")
    result.say(status_of(lambda: environment.cast((0.0, float("nan"), 0.0), inside)))
    result.say(status_of(lambda: environment.cast(inside, outside, stale)))
    result.say(status_of(lambda: environment.volume_id(NX * NY * NZ)))
    result.say(status_of(lambda: scene.create_particle(outside)))
    result.say(status_of(lambda: scene.create_particle((4.0, 4.0, 4.0))))
    result.say(status_of(lambda: scene.move_particles(particles[[0, 0]], [inside, inside])))
    particle = scene.create_particle(inside)
    result.say(status_of(lambda: environment.mark_volumes([scene.particle_position(particle)[1]])))
    scene.destroy_particle(particle)
    result.say(status_of(lambda: scene.destroy_particle(particle)))
    result.say(status_of(scene.reset_statistics))
    result.say(status_of(lambda: ds.Environment(vessel()[0], [[0, 1, 7, 7]])))


def cut(result: Result, stage: str, environment: ds.Environment, blade: ArrayLike) -> None:
    result.stage(stage)
    change = environment.cut(blade)
    result.say(change.distance, change.volumes_split, len(change.faces), environment.info.volume_count)
    for vertex in change.vertices:
        result.say(vertex["vertex"]["index"], vertex["weights"][0])


def deform(result: Result) -> None:
    result.stage("deform")
    with create() as environment:
        environment.mark_region(2)
        with ds.Scene(environment, ds.Feature.DEFORMING) as scene:
            body = create_catheter(scene)
            positions = environment.points()
            positions[:, 0] += (48 - positions[:, 0]) * 0.4375
            say_deformed(result, environment.deform(positions), body)


def say_deformed(result: Result, report: Any, body: ds.Body) -> None:
    result.say(report.outcome, report.held_count, report.contact_count, report.pushed_count, body.positions())


def create_plane() -> ds.Environment:
    at = [(8.0 * i + i * j % 3, 8.0 * j + (i + 2 * j) % 3) for j in range(SIDE + 1) for i in range(SIDE + 1)]
    cells, types, regions = [], [], []
    for j in range(SIDE):
        for i in range(SIDE):
            a, d = j * (SIDE + 1) + i, (j + 1) * (SIDE + 1) + i
            quad = (i + j) % 2 == 0
            made = [[a, a + 1, d + 1, d]] if quad else [[a, a + 1, d + 1], [a, d + 1, d]]
            cells += made
            types += [ds.CellType.QUAD if quad else ds.CellType.TRIANGLE] * len(made)
            regions += [1 if 0 < i < SIDE - 1 and 0 < j < SIDE - 1 else 2] * len(made)
    offsets = np.cumsum([0] + [len(cell) for cell in cells])
    return ds.Environment(np.array(at), np.concatenate(cells), types, offsets, regions=regions)


def plane(result: Result, draw: Draw) -> None:
    result.stage("plane")
    with create_plane() as environment:
        info = environment.info
        marked, _ = environment.mark_region(2)
        environment.mark_vertices([environment.vertex_id(5 * (SIDE + 1) + 5)])
        result.say(info.dimension, info.vertex_count, info.volume_count, info.face_count, info.boundary_face_count, marked)

        result.stage("plane locate")
        draw.seed = 1
        start = draw.plane(32)
        volumes, locations = environment.locate_points(start)
        for point, volume, location in zip(start, volumes, locations):
            result.say(location, volume["index"], volume["generation"])
            if location == ds.Location.PASSABLE:
                say_nearest(result, environment, point, volume)

        result.stage("plane cast")
        end = draw.plane(32)
        end[::2, 0] += 40
        for flight in environment.cast_segments(start, end):
            say_flight(result, flight)

        result.stage("plane sweep")
        for sweep in environment.sweep_edges(start[:16], end[:16], draw.plane(16)):
            say_sweep(result, sweep)

        with ds.Scene(environment, ds.Feature.DEFORMING) as scene:
            result.stage("plane particles")
            particles = scene.create_particles(start)
            scene.move_particles(particles, end)
            result.say(scene.particle_positions(particles, np.empty((32, 2))))
            index = np.arange(LINKS)
            rope = scene.create_body([(20.25 + 3.0 * i, 40.5) for i in index], [(i, i + 1) for i in index[:-1]])
            pushes(result, "rope", rope, np.stack([np.full(LINKS, 1.5), 4.0 - 0.75 * (index % 3)], axis=1))
            say_contacts(result, "rope contacts", rope.contacts())
            result.stage("plane snapshot")
            for saved in (environment.save(), scene.save()):
                result.say(len(saved), sum(saved))

            result.stage("plane deform")
            bent = np.vstack([environment.points(), np.zeros((64, 2))])
            bent[:-64, 1] += (40 - bent[:-64, 1]) * 0.125
            say_deformed(result, environment.deform(bent), rope)
            cut(result, "plane cut", environment, [(20, 20.5), (60.25, 41.25)])


def play() -> Result:
    result, draw = Result(), Draw()
    result.stage("vessel")
    with create() as environment:
        info = environment.info
        marked, _ = environment.mark_region(2)
        result.say(info.vertex_count, info.volume_count, info.face_count, info.boundary_face_count, marked)
        queries(result, environment, draw)
        with ds.Scene(environment) as scene:
            lumen = np.flatnonzero(vessel()[2] == 1)[:50]
            particles = scene.create_particles([environment.centre(environment.volume_id(int(i))) for i in lumen])
            result.stage("particles")
            for _ in range(4):
                say_moves(result, scene.move_particles(particles, draw(len(particles))))
            push(result, create_catheter(scene))
            snapshots(result, scene, particles, draw)
            errors(result, scene, particles)
            cut(result, "cut", environment, [[(x, 3, z) for x in (-5, 60)] for z in (20.5, 60.25)])
    deform(result)
    plane(result, draw)
    return result
