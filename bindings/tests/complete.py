#!/usr/bin/env python3
"""Fails when a C function is used nowhere in the C++ interface, or a list of the bindings is not that of the headers.
Usage: complete.py ROOT"""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(root / "bindings/common"))
from headers import Headers, Machine  # noqa: E402

headers = Headers(root)  # fails where lists of enums, flags or statuses are not complete
Machine(headers)  # likewise of structs
declared = set(headers.functions)
sources = [*(root / "include/dartsweep/cpp").glob("*.hpp"), *(root / "bindings/common").glob("*.i")]
layer = "".join(path.read_text() for path in sources)
used = set(re.findall(r"\bdsw_\w+", layer))
# Called by macros for all descriptions, or wrapped as it is.
used |= {name + "_init" for name in headers.listed("DESCRIPTION")}
used |= {"dsw_version", "dsw_status_string"}
# What a host gets otherwise: a scene knows its environment.
used.add("dsw_scene_get_environment")
# Replays are looked at with a program in C, examples/replay.
used |= {name for name in declared if name.startswith("dsw_replay_")}
missing = sorted(declared - used)
if missing:
    sys.exit("no method in include/dartsweep/cpp calls " + ", ".join(missing))
print(f"bindings: all {len(declared)} functions of the interface are reached")
