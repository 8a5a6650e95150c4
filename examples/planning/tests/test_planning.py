"""The sweep on a local cluster of 2 workers gives what one process gives."""

from __future__ import annotations

import csv
import pathlib
import sys

from dask.distributed import Client, LocalCluster

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))

from insertion import Outcome
from sweep import distributed, draw, plans, serial, write_table
from vessel import winding_tube


def test_two_workers_give_what_one_process_gives(tmp_path: pathlib.Path) -> None:
    work = plans(3, 2, 2)
    with winding_tube() as environment:
        block = environment.save()
    expected = serial(block, work)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        outcomes = [Outcome(*row) for row in distributed(block, work, client)]
        assert len(client.run(lambda dask_worker: dask_worker.environment.info.volume_count)) == 2
    assert outcomes == expected  # every bit of every depth
    assert {row.success for row in outcomes} == {True, False}

    write_table(tmp_path / "insertions.csv", outcomes)
    rows = list(csv.DictReader((tmp_path / "insertions.csv").open()))
    assert [float(row["depth"]) for row in rows] == [row.depth for row in outcomes]
    draw(tmp_path / "success.png", outcomes)
    assert (tmp_path / "success.png").read_bytes().startswith(b"\x89PNG")
