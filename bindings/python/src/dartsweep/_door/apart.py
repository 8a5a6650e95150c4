"""Readers in a process of their own. Some libraries end or crash the process on files in which they find no fault, or never come to an end;
the caller shall live, and get a MeshError."""

from __future__ import annotations

import importlib
import math
import os
import pickle
import signal
import subprocess
import sys
from typing import Any

from .error import MeshError

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

_START = """
import sys, types
package = sys.modules["dartsweep"] = types.ModuleType("dartsweep")
package.__path__, sys.path[:] = [sys.argv[1]], sys.argv[2:]
from dartsweep._door import apart
apart.answer()
"""
"""The program that reads: the readers alone, without the compiled library, which may not be there."""
_WAY_ON = "the file may be damaged; a program that reads it can write it anew"
SECONDS, SECONDS_PER_MEGABYTE = 60.0, 10.0
"""How long a reader may take, in time of the processor, so that a busy machine makes no difference."""
_PATIENCE = 30
"""How many times longer a reader may take that waits; without limits of processor time, as on Windows, none does."""
_CASES = (".foam", ".case", ".encas")
"""Endings of files that name others, whose size is not known: their readers have all the time that they want."""


def read(library: str, module: str, path: str, source: str, *more: str) -> Any:
    """What `read` of a module gives for a file. library: its name in messages."""
    limit = None if path.lower().endswith(_CASES) else math.ceil(SECONDS + SECONDS_PER_MEGABYTE * os.path.getsize(path) / 1e6)
    patience = None if limit is None else _PATIENCE * limit if resource is not None else limit
    command = [sys.executable, "-c", _START, os.path.dirname(os.path.dirname(__file__)), *map(str, sys.path)]
    too_late = MeshError(source, f"{library} had not read it after {limit} s", _WAY_ON)
    try:
        done = subprocess.run(
            command, input=pickle.dumps((limit, module, path, source, *more)), capture_output=True, check=False, timeout=patience
        )
    except subprocess.TimeoutExpired as error:
        raise too_late from error
    if resource is not None and done.returncode == -signal.SIGXCPU:
        raise too_late
    if done.returncode != 0 or not done.stdout:
        raise MeshError(source, f"{library} has crashed ({_reason(done)})", _WAY_ON)
    found = pickle.loads(done.stdout)
    if isinstance(found, tuple):
        raise MeshError(*found)
    return found


def _reason(done: subprocess.CompletedProcess[bytes]) -> str:
    last = done.stderr.decode(errors="replace").strip().rpartition("\n")[2]
    try:
        code = signal.Signals(-done.returncode).name if done.returncode < 0 else f"exit code {done.returncode}"
    except ValueError:
        code = f"signal {-done.returncode}"
    return f"{last}, {code}" if last else code


def answer() -> None:
    """What the process does: it reads a request from its standard input and writes a pickle of what was read, or of the arguments of a
    MeshError."""
    with os.fdopen(os.dup(1), "wb") as out:
        os.dup2(2, 1)  # what others print does not go to the answer
        limit, module, *arguments = pickle.load(sys.stdin.buffer)
        if limit is not None and resource is not None:
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
        try:
            found: Any = importlib.import_module(module).read(*arguments)
        except MeshError as error:
            found = (error.file, error.found, error.way_on)
        pickle.dump(found, out, protocol=5)
