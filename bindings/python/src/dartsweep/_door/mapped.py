"""The bytes of a file, for a search that does not read all of it into memory."""

from __future__ import annotations

import contextlib
import mmap
import os
from collections.abc import Iterator
from typing import Any


@contextlib.contextmanager
def mapped(path: str) -> Iterator[Any]:
    """What `re` can search; an empty file can not be mapped, and has no bytes."""
    if os.path.getsize(path) == 0:
        yield b""
        return
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        yield text
