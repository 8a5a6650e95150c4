"""Arrays of the right layout are used in place; others are converted once, or refused."""

from __future__ import annotations

import re
import pathlib
import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest

import dartsweep as ds
from dartsweep import dtypes

ROOT = pathlib.Path(__file__).parents[3]
COUNT = 20000


def peak(call: Callable[[], object]) -> int:
    """Most memory, in bytes, that NumPy and Python take during a call."""
    call()
    tracemalloc.start()
    call()
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most


def test_input_and_output_are_not_copied(scene: ds.Scene) -> None:
    rng = np.random.default_rng(3)
    particles = scene.create_particles(np.tile((24.0, 24.0, 48.0), (COUNT, 1)))
    targets = rng.uniform(10, 38, (COUNT, 3))
    flights = np.empty(COUNT, dtypes.FLIGHT)
    address = flights.__array_interface__["data"]
    assert scene.move_particles(particles, targets, out=flights) is flights
    assert flights.__array_interface__["data"] == address
    assert np.array_equal(flights["position"], scene.particle_positions(particles))
    assert peak(lambda: scene.move_particles(particles, targets, out=flights)) < 10000
    assert peak(lambda: scene.move_particles(particles, targets.astype(np.float32), out=flights)) > 24 * COUNT
    # A column of a wider array is lent with its stride, too.
    wide = rng.uniform(10, 38, (COUNT, 4))[:, :3]
    assert peak(lambda: scene.move_particles(particles, wide, out=flights)) < 10000


def test_results_are_owned_by_numpy_alone(scene: ds.Scene) -> None:
    body = scene.create_body([(24.0, 24.0, 40.0), (24.0, 24.0, 44.0)], [(0, 1)])
    body.move([(24.0, 24.0, 40.0), (90.0, 24.0, 44.0)])
    contacts = body.contacts()
    first = contacts.copy()
    body.move([(24.0, 24.0, 40.0), (24.0, 24.0, 44.0)])
    scene.close()
    assert len(contacts) == 1 and np.array_equal(contacts, first)


def test_nearest_of_points_and_segments(environment: ds.Environment) -> None:
    rng = np.random.default_rng(6)
    starts = rng.uniform(0, 48, (200, 3))
    ends = starts + rng.uniform(-3, 3, (200, 3))
    volumes, locations = np.empty(200, dtypes.VOLUME_ID), np.empty(200, np.int32)
    points = environment.find_nearest_to_points(starts, 20.0, volumes=volumes, locations=locations)
    out = np.empty(200, dtypes.SEGMENT_NEAREST)
    assert environment.find_nearest_to_segments(starts, ends, 20.0, hints=volumes, out=out) is out
    near = out["nearest"]
    passable = locations == ds.Location.PASSABLE
    assert passable.any() and not passable.all()
    assert np.isinf(near["distance"][~passable]).all() and (near["distance"] <= points["distance"]).all()
    found = np.isfinite(near["distance"])
    assert np.allclose(
        np.linalg.norm(out["segment_point"] - near["point"], axis=1)[found], near["distance"][found], atol=1e-12
    )
    one = environment.find_nearest(starts[passable][0], 20.0)
    assert one.distance == points["distance"][passable][0]
    assert len(environment.find_nearest_to_points(starts)) == 200
    with pytest.raises(ds.errors.WrongSize):
        environment.find_nearest_to_segments(starts, ends[:5])


def test_any_layout_gives_the_same(environment: ds.Environment) -> None:
    a = np.random.default_rng(4).uniform(10, 38, (50, 3))
    b = a[::-1].copy()
    expected = environment.cast_segments(a, b).tobytes()
    for same in (np.asfortranarray(a), a.tolist(), np.repeat(a, 2, axis=0)[::2], a.astype(">f8")):
        assert environment.cast_segments(same, b).tobytes() == expected


@pytest.mark.parametrize("wrong", [np.zeros((3, 2)), np.zeros(3), [[1, 2]], "text", [["a", "b", "c"]]])
def test_points_of_another_shape_are_refused(environment: ds.Environment, wrong: object) -> None:
    with pytest.raises((ValueError, TypeError)):
        environment._core.cast_segments(wrong, wrong, None, None, np.empty(1, dtypes.FLIGHT))


