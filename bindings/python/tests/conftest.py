from __future__ import annotations

from collections.abc import Iterator

import pytest

import dartsweep as ds
import warm
from dartsweep import surfaces
from dartsweep._door import apart
from scenario import create


@pytest.fixture(autouse=True)
def _start_processes_warm(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Tests of what a process of its own loads, and of how one ends, are marked `cold`: they get one that is begun as users' are."""
    if request.node.get_closest_marker("cold") is None:
        for module in (apart, surfaces):
            monkeypatch.setattr(module, "subprocess", warm)


@pytest.fixture
def environment() -> Iterator[ds.Environment]:
    """The scenario's vessel, its outer cells marked."""
    with create() as made:
        made.mark_region(2)
        yield made


@pytest.fixture
def scene(environment: ds.Environment) -> Iterator[ds.Scene]:
    with ds.Scene(environment) as made:
        yield made
