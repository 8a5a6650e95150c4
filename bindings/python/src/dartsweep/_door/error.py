"""The error of all that reads meshes. It needs nothing of the compiled library."""

from __future__ import annotations


class MeshError(ValueError):
    """A mesh can't be read, or is no environment. The text names the file, what was found, and what to do."""

    def __init__(self, file: str, found: str, way_on: str) -> None:
        super().__init__(file, found, way_on)
        self.file = file
        """The file, or what else the mesh came from."""
        self.found = found
        """What was found, with the reader's own reason."""
        self.way_on = way_on
        """What can be done."""

    def __str__(self) -> str:
        return f"{self.file}: {self.found}; {self.way_on}"


class CutShort(MeshError):
    """A file ends before what it announces."""


MeshError.__module__ = "dartsweep.errors"
