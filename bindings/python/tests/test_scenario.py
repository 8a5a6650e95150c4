from __future__ import annotations

import json
import pathlib

from scenario import play

EXPECTED = pathlib.Path(__file__).parents[2] / "tests" / "scenario.json"


def test_all_bits_are_those_of_c() -> None:
    expected = json.loads(EXPECTED.read_text())
    result = play()
    assert list(result) == list(expected)
    for stage, patterns in expected.items():
        assert result[stage] == patterns, stage
