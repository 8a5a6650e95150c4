#!/usr/bin/env python3
"""Fails when an exported C function is used nowhere in the C++ interface. Usage: complete.py ROOT"""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
exported = set(re.findall(r"^dsw_\w+", (root / "abi/symbols.txt").read_text(), re.M))
sources = [*(root / "include/dartsweep/cpp").glob("*.hpp"), *(root / "bindings/common").glob("*.i")]
layer = "".join(path.read_text() for path in sources)
used = set(re.findall(r"\bdsw_\w+", layer))
# Made from the lists of elements.i, or wrapped as it is.
used |= {name + "_init" for name in re.findall(r"X\((dsw_\w+),", layer)}
used |= {"dsw_version", "dsw_status_string"}
# What a host gets otherwise: a scene knows its environment.
used.add("dsw_scene_get_environment")
# Replays are looked at with a program in C, examples/replay.
used |= {name for name in exported if name.startswith("dsw_replay_")}
missing = sorted(exported - used)
if missing:
    sys.exit("no method in include/dartsweep/cpp calls " + ", ".join(missing))
print(f"bindings: all {len(exported)} functions of the interface are reached")
