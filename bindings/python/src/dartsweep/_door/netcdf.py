"""Variables of a netCDF file: the classic format in its three versions by NumPy, netCDF-4 by h5py."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np

_TYPES = {1: "i1", 2: "S1", 3: ">i2", 4: ">i4", 5: ">f4", 6: ">f8", 7: "u1", 8: ">u2", 9: ">u4", 10: ">i8", 11: ">u8"}
_CHARACTERS = 2


class Variables:
    """The variables of a file that do not grow with time, by name; arrays are read when they are asked for."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._places: dict[str, tuple[str, tuple[int, ...], int]] = {}  # type, shape, where the numbers begin
        self._attributes: dict[str, dict[str, Any]] = {}
        self.dimensions: dict[str, int] = {}
        with open(path, "rb") as file:
            magic = file.read(4)
        if magic[:3] == b"CDF" and magic[3:] in (b"\1", b"\2", b"\5"):
            _Header(path, magic[3], self._places, self._attributes, self.dimensions)
        elif magic == b"\x89HDF":
            self._list_hdf()
        else:
            raise ValueError("it is no netCDF file")

    def __contains__(self, name: str) -> bool:
        return name in self._places

    def attribute(self, variable: str, name: str) -> str:
        """A text that belongs to a variable, or ""."""
        value = self._attributes.get(variable, {}).get(name, b"")
        return value.decode("latin-1") if isinstance(value, bytes) else str(value)

    def array(self, name: str) -> Any:
        """The numbers or characters of a variable; KeyError if there is none."""
        kind, shape, place = self._places[name]
        if place >= 0:
            count = int(np.prod(shape))
            return np.fromfile(self._path, kind, count, offset=place).reshape(shape) if count else np.empty(shape, kind)
        import h5py

        with h5py.File(self._path, "r") as file:
            return file[name][()]

    def texts(self, name: str) -> list[str]:
        """The rows of a variable of characters; none if there is none."""
        rows = self.array(name) if name in self else []
        return [bytes(np.asarray(row).tobytes()).split(b"\0")[0].decode("utf-8", "replace").strip() for row in rows]

    def _list_hdf(self) -> None:
        import h5py

        with h5py.File(self._path, "r") as file:
            for name, data in file.items():
                if isinstance(data, h5py.Dataset):
                    self._places[name] = (str(data.dtype), data.shape, -1)
                    self._attributes[name] = {key: value for key, value in data.attrs.items() if isinstance(value, (bytes, str))}
                    if data.attrs.get("CLASS") == b"DIMENSION_SCALE":
                        self.dimensions[name] = data.shape[0]


class _Header:
    """The head of a classic file: dimensions, attributes and variables."""

    def __init__(self, path: str, version: int, places: Any, attributes: Any, dimensions: dict[str, int]) -> None:
        with open(path, "rb") as self._file:
            self._file.seek(4)
            self._number = ">q" if version == 5 else ">i"  # counts
            self._offset = ">i" if version == 1 else ">q"
            self._get(self._number)  # of records
            names = [(self._text(), self._get(self._number)) for _ in range(self._list())]
            dimensions.update(names)
            self._attributes()
            for _ in range(self._list()):
                name = self._text()
                shape = tuple(names[self._get(self._number)][1] for _ in range(self._get(self._number)))
                attributes[name] = self._attributes()
                kind, _, begin = self._get(">i"), self._get(self._number), self._get(self._offset)
                if 0 not in shape[:1]:  # 0: it has a row for each time
                    places[name] = (_TYPES[kind], shape, begin)

    def _get(self, kind: str) -> int:
        return int(struct.unpack(kind, self._file.read(struct.calcsize(kind)))[0])

    def _text(self) -> str:
        return self._padded(self._get(self._number)).decode("utf-8", "replace")

    def _padded(self, size: int) -> bytes:
        return self._file.read(size + -size % 4)[:size]

    def _list(self) -> int:
        self._get(">i")  # what the list has
        return self._get(self._number)

    def _attributes(self) -> dict[str, bytes]:
        made = {}
        for _ in range(self._list()):
            name, kind = self._text(), self._get(">i")
            content = self._padded(self._get(self._number) * np.dtype(_TYPES[kind]).itemsize)
            if kind == _CHARACTERS:
                made[name] = content.split(b"\0")[0]
        return made
