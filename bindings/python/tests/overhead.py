"""What Python adds to C. Usage: overhead.py PROGRAM, the one that bindings/tests/overhead.c makes.

Prints python.overhead_batch (time of a batch of 10,000 moves over that in C) and python.overhead_single (microseconds that one move costs
over C), the least of several alternating runs.
"""

from __future__ import annotations

import pathlib
import subprocess
import sys
import tempfile
import timeit

import numpy as np
from numpy.typing import NDArray

import dartsweep as ds

COUNT = 10000
GRID = 20


def grid() -> ds.Environment:
    """Cubes of size 1."""
    edge = np.arange(GRID + 1)
    points = np.stack(np.meshgrid(edge, edge, edge, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    index = np.arange(len(points)).reshape(GRID + 1, GRID + 1, GRID + 1)
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = np.stack([index[a : a + GRID, b : b + GRID, c : c + GRID].ravel() for a, b, c in corners], axis=1)
    return ds.Environment(points, cells, threads=1)


def python_times(
    environment: ds.Environment, first: NDArray[np.float64], second: NDArray[np.float64]
) -> tuple[float, float]:
    with ds.Scene(environment) as scene:
        particles = scene.create_particles(first)
        out = np.empty(COUNT, ds.dtypes.FLIGHT)

        def there_and_back() -> None:
            scene.move_particles(particles, second, out=out)
            scene.move_particles(particles, first, out=out)

        batch = min(timeit.repeat(there_and_back, number=1, repeat=50)) / 2
        one, a, b = particles[0], first[0].copy(), second[0].copy()

        def single() -> None:
            scene.move_particle(one, b)
            scene.move_particle(one, a)

        # Runs so short that some are not interrupted on a busy machine.
        return batch, min(timeit.repeat(single, number=250, repeat=200)) / 500


def main() -> None:
    rng = np.random.default_rng(1)
    first = rng.uniform(1, GRID - 1, (COUNT, 3))
    second = np.clip(first + rng.normal(0, 1, (COUNT, 3)), 0.5, GRID - 0.5)
    batches, singles = [], []
    with grid() as environment, tempfile.TemporaryDirectory() as folder:
        snapshot, positions = pathlib.Path(folder, "snapshot"), pathlib.Path(folder, "positions")
        snapshot.write_bytes(environment.save())
        positions.write_bytes(np.concatenate([first, second]).tobytes())
        for _ in range(5):
            told = subprocess.run([sys.argv[1], snapshot, positions, str(COUNT)], check=True, capture_output=True, text=True)
            in_c = [float(value) for value in told.stdout.split()]
            batch, single = python_times(environment, first, second)
            batches.append((batch, in_c[0]))
            singles.append((single, in_c[1]))
    batch, batch_c = (min(column) for column in zip(*batches))
    single, single_c = (min(column) for column in zip(*singles))
    print(f"a batch of {COUNT} moves: {1e6 * batch:.1f} us, in C {1e6 * batch_c:.1f} us")
    print(f"one move: {1e6 * single:.3f} us, in C {1e6 * single_c:.3f} us")
    print(f"python.overhead_batch {batch / batch_c:.3f}")
    print(f"python.overhead_single {1e6 * (single - single_c):.3f}")


if __name__ == "__main__":
    main()
