#!/usr/bin/env python3
"""Checks the include lines of a tree against layers.ini, and that no source file is too long.

usage: check_layers.py ROOT          judges ROOT by layers.ini
       check_layers.py --self-test   makes small bad trees and fails unless each is refused
Exit 0: sound; 1: every violation is named.
"""
import configparser
import fnmatch
import pathlib
import re
import sys

import judge

RULES = pathlib.Path(__file__).with_name("layers.ini")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
CODE = {".h", ".inl", ".c", ".cpp"}
COUNTED = CODE | {".cjs", ".cmake", ".cs", ".css", ".hpp", ".html", ".i", ".java", ".js", ".lua", ".mjs", ".py", ".pyi", ".sh", ".ts"}


def read_rules():
    rules = configparser.ConfigParser(delimiters=("=",), interpolation=None)
    rules.optionxform = str
    rules.read_string(RULES.read_text())
    allowed = {}
    for module, highest in rules["modules"].items():
        names = set(allowed) if highest == "above" else set(highest.split())
        unknown = names - set(allowed)
        if unknown:
            sys.exit(f"layers.ini: {module} names {sorted(unknown)} before they have a row")
        allowed[module] = {module, "base"}.union(*(allowed[name] for name in names))
    return rules, allowed


def includes(path):
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) or match.group(2)


def outside_is_allowed(rules, header, module, path):
    if "/" not in header and "." not in header:
        return True
    for pattern, who in rules["outside"].items():
        if fnmatch.fnmatchcase(header, pattern):
            names = who.split()
            if path.suffix == ".cpp" and ("all.cpp" in names or f"{module}.cpp" in names):
                return True
            return "all" in names or module in names
    return False


def check_src(root, rules, allowed):
    for path in sorted((root / "src").rglob("*")):
        if path.suffix not in CODE:
            continue
        module = path.relative_to(root / "src").parts[0]
        if module not in allowed:
            yield f"{path}: module {module} has no row in layers.ini"
            continue
        for number, header in includes(path):
            target = header.split("/")[0]
            if header.startswith(".") or (root / "src" / module / header).exists():
                yield f"{path}:{number}: {header}: write includes relative to src/"
            elif target in allowed and "/" in header:
                if target not in allowed[module]:
                    yield f"{path}:{number}: {module} may not include {target} ({header})"
            elif not outside_is_allowed(rules, header, module, path):
                yield f"{path}:{number}: {module} may not include {header}"


def check_public_only(root, rules, allowed):
    for folder in rules["public_only"]["folders"].split():
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in CODE:
                continue
            for number, header in includes(path):
                if "/" in header and header.split("/")[0] in allowed and (root / "src" / header).exists():
                    yield f"{path}:{number}: {folder} sees only include/, not {header}"


def check_size(root, rules):
    folders = tuple(folder + "/" for folder in rules["size"]["folders"].split())
    for name in sorted(judge.files_of(root)):
        path = root / name
        if name.startswith(folders) and path.suffix in COUNTED:
            limit = rules["too long"].getint(name, rules["size"].getint("max_lines"))
            count = len(path.read_text(errors="replace").splitlines())
            if count > limit:
                yield f"{path}: {count} lines, more than {limit}: split it by concept"


def violations(root):
    rules, allowed = read_rules()
    return [*check_src(root, rules, allowed), *check_public_only(root, rules, allowed), *check_size(root, rules)]


# Each tree breaks one rule once; the first breaks none.
TREES = {
    "sound": ({"src/walk/cast.cpp": '#include "walk/cast.h"\n#include <vector>\n#include "base/span.h"\n'
                                      '#include "map/dart.h"\n',
               "src/base/vec.h": "#include <Eigen/Core>\n",
               "src/capi/scene.cpp": '#include "dartsweep/scene.h"\n#include "scene/scene.h"\n',
               "examples/c/hello.c": '#include <dartsweep/dartsweep.h>\n#include <stdio.h>\n'}, 0),
    "upwards": ({"src/map/dart.h": '#include "environment/environment.h"\n'}, 1),
    "sideways": ({"src/map/dart.cpp": '#include "predicates/exact.h"\n'}, 1),
    "spaced": ({"src/map/dart.cpp": '  #  include   "predicates/exact.h"\n'}, 1),
    "base knows all": ({"src/base/error.cpp": '#include "map/map.h"\n'}, 1),
    "relative": ({"src/map/dart.cpp": '#include "../base/error.h"\n'}, 1),
    "bare": ({"src/map/dart.cpp": '#include "dart.h"\n', "src/map/dart.h": "\n"}, 1),
    "public header inside": ({"src/walk/cast.h": '#include "dartsweep/particle.h"\n'}, 1),
    "C interface from inside": ({"src/scene/scene.cpp": '#include "capi/guard.h"\n'}, 1),
    "Eigen past base": ({"src/walk/cast.cpp": "#include <Eigen/Core>\n"}, 1),
    "stranger": ({"src/walk/cast.cpp": "#include <boost/any.hpp>\n"}, 1),
    "libccd outside of contact": ({"src/walk/cast.cpp": "#include <ccd/ccd.h>\n"}, 1),
    "module without a row": ({"src/mystery/x.cpp": "\n"}, 1),
    "example sees src": ({"src/map/map.h": "\n", "examples/c/x.c": '#include "map/map.h"\n'}, 1),
    "too long": ({"src/map/map.cpp": "\n" * 601}, 1),
    "long enough": ({"src/map/map.cpp": "\n" * 600}, 0),
    "long test": ({"tests/unit/map/map_test.cpp": "\n" * 700}, 1),
    "long in C++ headers": ({"include/dartsweep/cpp/scene.hpp": "\n" * 601}, 1),
    "long in other languages": ({f"bindings/x/a.{ending}": "\n" * 601 for ending in ("cs", "java", "js", "lua", "pyi", "ts")}, 6),
    "made": ({"bindings/node/node_modules/a.js": "\n" * 601, "bindings/java/target/A.java": "\n" * 601}, 0),
}

judge.main(__doc__, violations, TREES, "src", "includes and sizes are in order")
