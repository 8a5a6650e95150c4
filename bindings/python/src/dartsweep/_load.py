"""Loads the library that DARTSWEEP_LIBRARY names, before the module asks for one."""

from __future__ import annotations

import ctypes
import os

from ._library import SHARED


def load() -> str | None:
    """The path of the library that was loaded; None without the variable. Raises an ImportError if the module has the library in it, or
    if the library can't be loaded. With a library of an earlier release, importing the module then fails, and its error names what is missing."""
    path = os.environ.get("DARTSWEEP_LIBRARY")
    if not path:
        return None
    if not SHARED:
        raise ImportError("DARTSWEEP_LIBRARY is set, but this module has the library in it: build it with -DDSW_PYTHON_SHARED=ON")
    try:
        ctypes.CDLL(path, mode=ctypes.RTLD_GLOBAL)
    except OSError as error:
        raise ImportError(f"DARTSWEEP_LIBRARY: {error}") from error
    return path
