#!/usr/bin/env python3
"""Writes the functions that the headers declare and the structs that begin with their size as macros, for arguments.h and boundary_test.cpp.

usage: list_functions.py HEADER_DIR

FUNCTION(name, "a,b") has the names of its parameters; REPORT(struct) is filled by the library; DESCRIPTION(struct) is read by it and has
defaults, and MEMBER(struct, member) can be wrong.
"""
import pathlib
import re
import sys

headers = pathlib.Path(sys.argv[1])
text = "".join(path.read_text() for path in sorted(headers.glob("*.h")))
text = re.sub(r"/\*.*?\*/|^#.*?$", "", text, flags=re.S | re.M)
prototypes = dict(re.findall(r"^DSW_API\b[^;(]*?(\w+)\(([^)]*)\);", text, re.M))
names = sorted(prototypes)
if len(re.findall(r"^DSW_API\b", text, re.M)) != len(names) or not names:
    sys.exit("a declaration that is not understood")
for name in names:
    parameters = [re.search(r"(\w+)\s*$", each)[1] for each in prototypes[name].split(",")]
    print(f'FUNCTION({name}, "{"" if parameters == ["void"] else ",".join(parameters)}")')
for body, struct in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", text, re.S):
    members = [each for line in body.split(";")[:-1] for each in re.findall(r"(\w+)\s*(?:\[\w+\])*\s*(?:,|$)", line)]
    if members[0] != "struct_size":
        continue
    if struct + "_init" not in names:
        print(f"REPORT({struct})")
        continue
    print(f"DESCRIPTION({struct})")
    for member in members[1:]:
        print(f"MEMBER({struct}, {member})")
