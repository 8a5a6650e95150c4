from __future__ import annotations

import copy
import pickle

import numpy as np

import dartsweep as ds
from scenario import create_catheter


def test_a_copy_goes_on_with_the_same_bits(environment: ds.Environment) -> None:
    rng = np.random.default_rng(5)
    with ds.Scene(environment, ds.Feature.STATISTICS) as scene:
        particles = scene.create_particles(np.tile((24.0, 24.0, 48.0), (100, 1)))
        body = create_catheter(scene)
        scene.move_particles(particles, rng.uniform(0, 48, (100, 3)))
        body.move(body.positions() + (20.0, 3.0, 1.0))
        with pickle.loads(pickle.dumps(scene)) as other, copy.deepcopy(environment) as same:
            assert other.save() == scene.save() and same.save() == environment.save()
            assert other.environment is not environment
            twin = other.body(body.id)
            assert twin.contacts().tobytes() == body.contacts().tobytes()
            for _ in range(5):
                targets = rng.uniform(0, 48, (100, 3))
                assert other.move_particles(particles, targets).tobytes() == scene.move_particles(particles, targets).tobytes()
                way = rng.uniform(-9, 9, 3)
                body.move(body.positions() + way)
                twin.move(twin.positions() + way)
                assert twin.positions().tobytes() == body.positions().tobytes()
            assert repr(other.statistics) == repr(scene.statistics)


def test_scenes_of_one_environment_stay_together(environment: ds.Environment) -> None:
    with ds.Scene(environment) as a, ds.Scene(environment) as b:
        first, second = pickle.loads(pickle.dumps((a, b)))
        assert first.environment is second.environment
