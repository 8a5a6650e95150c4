"""Descriptions and options, which the C interface makes with its defaults."""

from __future__ import annotations

from typing import Any, TypeVar

from . import _core

Description = TypeVar("Description")


def options(kind: type[Description], **values: Any) -> Description:
    """Options of a kind, such as MoveOptions, with its defaults but for `values`."""
    made = kind()
    for name, value in values.items():
        try:
            setattr(made, name, value)
        except AttributeError as error:
            raise TypeError(str(error)) from None
    return made


def version() -> str:
    """Version of the loaded library."""
    number = int(_core.version())
    return f"{number // 1000000}.{number // 1000 % 1000}.{number % 1000}"
