#!/usr/bin/env python3
"""Checks that tests/modules.txt names every module of src once, no other, and only programs that CMake makes.

usage: check_modules.py ROOT          judges ROOT
       check_modules.py --self-test   makes small bad trees and fails unless each is refused
Exit 0: sound; 1: every violation is named.
"""
import re

import judge

TABLE = "tests/modules.txt"
NEEDED = TABLE
PROGRAM = re.compile(r"^\s*(?:add_executable|dsw_property_test)\(\s*([\w-]+)", re.M)


def violations(root):
    files = list(judge.files_of(root))
    modules = {name.split("/")[1] for name in files if re.fullmatch(r"src/\w+/\w+\.(?:h|cpp)", name)}
    programs = {f"capi_{match[1]}_test" for name in files if (match := re.fullmatch(r"tests/capi/(\w+)_test\.c", name))}
    for name in files:
        if name.startswith("tests/") and name.endswith("CMakeLists.txt"):
            programs |= set(PROGRAM.findall((root / name).read_text()))
    found, named = [], []
    for line in (root / TABLE).read_text().splitlines():
        words = line.split()
        if not words or line.startswith("#"):
            continue
        named.append(words[0])
        if len(words) == 1:
            found.append(f"{TABLE}: {words[0]} has no program")
        found += [f"{TABLE}: no program {program}" for program in words[1:] if program not in programs]
    found += [f"{TABLE}: src has no module {name}" for name in named if name not in modules]
    found += [f"{TABLE}: {name} is missing" for name in sorted(modules - set(named))]
    return found + [f"{TABLE}: {name} stands there twice" for name in sorted(set(named)) if named.count(name) > 1]


def tree(table):
    return {
        TABLE: "# a comment\n" + table, "src/base/a.h": "", "src/map/a.cpp": "", "tests/capi/x_test.c": "",
        "tests/unit/base/CMakeLists.txt": "add_executable(base_test a.cpp)\n"
    }


TREES = {
    "sound": (tree("base  base_test capi_x_test\nmap base_test\n"), 0),
    "a program that is not made": (tree("base base_test other_test\nmap base_test\n"), 1),
    "a module that is missing": (tree("base base_test\n"), 1),
    "a module that is not there": (tree("base base_test\nmap base_test\nflood base_test\n"), 1),
    "a module without a program": (tree("base base_test\nmap\n"), 1),
    "a module twice": (tree("base base_test\nmap base_test\nmap base_test\n"), 1),
}
judge.main(__doc__, violations, TREES, NEEDED, "every module has its first tests")
