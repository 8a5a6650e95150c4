"""What people ask for most, about ten lines each: the recipes of the documentation."""

from __future__ import annotations

import numpy as np
import pyvista
import trimesh

import dartsweep as ds

SLIDE = ds.options(ds.MoveOptions, vertex_response=ds.Response.SLIDE, edge_response=ds.Response.SLIDE)


def box(x: int, y: int, z: int, width: float = 0.5) -> pyvista.ImageData:
    """So many cubes in a row; any mesh that `dartsweep.read` takes would do as well."""
    return pyvista.ImageData(dimensions=(x + 1, y + 1, z + 1), spacing=(width,) * 3)


def test_rope_on_a_drum() -> None:
    """A tight, heavy rope sinks on a drum, and keeps its radius from it."""
    drum = trimesh.creation.cylinder(radius=1.0, height=4.0).apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    x = np.linspace(-1.5, 1.5, 25)
    with ds.from_surface(drum, outside="space", thickness=3.0) as environment, ds.Scene(environment) as scene:
        rope = scene.create_body(np.stack([x, 0.1 * x, 0 * x + 1.25], axis=1), [(i, i + 1) for i in range(24)], radius=0.05)
        for _ in range(80):
            places = rope.positions()
            places[1:-1] += 0.5 * ((places[:-2] + places[2:]) / 2 - places[1:-1])
            rope.move(places - (0.0, 0.0, 0.03), SLIDE)
        ends, top = rope.positions()[[0, -1], 2], rope.positions()[:, 2].max()
        assert ends.max() < 0.75 and 1.0 < top < 1.1 and rope.least_gap(1.0) >= 0


def test_ball_in_a_tube_that_squeezes() -> None:
    """Walls close on a ball until they touch it; those that can go no farther are held there."""
    with ds.from_pyvista(box(4, 4, 16, 0.25)) as tube, ds.Scene(tube, features=ds.Feature.DEFORMING) as scene:
        mesh = trimesh.creation.icosphere(subdivisions=1, radius=0.4)
        ball = scene.create_body(mesh.vertices + (0.5, 0.5, 1.0), triangles=mesh.faces, level=ds.Level.FACES, flags=ds.BodyFlag.RIGID)
        squeezed = tube.points()
        squeezed[:, :2] = 0.5 + (1 - 0.6 * np.exp(-4 * (squeezed[:, 2:] - 1) ** 2)) * (squeezed[:, :2] - 0.5)
        report = tube.deform(squeezed)
        assert report.outcome == ds.DeformOutcome.HELD and report.held_count == len(tube.held_vertices()) > 0
        assert np.linalg.norm(ball.positions().mean(axis=0) - (0.5, 0.5, 1.0)) < 0.05


def test_needle_that_stops_at_tissue() -> None:
    """A rigid needle is pushed forward until it meets tissue, which is told by its tag."""
    mesh = box(2, 2, 8)
    mesh.cell_data["region"] = np.where(mesh.cell_centers().points[:, 2] > 3, 7, 1)
    with ds.from_pyvista(mesh) as environment, ds.Scene(environment) as scene:
        environment.mark_region(7)
        needle = scene.create_body([(0.5, 0.5, 0.25), (0.5, 0.5, 1.25)], [(0, 1)], flags=ds.BodyFlag.RIGID)
        report = needle.move_rigid(translation=(0.0, 0.0, 3.0))
        touched = needle.contacts()[0]["contact"]
        assert 0.58 < report.fraction < 0.59 and environment.region(touched["behind"]) == 7


def test_wire_from_an_inlet() -> None:
    """A point of the inlet is on the boundary, in no volume: the wire starts a little way in."""
    with ds.from_pyvista(box(2, 2, 8)) as environment, ds.Scene(environment) as scene:
        tip = environment.inside((0.5, 0.5, 0.0), by=0.01)
        wire = scene.create_body(tip + np.outer((0.0, 0.25, 0.5), (0, 0, 1)), [(0, 1), (1, 2)])
        wire.move(wire.positions() + (0, 0, 1.0))
        assert np.allclose(wire.positions()[:, 2], (1.01, 1.26, 1.51)) and len(wire.contacts()) == 0


