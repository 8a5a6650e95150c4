from __future__ import annotations

from collections.abc import Iterator

import pytest

import dartsweep as ds
from scenario import create


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
