#!/usr/bin/env python3
"""Puts faults into a copy of the project, all in one build; the variable DSW_FAULTS turns on those whose numbers it has.

usage: plant.py TREE [--seed S] [--count N]    makes TREE anew
       plant.py TREE --mend LOG                draws others in place of faults that the compiler refused in LOG
Lines of src are drawn by the seed, all with the same chance. TREE/faults.json has the faults.
"""
import argparse
import json
import pathlib
import random
import re
import shutil

from places import Source

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LEFT_OUT = re.compile(r"DSW_ASSERT|static_assert|constexpr|^\s*#|^\s*//|^\s*\*|^\s*/\*")

# Planted code is not there to be without a warning, and a lower level compiles in half the time.
LAST_LINES = """
set_source_files_properties(base/fault.cpp PROPERTIES COMPILE_DEFINITIONS DSW_FAULT_COUNT={count} SKIP_UNITY_BUILD_INCLUSION ON)
foreach(objects IN ITEMS dartsweep_fast_objects dartsweep_usual_objects dartsweep_rare_objects dartsweep_calls_objects dartsweep_least_objects)
  target_compile_options(${{objects}} PRIVATE -O1 -w)
endforeach()
"""


class Field:
    """All lines of src, and the faults that were drawn so far."""

    def __init__(self, seed):
        paths = sorted(p for p in (ROOT / "src").rglob("*") if p.suffix in (".cpp", ".h", ".inl"))
        self.sources = {str(p.relative_to(ROOT)): p.read_text() for p in paths}
        self.parsed = {}
        self.lines = [(path, n) for path, text in self.sources.items() for n in range(text.count("\n"))]
        self.random = random.Random(seed)
        self.random.shuffle(self.lines)
        self.faults = []

    def parse(self, path):
        if path not in self.parsed:
            self.parsed[path] = Source(self.sources[path])
        return self.parsed[path]

    def draw(self):
        """One more fault: on the next line that has a place whose context no other fault has."""
        while self.lines:
            path, n = self.lines.pop()
            line = self.sources[path].split("\n")[n]
            if LEFT_OUT.search(line):
                continue
            start = sum(len(text) + 1 for text in self.sources[path].split("\n")[:n])
            places = [p for p in self.parse(path).places(start, start + len(line)) if self.is_free(path, p)]
            if places:
                # First an operator, then a place: numbers and arithmetic are much more frequent than others.
                name = self.random.choice(sorted({p[0] for p in places}))
                return {"path": path, "line": n + 1, "place": self.random.choice([p for p in places if p[0] == name])}
        raise SystemExit("no line is left")

    def is_free(self, path, place):
        _, (_, first, behind), *_ = place
        return not any(f and f["path"] == path and f["place"][1][1] < behind and first < f["place"][1][2] for f in self.faults)


def copy_tree(tree):
    """Build folders and what is not needed stay behind. Files that have not changed keep their times: the next build is quick."""
    for part in ("abi", "bindings", "examples", "include", "src", "tests", "CMakeLists.txt", "CMakePresets.json"):
        source, target = ROOT / part, tree / part
        if source.is_dir():
            shutil.copytree(source, target, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, target)
    for name in ("fault.h", "fault.cpp"):
        shutil.copy2(HERE / name, tree / "src/base" / name)


def write(path, text):
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def write_sources(tree, field):
    by_path = {}
    for number, fault in enumerate(field.faults):
        by_path.setdefault(fault["path"], []).append(field.parse(fault["path"]).planted(fault["place"], number))
    for path, text in field.sources.items():
        for start, end, new in sorted(by_path.get(path, ()), reverse=True):
            text = text[:start] + new + text[end:]
        if path in by_path:
            text = '#include "base/fault.h"\n#line 1\n' + text
        write(tree / path, text)
    sources = (ROOT / "src/sources.cmake").read_text().replace("  base/error.cpp\n", "  base/error.cpp\n  base/fault.cpp\n")
    write(tree / "src/sources.cmake", sources)
    lists = (ROOT / "src/CMakeLists.txt").read_text() + LAST_LINES.format(count=len(field.faults))
    write(tree / "src/CMakeLists.txt", lists)


def write_list(tree, field, seed, refused):
    entries = []
    for number, fault in enumerate(field.faults):
        name, (kind, first, behind), start, end, new = fault["place"]
        source = field.parse(fault["path"])
        old = source.text[start:end] if end - start < 60 else source.text[start:start + 60] + "..."
        entries.append({"number": number, "path": fault["path"], "line": fault["line"], "operator": name,
                        "old": old, "new": new if len(new) < 63 else new[:63] + "..."})
    (tree / "faults.json").write_text(json.dumps({"seed": seed, "refused": refused, "faults": entries}, indent=1))


def refused_by(log, field):
    """Numbers of faults whose lines a compiler's errors name."""
    lines = {(path, int(n)) for path, n in re.findall(r"(src/[\w/]+\.\w+):(\d+):\d+: (?:fatal )?error", log)}
    lines |= {(path, int(n)) for path, n in re.findall(r"(src/[\w/]+\.\w+):(\d+):\d+: note", log)} if not lines else set()
    found = set()
    for number, fault in enumerate(field.faults):
        source = field.parse(fault["path"])
        _, (_, first, behind), *_ = fault["place"]
        begin = source.text.count("\n", 0, source.tokens[first].at) + 1
        end = source.text.count("\n", 0, source.tokens[behind - 1].end) + 1
        if any(path == fault["path"] and begin <= n <= end for path, n in lines):
            found.add(number)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tree", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--mend", type=pathlib.Path)
    args = parser.parse_args()
    args.tree.mkdir(parents=True, exist_ok=True)
    replay = []
    seed, count = args.seed, args.count
    if args.mend:
        kept = json.loads((args.tree / "faults.json").read_text())
        seed, count, replay = kept["seed"], len(kept["faults"]), kept["refused"]
    field = Field(seed)
    while len(field.faults) < count:
        field.faults.append(field.draw())
    for refused in replay:  # draws of earlier rounds, in their order
        redraw(field, refused)
    if args.mend:
        refused = sorted(refused_by(args.mend.read_text(errors="replace"), field))
        if not refused:
            raise SystemExit("no error of the log is at a fault")
        redraw(field, refused)
        replay.append(refused)
    else:
        copy_tree(args.tree)
    write_sources(args.tree, field)
    write_list(args.tree, field, seed, replay)
    print(f"{len(field.faults)} faults by seed {seed}, {sum(map(len, replay))} were drawn again")


def redraw(field, numbers):
    for number in numbers:
        field.faults[number] = None
    for number in numbers:
        field.faults[number] = field.draw()


if __name__ == "__main__":
    main()