def test_particles_and_their_outlets() -> None:
    """Particles leave through the outlet, and stop at all other walls."""
    mesh = box(8, 2, 2).cast_to_unstructured_grid()
    with ds.from_pyvista(mesh) as environment, ds.Scene(environment) as scene:
        for name, x in (("inlet", 0.0), ("outlet", 4.0)):
            corners = [[i for i in cell.point_ids if mesh.points[i, 0] == x] for cell in mesh.cell]
            sides = np.array([side for side in corners if side])
            environment.name_surface(name, environment.find_faces(np.arange(0, sides.size + 1, 4), sides.ravel()))
        starts = np.array([(2.0, 0.3, 0.3), (2.0, 0.7, 0.3)])
        environment.mark_exit("outlet", patch=2)
        leave = ds.options(ds.CastOptions, flags=ds.CastFlag.LEAVE)
        flights = scene.move_particles(scene.create_particles(starts), starts + [(9, 0, 0.1), (-9, 0, 0)], leave)
        assert environment.surfaces_of(flights)["name"].tolist() == ["outlet", "inlet"]
        left = scene.exits()
        assert scene.particle_count == 1 and left["patch"].tolist() == [2] and left["point"][0, 0] == 4.0


def test_wire_that_leaves() -> None:
    """A wire is pushed through an outlet: what has passed it is no longer simulated."""
    with ds.from_pyvista(box(8, 2, 2)) as environment, ds.Scene(environment) as scene:
        environment.mark_exits(environment.cast((2.0, 0.6, 0.6), (9.0, 0.6, 0.6)).contact.wall, patch=1)
        x = np.linspace(0.5, 3.5, 13)
        wire = scene.create_body(np.stack([x, 0 * x + 0.6, 0 * x + 0.6], axis=1), [(i, i + 1) for i in range(12)])
        leave, gone = ds.options(ds.MoveOptions, flags=ds.MoveFlag.LEAVE), 0
        for _ in range(10):
            wire.move(wire.positions() + (0.2, 0, 0), leave)
            gone += len(wire.exits())
        assert gone == 7 and wire.counts.vertex_count == 6


def test_how_far_an_instrument_can_turn() -> None:
    """Nothing moves: planners ask for thousands of ways in one call."""
    with ds.from_pyvista(box(2, 2, 8)) as environment, ds.Scene(environment) as scene:
        rod = scene.create_body([(0.5, 0.5, 1.0), (0.5, 0.5, 2.5)], [(0, 1)], flags=ds.BodyFlag.RIGID)
        half = np.radians([0, 10, 40, -40]) / 2
        poses = np.stack([np.sin(half), 0 * half, 0 * half, np.cos(half), 0 * half, 0 * half, 0 * half], axis=1)
        free = rod.find_free_fractions(poses, [(0, 1), (0, 2), (0, 3)], centre=(0.5, 0.5, 1.0))["fraction"]
        assert free[0] == 1 and 0.4 < free[1] < 0.6 and abs(free[1] - free[2]) < 1e-12


def test_picking_with_a_ray() -> None:
    """Which triangle of which body a ray meets first, unless a wall is before it."""
    with ds.from_pyvista(box(8, 8, 8)) as environment, ds.Scene(environment, features=ds.Feature.BODY_CONTACTS) as scene:
        sheet = scene.create_body([(1, 1, 2), (3, 1, 2), (3, 3, 2), (1, 3, 2)], triangles=[(0, 1, 2), (0, 2, 3)], level=ds.Level.FACES)
        eyes, far = np.array([(1.25, 2.5, 3.5), (0.5, 0.5, 3.5)]), np.array([(1.5, 2.75, 0.5), (0.5, 0.5, -0.5)])
        flights, partners = scene.cast(eyes, far)
        assert partners["body"]["index"][0] == sheet.id.index and partners["face"]["index"][0] == 1 and flights["time"][0] == 0.5
        assert partners["body"]["generation"][1] == 0 and flights["position"][1].tolist() == [0.5, 0.5, 0.0]


def test_cable_through_a_hole() -> None:
    """A plate is a box whose middle is carved out; a cable that would pass the hole goes, one beside it stays before the plate."""
    mesh = box(8, 8, 8).cast_to_unstructured_grid()
    x, y, z = mesh.cell_centers().points.T
    mesh.cell_data["region"] = np.where((abs(z - 2) < 0.5) & ((abs(x - 2) > 0.5) | (abs(y - 2) > 0.5)), 2, 1)
    with ds.from_pyvista(mesh) as environment, ds.Scene(environment) as scene:
        environment.mark_region(2)
        for place, is_through in ((2.1, True), (2.6, False)):
            cable = scene.create_body(np.stack([np.full(5, place), np.full(5, 2.1), np.linspace(0.5, 1.2, 5)], axis=1), [(i, i + 1) for i in range(4)])
            report = cable.move(cable.positions() + (0, 0, 2.5))
            assert (report.vertices_stopped == 0) == is_through


