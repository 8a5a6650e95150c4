"""Thousands of independent insertions on Dask: sweep.py --out FOLDER

Every worker loads the snapshot of the vessel once; a task is one plan. Leaves insertions.csv, one row for each plan, and success.png.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import pathlib
import time

import matplotlib
import numpy as np
from dask.distributed import Client, LocalCluster, Worker, WorkerPlugin, get_worker

import dartsweep as ds
from insertion import Outcome, Plan, insert
from vessel import winding_tube

DEPTH, FED = 30.0, 40.0


class Snapshot(WorkerPlugin):
    """Gives each worker its environment, once."""

    name = "snapshot"

    def __init__(self, block: bytes) -> None:
        self.block = block

    def setup(self, worker: Worker) -> None:
        worker.environment = ds.Environment.load(self.block)


def insert_there(plan: Plan) -> Outcome:
    return insert(get_worker().environment, plan, DEPTH, FED)


def plans(angles: int, stiffnesses: int, frictions: int) -> list[Plan]:
    return [
        Plan(float(a), float(s), float(f))
        for a, s, f in itertools.product(
            np.linspace(-40, 40, angles), np.linspace(0.02, 0.25, stiffnesses), np.linspace(0, 0.9, frictions)
        )
    ]


def serial(block: bytes, work: list[Plan]) -> list[Outcome]:
    with ds.Environment.load(block) as environment:
        return [insert(environment, plan, DEPTH, FED) for plan in work]


def distributed(block: bytes, work: list[Plan], client: Client) -> list[Outcome]:
    """The outcomes in the order of the plans, whatever worker made them."""
    client.register_plugin(Snapshot(block))
    for module in ("vessel.py", "insertion.py"):
        client.upload_file(str(pathlib.Path(__file__).with_name(module)))
    return client.gather(client.map(insert_there, work, pure=False))  # type: ignore[no-any-return]


def write_table(path: pathlib.Path, outcomes: list[Outcome]) -> None:
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(Outcome._fields)
        table.writerows(outcomes)


def draw(path: pathlib.Path, outcomes: list[Outcome]) -> None:
    """Share of successes over angle and friction, and over angle and stiffness."""
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    angles = sorted({row.angle_deg for row in outcomes})
    for axis, other in zip(axes, ("friction", "stiffness")):
        values = sorted({getattr(row, other) for row in outcomes})
        share = np.zeros((len(values), len(angles)))
        for row in outcomes:
            share[values.index(getattr(row, other)), angles.index(row.angle_deg)] += row.success
        share *= len(values) * len(angles) / len(outcomes)
        image = axis.pcolormesh(angles, values, share, vmin=0, vmax=1, cmap="viridis", shading="nearest")
        axis.set(xlabel="entry angle (degrees)", ylabel=other)
    figure.colorbar(image, ax=axes, label="share of insertions that arrive")
    figure.suptitle(f"{len(outcomes)} insertions")
    figure.savefig(path, dpi=120)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for the table and the picture")
    parser.add_argument("--angles", type=int, default=17)
    parser.add_argument("--stiffnesses", type=int, default=8)
    parser.add_argument("--frictions", type=int, default=16)
    parser.add_argument("--workers", type=int, default=2, help="processes of a cluster on this machine")
    parser.add_argument("--scheduler", help="address of a Dask scheduler instead; its workers need the dartsweep package")
    arguments = parser.parse_args()
    work = plans(arguments.angles, arguments.stiffnesses, arguments.frictions)
    with winding_tube() as environment:
        block = environment.save()
    start = time.perf_counter()
    if arguments.scheduler:
        with Client(arguments.scheduler) as client:
            outcomes = distributed(block, work, client)
    else:
        with LocalCluster(n_workers=arguments.workers, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
            outcomes = distributed(block, work, client)
    seconds = time.perf_counter() - start
    arguments.out.mkdir(parents=True, exist_ok=True)
    write_table(arguments.out / "insertions.csv", outcomes)
    draw(arguments.out / "success.png", outcomes)
    arrived = sum(row.success for row in outcomes)
    print(f"{len(outcomes)} insertions in {seconds:.1f} s, {arrived} arrived; snapshot of {len(block)} bytes")


if __name__ == "__main__":
    main()
