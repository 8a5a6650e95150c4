#!/usr/bin/env python3
"""Checks that every comment can be read alone, as an editor shows it: none begins with "The same", "As", "Likewise", "Of" or "Those", nor does a
line of it, nor a docstring of Python.

usage: check_comments.py ROOT          judges all sources of ROOT
       check_comments.py --self-test   makes small bad trees and fails unless each is refused
Exit 0: sound; 1: every line is named.

By hand: git grep -nE '^\\s*(/\\*\\*|//|/\\*|\\*)\\s*(The same|As|Likewise|Of|Those)\\b' -- src include. Clients of old releases stay as they were.
"""
import re

import judge

NEEDED = "src"
FIRST = r"\s*(?:The same|As|Likewise|Of|Those)\b"
STARRED = re.compile(r"(?:^\s*\*|(?<![:\w])//[/!]?<?|/\*[*!]?<?)" + FIRST)
HASHED = re.compile(r'(?:^\s*|[^\w"\'#]\s)#+' + FIRST + r'|^\s*(?:"""|\'\'\')' + FIRST)
DASHED = re.compile(r"--\[*" + FIRST)
RULES = {
    STARRED: ("c", "cpp", "cjs", "cs", "h", "hpp", "i", "inl", "java", "js", "mjs", "ts", "css"),
    HASHED: ("py", "pyi", "sh", "cmake", "ini", "toml"),
    DASHED: ("lua", "rockspec"),
}
BY_ENDING = {ending: rule for rule, endings in RULES.items() for ending in endings}
OLD = "abi/clients/"


def rule_of(name):
    return HASHED if name.endswith("CMakeLists.txt") else BY_ENDING.get(name.rpartition(".")[2])


def violations(root):
    found = []
    for name in sorted(judge.files_of(root)):
        rule = rule_of(name)
        if rule is None or name.startswith(OLD):
            continue
        for number, line in enumerate((root / name).read_text(errors="replace").splitlines(), 1):
            if match := rule.search(line):
                found.append(f"{name}:{number}: {line[match.start():].strip()[:60]}: what? Give the sentence a subject and a verb")
    return found


# Each tree breaks the rule once; the sound ones do not.
TREES = {
    "sound": ({"src/a.h": "/** Gives the same. As above. */\n// Office, Asks, Thosely\nint of; // of a map\nauto s = \"https://Of\";\n",
               "a.py": "# None of these\nx = '#Of'\n\"\"\"Gives them.\"\"\"\n", "abi/clients/1.0.0/x.h": "/** Likewise. */\n", "src/a.md": "# Of cells\n",
               "build/x.c": "// Of a build\n"}, 0),
    "block": ({"src/a.h": "/** Of a map. */\n"}, 1),
    "line": ({"src/a.cpp": "int x;\n  // The same for others.\n"}, 1),
    "next line": ({"src/a.h": "/** Gives it.\n * Likewise the rest. */\n"}, 1),
    "behind code": ({"src/a.c": "int x; /**< As in base.h. */\n"}, 1),
    "three slashes": ({"src/a.h": "/// Those of cells.\n"}, 1),
    "template": ({"src/a.inl": "/* As of late. */\n"}, 1),
    "Java": ({"src/a.java": "  /** Of cells. */\n"}, 1),
    "JavaScript": ({"src/a.js": "f(); // Of bodies.\n"}, 1),
    "docstring": ({"src/a.py": "def f():\n    \"\"\"Likewise for faces.\"\"\"\n"}, 1),
    "list": ({"src/CMakeLists.txt": "# Those of the library.\n"}, 1),
    "Lua": ({"src/a.lua": "-- The same in Lua.\n"}, 1),
}
judge.main(__doc__, violations, TREES, NEEDED, "comments can be read alone")
