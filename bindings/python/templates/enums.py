"""Constants of the C interface, named as there without their prefixes."""

from __future__ import annotations

from enum import IntEnum, IntFlag

from . import _core


class Constant(IntEnum):
    """A constant that prints as its name; otherwise an integer."""

    def __str__(self) -> str:
        return f"{type(self).__name__}.{self.name}"

    __repr__ = __str__

    def __format__(self, spec: str) -> str:
        return format(str(self) if spec == "" else int(self), spec)


class Flags(IntFlag):
    """Flags that print as their names; otherwise an integer."""

    def __str__(self) -> str:
        names = [flag.name or "" for flag in type(self) if flag and flag in self]
        return f"{type(self).__name__}.{'|'.join(names) or int(self)}"

    __repr__ = __str__

    def __format__(self, spec: str) -> str:
        return format(str(self) if spec == "" else int(self), spec)


# {enums}


def _give_to_core() -> None:
    """Members and results of the C interface are these constants from now on."""
    for kind in Constant.__subclasses__():
        register = getattr(_core, f"set_enum_{kind.__name__}", None)
        if register is not None:
            register(dict(kind._value2member_map_))


_give_to_core()
