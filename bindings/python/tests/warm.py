"""Processes of their own that need not load NumPy, VTK, Gmsh and others first, which takes longer than most tests: each is a fork of a process
that has loaded them. It stands in for `subprocess` where the package starts a Python of its own."""

from __future__ import annotations

import multiprocessing
import os
import pathlib
import sys
import tempfile
from subprocess import PIPE, CompletedProcess, TimeoutExpired
from typing import Any

__all__ = ["PIPE", "CompletedProcess", "TimeoutExpired", "run"]

_CONTEXT = multiprocessing.get_context("forkserver")
_CONTEXT.set_forkserver_preload(
    ["numpy", "vtkmodules.all", "vtkmodules.util.numpy_support", "gmsh", "meshio", "h5py", "mfem.ser", "pymeshfix", "tetgen", "pytest"]
)


def run(command: list[str], input: bytes, timeout: float | None = None, **_: Any) -> CompletedProcess[bytes]:
    """What `subprocess.run` gives for [sys.executable, "-c", PROGRAM, ARGUMENT...] with its output captured."""
    executable, option, program, *arguments = command
    assert (executable, option) == (sys.executable, "-c")
    with tempfile.TemporaryDirectory() as name:
        paths = [os.path.join(name, each) for each in ("in", "out", "errors")]
        pathlib.Path(paths[0]).write_bytes(input)
        process = _CONTEXT.Process(target=_be, args=(program, arguments, paths))
        process.start()
        process.join(timeout)
        if process.is_alive():
            process.kill()
            process.join()
            assert timeout is not None
            raise TimeoutExpired(command, timeout)
        assert process.exitcode is not None
        return CompletedProcess(command, process.exitcode, *(pathlib.Path(path).read_bytes() for path in paths[1:]))


def _be(program: str, arguments: list[str], paths: list[str]) -> None:
    for number, path in enumerate(paths):
        os.dup2(os.open(path, os.O_RDONLY if number == 0 else os.O_WRONLY | os.O_CREAT), number)
    sys.argv, sys.stdin = ["-c", *arguments], open(0, closefd=False)
    exec(program, {"__name__": "__main__"})
