"""The programs of the READMEs run, and print what they say."""

from __future__ import annotations

import pathlib
import re

import pytest

FOLDER = pathlib.Path(__file__).parents[1]
PROJECT = FOLDER.parents[1]


def programs(readme: pathlib.Path) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```$", readme.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_contacts(capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(programs(FOLDER / "README.md")[0], "README.md", "exec"), {})
    assert "vertex 1 met [1.    0.625 0.75 ] after 0.5" in capsys.readouterr().out


def test_plane(capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(programs(FOLDER / "README.md")[1], "README.md", "exec"), {})
    assert capsys.readouterr().out == "[[0.5 1.  0. ]]\n"


def test_ten_lines_of_the_project(capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(programs(PROJECT / "README.md")[0], "README.md", "exec"), {})
    assert capsys.readouterr().out == "vertex 1 stops at [1.   0.5  0.75] after 0.5\n"