def test_arrays_to_be_filled_must_fit(scene: ds.Scene) -> None:
    particles = scene.create_particles(np.tile((24.0, 24.0, 48.0), (4, 1)))
    targets = np.tile((24.0, 24.0, 50.0), (4, 1))
    with pytest.raises(ds.errors.WrongSize):
        scene.move_particles(particles, targets, out=np.empty(3, dtypes.FLIGHT))
    with pytest.raises(TypeError):
        scene.move_particles(particles, targets, out=np.empty(4, dtypes.SWEEP))
    with pytest.raises(TypeError):
        scene.move_particles(particles, targets, out=np.empty(8, dtypes.FLIGHT)[::2])
    readonly = np.empty(4, dtypes.FLIGHT)
    readonly.flags.writeable = False
    with pytest.raises(TypeError):
        scene.move_particles(particles, targets, out=readonly)
    with pytest.raises(ds.errors.WrongSize):
        scene.move_particles(particles, targets[:3])


def test_integers_must_fit(scene: ds.Scene) -> None:
    ends = [(24.0, 24.0, 40.0), (24.0, 24.0, 44.0)]
    for edges in ([(0, -1)], [(0, 2**32)]):
        with pytest.raises(OverflowError):
            scene.create_body(ends, edges)
    with pytest.raises(TypeError):
        scene.create_body(ends, [(0.5, 1.0)])


def test_rows_have_as_many_entries_as_they_should(scene: ds.Scene) -> None:
    ends = [(24.0, 24.0, 40.0), (24.0, 24.0, 44.0)]
    for triangles in ([(0, 1)], [(0, 1), (1, 0), (0, 1)]):
        with pytest.raises(ValueError, match="shape"):
            scene.create_body(ends, triangles=triangles)
    with pytest.raises(ds.errors.WrongSize):
        scene.environment.remesh(next=np.zeros(25))


def test_ids_are_values(environment: ds.Environment, scene: ds.Scene) -> None:
    ids = scene.create_particles([(24.0, 24.0, 40.0), (24.0, 24.0, 44.0)])
    second = ds.ParticleId(1, 1)
    assert scene.particle_position(ids[1])[0].tolist() == scene.particle_position(second)[0].tolist() == [24.0, 24.0, 44.0]
    assert second == ds.ParticleId(1, 1) and second != ds.ParticleId(1, 2)
    assert len({second, ds.ParticleId(1, 1), ds.ParticleId(0, 1)}) == 2
    assert repr(second) == "ParticleId(generation=1, index=1)"
    assert scene.particle_positions([second, ds.ParticleId(0, 1)])[1].tolist() == [24.0, 24.0, 40.0]
    with pytest.raises(TypeError):
        scene.move_particle(environment.volume_id(0), (24.0, 24.0, 40.0))
    assert environment.locate((-1.0, -1.0, -1.0))[0].is_null()


def test_members_outlive_the_whole(environment: ds.Environment) -> None:
    volume = environment.cast((24.0, 24.0, 40.0), (24.0, 24.0, 44.0)).volume
    noise = [environment.cast((24.0, 24.0, 40.0), (30.0, 30.0, 90.0)) for _ in range(100)]
    assert noise and volume == environment.locate((24.0, 24.0, 44.0))[0]


def test_structs_are_laid_out_as_in_c() -> None:
    """By the numbers that abi/layout.c freezes."""
    layout = "".join(path.read_text() for path in (ROOT / "abi").glob("layout*.[ch]"))
    seen = 0
    for name, dtype in vars(dtypes).items():
        if not isinstance(dtype, np.dtype) or dtype.names is None:
            continue
        struct = "dsw_" + name.lower()
        assert f"SIZE({struct}, {dtype.itemsize});" in layout
        members = dict(re.findall(rf"AT\({struct}, (\w+), (\d+)\);", layout))
        assert {field: str(dtype.fields[field][1]) for field in dtype.names if dtype.fields} == members
        seen += 1
    assert seen == 32
