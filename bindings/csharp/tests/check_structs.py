#!/usr/bin/env python3
"""Fails where a struct of Structs.cs has other members than its C struct, or in another order; the tests compare sizes.
Usage: check_structs.py ROOT"""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
text = "\n".join(path.read_text() for path in sorted((root / "include/dartsweep").glob("*.h")))
headers = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
source = re.sub(r"///?.*", "", (root / "bindings/csharp/src/Structs.cs").read_text())
elements = (root / "bindings/common/elements.i").read_text()
names = dict(re.findall(r"X\((dsw_\w+), (\w+)\)", elements)) | {"uint32_t": "uint", "double": "double"}


def camel(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


def members_in_c(body: str) -> list[str]:
    found = []
    for c_type, member, dims in re.findall(r"(\w+) (\w+)((?:\[\d\])*);", body):
        sizes = [int(size) for size in re.findall(r"\d", dims)]
        is_point = c_type == "double" and sizes[-1:] == [3]
        count = (sizes[:-1] if is_point else sizes) or [0]
        numbers = range(count[0]) if count[0] else [""]
        found += [f"{'Vec3' if is_point else names[c_type]} {camel(member)}{number}" for number in numbers]
    return found


def members_in_cs(body: str) -> list[str]:
    found = re.findall(r"(?:public|internal) (\w+) ([\w, ]+);", body)
    return [f"{cs_type} {member}" for cs_type, members in found for member in members.split(", ")]


checked = 0
for name, body in re.findall(r"public partial struct (\w+)\s*\{(.*?)\}", source, re.S):
    c_name = next((key for key, value in names.items() if value == name), None)
    if c_name is None or not c_name.startswith("dsw_"):
        continue  # Vec3
    expected = members_in_c(re.search(rf"typedef struct {c_name} \{{(.*?)\}}", headers, re.S)[1])
    if members_in_cs(body) != expected:
        sys.exit(f"{name} has {members_in_cs(body)}\n{c_name} has {expected}")
    checked += 1
print(f"{checked} structs of C# have the members of C")
