"""Objects close once, in any order, and say so afterwards."""

from __future__ import annotations

import gc
import pathlib
import sys
import threading
import weakref
from collections.abc import Callable

import numpy as np
import pytest

import dartsweep as ds
from scenario import create, create_catheter

INSIDE = (24.0, 24.0, 48.0)


def test_closing_twice_is_fine(environment: ds.Environment) -> None:
    scene = ds.Scene(environment)
    scene.close()
    scene.close()
    environment.close()
    environment.close()
    assert scene.closed and environment.closed


def test_use_after_close_is_an_exception(environment: ds.Environment) -> None:
    scene = ds.Scene(environment)
    body = create_catheter(scene)
    particle = scene.create_particle(INSIDE)
    scene.close()
    calls: list[Callable[[], object]] = [
        body.positions,
        lambda: body.move(np.zeros((12, 3))),
        lambda: scene.move_particle(particle, INSIDE),
        lambda: scene.create_particle(INSIDE),
        scene.save,
    ]
    for call in calls:
        with pytest.raises(ds.Closed, match="scene is closed"):
            call()
    environment.close()
    for call in [lambda: environment.cast(INSIDE, INSIDE), environment.save, lambda: ds.Scene(environment)]:
        with pytest.raises(ds.Closed, match="environment is closed"):
            call()
    assert "closed" in repr(environment) and "closed" in repr(scene) and "closed" in repr(body)


def test_a_scene_keeps_its_environment() -> None:
    environment = create()
    scene = ds.Scene(environment)
    environment.close()
    del environment
    gc.collect()
    assert scene.move_particle(scene.create_particle(INSIDE), (24.0, 24.0, 50.0)).outcome == ds.Outcome.REACHED
    scene.close()
    assert scene.environment.closed


def test_a_body_keeps_its_scene_and_can_be_destroyed(environment: ds.Environment) -> None:
    body = create_catheter(ds.Scene(environment))
    gc.collect()
    assert len(body.positions()) == 12
    body.destroy()
    with pytest.raises(ds.errors.StaleId):
        body.destroy()
    with pytest.raises(ds.errors.StaleId):
        body.positions()


def test_an_environment_is_not_shared_with_changes(environment: ds.Environment) -> None:
    with ds.Scene(environment), ds.Scene(environment):
        with pytest.raises(ds.errors.Shared):
            environment.mark_region(1)


def test_lent_positions_are_held_until_the_next(environment: ds.Environment) -> None:
    first, second = environment.points().copy(), environment.points().copy()
    before = sys.getrefcount(first)
    with ds.Scene(environment, ds.Feature.DEFORMING) as scene:
        environment.deform(first)
        assert sys.getrefcount(first) > before
        with pytest.raises(ds.errors.InUse):
            environment.deform(first)
        second[:, 2] += 0.25
        environment.deform(second)
        assert sys.getrefcount(first) == before
        # It is read, not copied: what is written into the array that is lent shows at once.
        second[0] = (1.0, 2.0, 3.0)
        assert environment.points()[0].tolist() == [1.0, 2.0, 3.0]
        held = sys.getrefcount(second)
    environment.close()
    assert sys.getrefcount(second) < held


def test_room_for_points_is_what_the_array_has(environment: ds.Environment) -> None:
    options = ds.options(ds.DeformOptions)
    points = environment.points()
    with ds.Scene(environment, ds.Feature.DEFORMING) as scene:
        environment.deform(np.vstack([points, np.zeros((9, 3))]), options)
        assert options.point_room == 0
        options.point_room = len(points) + 1
        with pytest.raises(ds.errors.WrongSize):
            environment.deform(points.copy(), options)


def test_positions_that_are_refused_are_not_held(environment: ds.Environment) -> None:
    array = environment.points().copy()
    before = sys.getrefcount(array)
    with ds.Scene(environment) as scene, pytest.raises(ds.errors.NotEnabled):
        environment.deform(array)
    assert sys.getrefcount(array) == before


