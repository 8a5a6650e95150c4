#!/usr/bin/env python3
"""Writes dartsweep.lua: that of the folder src, with the methods that make the array that another one fills.
Usage: declare.py ROOT SOURCE OUT"""

import pathlib
import sys

root, source, out = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(root / "bindings/common"))
from headers import Headers, Method, Parameter  # noqa: E402

BY_HAND = {"locate_points", "get_particle_positions", "move_rigid"}  # two arrays, or by bodies and numbers
DEFAULTS = {"by": "0", "radius": "math.huge"}

headers = Headers(root)
names = {c_name: name for kind in ("ID", "RECORD") for c_name, name in headers.listed(kind).items()}


def filler(method: Method, answer: Parameter) -> str:
    first = method.parameters[0]
    count = f"#{first.name} // self:dimension()" if first.type == "Points" else f"#{first.name}"
    lines = [f"  {first.name} = core.points({first.name}, self:dimension())"] if first.type == "Points" else []
    arguments = [each.name for each in method.parameters]
    if answer.type == "PointsOut":  # always made
        arguments.remove(answer.name)
        lines.append(f"  local {answer.name} = core.DoubleArray(#{first.name})")
    else:
        lines.append(f"  {answer.name} = {answer.name} or core.{names[answer.element]}Array({count})")
    passed = [each.name + (f" or {DEFAULTS[each.name]}" if each.name in DEFAULTS else "") for each in method.parameters]
    return (f"local {method.name} = {method.owner}.{method.name}\n"
            f"function {method.owner}:{method.name}({', '.join(arguments)})\n" + "\n".join(lines)
            + f"\n  {method.name}(self, {', '.join(passed)})\n  return {answer.name}\nend\n")


mark = "-- {fillers}\n"
text = source.read_text()
assert mark in text
made = [filler(method, answer) for owner in ("Environment", "Scene") for method, answer in headers.fillers(owner) if method.name not in BY_HAND]
out.write_text(text.replace(mark, "\n".join(made)))
