#!/usr/bin/env python3
"""Takes from enumerators what they have in common, in enums that SWIG wrote: Location.LOCATION_OUTSIDE becomes Location.OUTSIDE. (SWIG can't:
to C they are names of one scope.) With "camel" they become Location.Outside. Usage: enumerators.py FOLDER SUFFIX [camel]"""

import pathlib
import re
import sys

folder, suffix = sys.argv[1:3]
camel = sys.argv[3:] == ["camel"]
for path in sorted(pathlib.Path(folder).glob("*" + suffix)):
    text = path.read_text()
    if not re.search(r"^\s*public enum ", text, re.M):
        continue
    names = re.findall(r"^  ([A-Z][A-Z0-9_]*)(?=\(| =)", text, re.M)
    common = names[0]
    for name in names:
        while not name.startswith(common):
            common = common[:-1]
    prefix = common[: common.rindex("_") + 1]

    def shorter(found: re.Match[str]) -> str:
        name = found[1]
        return "  " + ("".join(part.capitalize() for part in name.split("_")) if camel else name)

    path.write_text(re.sub(rf"^  {prefix}([A-Z0-9_]+)", shorter, text, flags=re.M))