def test_threads_may_call_and_close_as_they_like(environment: ds.Environment) -> None:
    points = np.random.default_rng(1).uniform(10, 38, (2000, 3))
    problems: list[BaseException] = []

    def work(number: int, scene: ds.Scene, particles: ds.environment.Records) -> None:
        try:
            for i in range(30):
                if number == 0 and i == 20:
                    scene.close()
                if number % 2:
                    scene.move_particles(particles, points)
                else:
                    environment.cast_segments(points, points[::-1])
                    scene.particle_position(particles[i])
        except ds.Closed:
            pass
        except BaseException as error:
            problems.append(error)

    for _ in range(3):
        scene = ds.Scene(environment)
        particles = scene.create_particles(np.tile(INSIDE, (len(points), 1)))
        threads = [threading.Thread(target=work, args=(i, scene, particles)) for i in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert not problems


def test_other_threads_run_during_long_calls(environment: ds.Environment) -> None:
    """A thread counts while another is inside of one call; it could not if that held the interpreter's lock."""
    points = np.random.default_rng(2).uniform(10, 38, (200000, 3))
    counted, inside = 0, threading.Event()
    done = False

    def call() -> None:
        nonlocal done
        inside.set()
        environment.cast_segments(points, points[::-1])
        done = True

    interval = sys.getswitchinterval()
    sys.setswitchinterval(100.0)  # a thread that has the lock keeps it until it lets go by itself
    try:
        thread = threading.Thread(target=call)
        thread.start()
        inside.wait()
        while not done:
            counted += 1
            if counted % 100 == 0:
                threading.Event().wait(1e-4)
        thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert counted > 100


def test_the_log_is_a_callable() -> None:
    lines: list[tuple[int, str]] = []
    with pytest.raises(ds.errors.NonFinite):
        ds.Environment(np.full((4, 3), np.nan), [[0, 1, 2, 3]], log=lambda level, text: lines.append((level, text)))
    assert all(level in list(ds.LogLevel) for level, _ in lines)


def test_a_coarse_environment_keeps_the_log() -> None:
    class Log:
        def __call__(self, level: int, text: str) -> None:
            pass

    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    environment = ds.Environment(corners, [[0, 1, 2, 3]], log=(log := Log()))
    kept = weakref.ref(log)
    coarse, _ = environment.coarsen()
    del environment, log
    gc.collect()
    assert kept() is not None and coarse.info.volume_count == 1  # its context still writes there
    del coarse
    gc.collect()
    assert kept() is None


def test_recordings_are_written_as_calls_are_made(environment: ds.Environment, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "calls.rec"
    with ds.Scene(environment) as scene:
        assert len(scene.particle_ids()) == 0 and len(scene.body_ids()) == 0
        scene.start_recording(str(path))
        with pytest.raises(ds.errors.InUse):
            scene.start_recording(str(path))
        before = path.stat().st_size
        particle = scene.create_particle(INSIDE)
        assert path.stat().st_size > before
        assert scene.particle_ids()[0]["index"] == particle.index
        scene.stop_recording()
        after = path.stat().st_size
        scene.destroy_particle(particle)
        assert path.stat().st_size == after
        with pytest.raises(ds.errors.WriteFailed, match="no/such"):
            scene.start_recording("no/such/folder")


def test_a_bug_report_is_one_call(environment: ds.Environment, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "report.dswrec"
    with ds.Scene(environment) as scene:
        with scene.recording():
            particle = scene.create_particle(INSIDE)
            scene.move_particle(particle, INSIDE)
            validation = scene.write_bug_report(str(path), "it did not move")
        assert validation.is_right == 1 and validation.places == 1 and validation.lost == 0 and validation.text == ""
        assert path.read_bytes().startswith(b"DSWREC") and b"it did not move" in path.read_bytes()
        with scene.recording(str(tmp_path / "calls.dswrec"), ds.RecordingFlag.STATES):
            scene.destroy_particle(particle)
        scene.start_recording()
        scene.stop_recording()
