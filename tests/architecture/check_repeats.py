#!/usr/bin/env python3
"""Counts the lines by which bindings repeat statuses, enumerators and structs of the headers by hand: all lines of files that are there for
them, and lists elsewhere. Fails above a bound, and where another file begins to repeat them.

usage: check_repeats.py ROOT [-v]
       check_repeats.py --self-test
"""
import pathlib
import re
import sys
import tempfile

BOUND = 500
# Files, whole. Those that have gone stand here so that they don't come back uncounted.
WHOLE = [
    "bindings/common/*.i",
    "bindings/python/src/dartsweep/enums.py", "bindings/python/src/dartsweep/errors.py", "bindings/python/src/dartsweep/dtypes.py",
    "bindings/python/src/dartsweep/*.pyi", "bindings/python/templates/*",
    "bindings/csharp/src/Structs.cs", "bindings/csharp/src/Errors.cs", "bindings/csharp/src/Values.cs",
    "bindings/java/src/main/java/dartsweep/*Id.java", "bindings/java/src/main/java/dartsweep/DartsweepException.java",
    "bindings/node/src/structs*", "bindings/lua/src/structs*",
]
# Elsewhere: a list's line, which names one of them in a macro or a directive of SWIG.
LISTED = re.compile(r"^ *(?:X|DSW_\w+)\((?:DSW_|dsw_|dartsweep::)?\w+(?:, [\w.]+)*\) *\\?;?$|^%(?:ignore|immutable) (?:dsw_|dartsweep::)\w+::\w+;")
SOURCES = ["bindings/*/*.i", "bindings/*/*.h", "bindings/*/*.py", "bindings/*/src/**/*", "include/dartsweep/cpp/*.hpp"]


def lines_of(path: pathlib.Path) -> list[str]:
    return [line for line in path.read_text().split("\n") if line.strip()]


def counted(root: pathlib.Path) -> dict[str, int]:
    found = {}
    for path in sorted(path for pattern in WHOLE for path in root.glob(pattern)):
        found[str(path.relative_to(root))] = len(lines_of(path))
    for path in sorted(path for pattern in SOURCES for path in root.glob(pattern) if path.is_file()):
        name = str(path.relative_to(root))
        number = sum(bool(LISTED.match(line)) for line in lines_of(path))
        if name not in found and number:
            found[name] = number
    return found


def strangers(root: pathlib.Path, known: set[str]) -> list[str]:
    """Other files that name more than a third of all statuses, or declare more than a third of all structs."""
    headers = "\n".join(path.read_text() for path in sorted((root / "include/dartsweep").glob("*.h")))
    statuses = re.findall(r"\bDSW_STATUS_(\w+) = \d", headers)
    structs = re.findall(r"^typedef struct dsw_(\w+) \{", headers, re.M)

    def camel(name: str) -> str:
        return "".join(part.capitalize() for part in name.split("_"))

    wrong = []
    for path in sorted(path for pattern in SOURCES for path in root.glob(pattern) if path.is_file()):
        text, name = path.read_text(), str(path.relative_to(root))
        named = [status for status in statuses if re.search(rf"\b({status}|{camel(status)}(Exception|Error)?)\b", text)]
        declared = [struct for struct in structs if re.search(rf"\b(class|struct|interface|record) {camel(struct)}\b", text)]
        if name not in known and (3 * len(named) > len(statuses) or 3 * len(declared) > len(structs)):
            wrong.append(f"{name} names {len(named)} statuses and declares {len(declared)} structs: bindings/common/headers.py has them")
    return wrong


def problems(root: pathlib.Path, found: dict[str, int]) -> list[str]:
    total = sum(found.values())
    print(f"{total} lines repeat statuses, enumerators and structs by hand")
    return strangers(root, set(found)) + ([f"at most {BOUND} are allowed"] if total > BOUND else [])


def self_test() -> None:
    """What repeats the headers is refused: in a file that is listed, and in another one."""
    header = "".join(f"  DSW_STATUS_KIND_{letter} = 1,\n" for letter in "ABCDEFGH")
    repeated = "class KindA\nclass KindB\nclass KindCError\n"
    cases = {
        "nothing": ("bindings/any/src/a.py", "x = 1\n", 0),
        "two statuses": ("bindings/any/src/a.py", "KIND_A, KIND_B", 0),
        "a third of the statuses": ("bindings/any/src/a.py", "KIND_A, KIND_B, KIND_C", 1),
        "classes for a third": ("bindings/any/src/deep/a.ts", repeated, 1),
        "lines that are listed": ("bindings/common/a.i", "X(dsw_a, A)\n" * BOUND, 0),
        "too many": ("bindings/common/a.i", "X(dsw_a, A)\n" * (BOUND + 1), 1),
        "too many elsewhere": ("bindings/any/typemaps.i", "%ignore dsw_a::b;\n" * (BOUND + 1), 1),
    }
    for case, (name, text, wanted) in cases.items():
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, content in (("include/dartsweep/base.h", header), (name, text)):
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(content)
            wrong = problems(root, counted(root))
            if len(wrong) != wanted:
                sys.exit(f"{case}: {wrong}")


def main() -> None:
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = pathlib.Path(sys.argv[1])
    found = counted(root)
    if "-v" in sys.argv:
        print("\n".join(f"{number:5} {name}" for name, number in found.items()))
    wrong = problems(root, found)
    if wrong:
        sys.exit("\n".join(wrong))


main()
