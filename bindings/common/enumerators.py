#!/usr/bin/env python3
"""Takes from enumerators what they have in common, in enums that SWIG wrote: Place.PLACE_OUTSIDE becomes Place.OUTSIDE. (SWIG can't:
to C they are names of one scope.) Usage: enumerators.py FOLDER SUFFIX"""

import pathlib
import re
import sys

folder, suffix = sys.argv[1:]
for path in sorted(pathlib.Path(folder).glob("*" + suffix)):
    text = path.read_text()
    if not re.search(r"^public enum ", text, re.M):
        continue
    names = re.findall(r"^  ([A-Z][A-Z0-9_]*)(?=\(| =)", text, re.M)
    common = names[0]
    for name in names:
        while not name.startswith(common):
            common = common[:-1]
    prefix = common[: common.rindex("_") + 1]
    path.write_text(re.sub(rf"^  {prefix}", "  ", text, flags=re.M))