def test_knot_in_a_thread() -> None:
    """The ends of a thread are pulled apart. It never passes itself, so its knot gets tight and stays."""
    t = np.linspace(-2.15, 2.15, 60)
    points = np.stack([0.3 * (t**3 - 3 * t), 0.08 * (t**5 - 10 * t), 0.3 * (t**4 - 4 * t**2)], axis=1) + 6
    with ds.from_pyvista(box(12, 12, 12, 1.0)) as environment, ds.Scene(environment, features=ds.Feature.BODY_CONTACTS) as scene:
        thread = scene.create_body(points, [(i, i + 1) for i in range(len(t) - 1)], flags=ds.BodyFlag.SELF_CONTACTS)
        for _ in range(1500):
            places = thread.positions()
            places[1:-1] += 0.5 * ((places[:-2] + places[2:]) / 2 - places[1:-1])
            places[[0, -1]] += [(-0.002, -0.002, 0), (0.002, 0.002, 0)]
            thread.move(np.clip(places, 0.5, 11.5), SLIDE)
        way = thread.positions()[-1] - thread.positions()[0]
        from_line = np.linalg.norm(np.cross(thread.positions() - thread.positions()[0], way), axis=1) / np.linalg.norm(way)
        assert from_line.max() > 0.5 and len(thread.contacts()) > 0


def test_thread_that_is_cut() -> None:
    """A blade goes down through a thread: both halves have an end of their own, and go apart."""
    with ds.from_pyvista(box(8, 2, 2)) as environment, ds.Scene(environment) as scene:
        x = np.linspace(0.5, 3.5, 13)
        thread = scene.create_body(np.stack([x, 0 * x + 0.5, 0 * x + 0.3], axis=1), [(i, i + 1) for i in range(12)])
        blade = [[(2.1, 0.2, z), (2.1, 0.8, z)] for z in np.linspace(0.9, 0.1, 5)]
        (cut,) = scene.cut_bodies(blade)
        assert thread.counts.edge_count == 13 and abs(cut["edge_parameter"] - 0.4) < 1e-9
        apart = thread.positions()
        apart[:, 1] += np.where(apart[:, 0] < 2.1, -0.2, 0.2)
        assert thread.move(apart).vertices_stopped == 0


def test_wire_that_begins_in_the_wall() -> None:
    """A wire that was registered from images pokes through the wall of its vessel: it is told where, and moved inside."""
    with ds.from_pyvista(box(8, 2, 2)) as vessel, ds.Scene(vessel) as scene:
        x = np.linspace(0.25, 3.75, 15)
        registered = np.stack([x, 0.5 + 0.52 * np.sin(x), 0 * x + 0.5], axis=1)
        wire = scene.create_body(registered, [(i, i + 1) for i in range(14)], flags=ds.BodyFlag.START_PENETRATING)
        assert wire.is_penetrating and any(each["wall"]["generation"] > 0 for each in wire.penetrations())
        moved = wire.depenetrate(max_distance=0.05)
        assert moved is not None and moved <= 0.05 and not wire.is_penetrating
        assert np.abs(wire.positions() - registered).max() <= moved + 1e-12


def test_cloth_on_a_ball() -> None:
    """A sheet falls on a ball and hangs over it; lengths of its edges are kept by a few rounds of averaging."""
    ball, sheet = trimesh.creation.icosphere(subdivisions=2), pyvista.Plane(i_size=2.5, j_size=2.5, i_resolution=10, j_resolution=10).triangulate()
    with ds.from_surface(ball, outside="space", thickness=3.0) as environment, ds.Scene(environment) as scene:
        cloth = scene.create_body(sheet.points + (0.01, 0.02, 1.1), triangles=sheet.regular_faces, level=ds.Level.FACES)
        a, b = cloth.edge_indices().T
        share = 1 / np.maximum(np.bincount(np.append(a, b)), 1)[:, np.newaxis]
        lengths = np.linalg.norm(np.diff(cloth.positions()[[a, b]], axis=0)[0], axis=1)
        for _ in range(40):
            places = cloth.positions() - (0, 0, 0.03)
            for _ in range(20):
                way = places[b] - places[a]
                way *= 0.5 - 0.5 * (lengths / np.linalg.norm(way, axis=1))[:, np.newaxis]
                np.add.at(places, a, way * share[a])
                np.add.at(places, b, -way * share[b])
            cloth.move(places, SLIDE)
        height = cloth.positions()[:, 2]
        assert height.min() < 0.25 and 0.95 < height.max() < 1.05
