"""A reader that ends its process, crashes it, or never comes to an end, as files in tests say."""

from __future__ import annotations

import os
import pathlib
import signal
from typing import Any


def read(path: str, source: str, format: str) -> Any:
    """What the file's first word names."""
    word = pathlib.Path(path).read_text().split()[0]
    print("a word that no answer may have")
    if word == "exit":
        os._exit(3)
    if word == "crash":
        os.kill(os.getpid(), signal.SIGKILL)
    while word == "loop":
        pass
    raise KeyError(word)
