"""Which dials there are, by the headers of the library and of the examples' physics, and the curve of each: dials.py [--list].

A dial is a member of options or of a description that is a number or a choice, each value of a choice, and each flag. dials.csv
names for each of them a curve; or the test that shows that it changes no answer (at most MOST_EXACT of them); or what the member asks for, if it
is a part of the question, such as a body's mask, and not of how well the answer is found. `faults` finds what the table lacks.
"""

import csv
import re
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = Path(__file__).with_name("dials.csv")
LIBRARY = "include/dartsweep"
PHYSICS = ("examples/physics", "examples/physics/rod", "bindings/rod")
MOST_EXACT = 8
# Members that are parts of others: sizes of arrays and of structs.
PARTS = re.compile(r"^(struct_size|reserved|index_bytes|dimension|uniform_cell_type|.*_count|rows|columns|.*stride_bytes|point_room)$")
FLAGS = re.compile(r"^\s*(DSW_(?:BODY|MOVE|CUT|CARVE|NEAR|SWEEP|CAST|PAIRS)_[A-Z_]+) = (?:0x)?[0-9a-f]+[,\s/]", re.MULTILINE)
SCENES = ("CatheterOptions", "RodCatheterOptions", "FoldOptions")  # what a program of the examples simulates
NUMBERS = "double|float|int|uint32_t|uint64_t|int32_t|size_t|bool|std::size_t"


@dataclass(frozen=True)
class Dial:
    name: str
    kind: str  # "curve", "exact" or "question"
    what: str  # name of the curve, of the test, or the question


def _without_comments(text):
    return re.sub(r"//[^\n]*", "", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))


def _of_library(root):
    for path in sorted((root / LIBRARY).glob("*.h")):
        text = path.read_text(encoding="utf-8")
        yield from FLAGS.findall(text)
    texts = {path: _without_comments(path.read_text(encoding="utf-8")) for path in sorted((root / LIBRARY).glob("*.h"))}
    choices = {}
    for text in texts.values():
        for body, name in re.findall(r"typedef enum \w+ \{([^}]*)\} (dsw_\w+);", text):
            choices[name] = [value for value in re.findall(r"(DSW_\w+) =", body) if not value.endswith("FORCE_INT32")]
    for text in texts.values():
        for body, name in re.findall(r"typedef struct \w+ \{([^}]*)\} (dsw_\w+_(?:options|desc));", text):
            for kind, member in re.findall(r"^\s*(?:const )?(\w+) (\w+)(?:\[\d+\])?;", body, re.MULTILINE):
                if kind in choices:
                    yield from (f"{name}.{member}={value}" for value in choices[kind])
                elif re.fullmatch(NUMBERS, kind) and not PARTS.match(member) and member not in ("flags", "features"):
                    yield f"{name}.{member}"


def _of_physics(root):
    for folder in PHYSICS:
        for path in sorted((root / folder).glob("*.h")):
            text = _without_comments(path.read_text(encoding="utf-8"))
            for name, body in re.findall(r"struct (\w+Options) \{(.*?)^\};", text, re.DOTALL | re.MULTILINE):
                if name in SCENES:
                    continue
                for kind, member in re.findall(r"^\s*([\w:]+) (\w+) = [^;]+;", body, re.MULTILINE):
                    if re.fullmatch(NUMBERS, kind) or kind == "Integrator":
                        yield f"{name}.{member}"


def find(root=ROOT):
    """The names of all dials: STRUCT.MEMBER, STRUCT.MEMBER=VALUE, or a flag."""
    return sorted({*_of_library(root), *_of_physics(root)})


def read(table=TABLE):
    """The rows of the table."""
    with open(table, encoding="utf-8", newline="") as file:
        return [Dial(row["dial"], row["kind"], row["what"]) for row in csv.DictReader(file)]


def without_curve(dials, curves, root=ROOT, table=None):
    """Dials that have neither a curve, nor a test, nor a question in the table: `report.dials_without_curve` counts them."""
    named = {dial.name: dial for dial in (read() if table is None else table)}
    tests = _words_of_tests(root) if any(dial.kind == "exact" for dial in named.values()) else set()
    found = {"curve": lambda dial: dial.what in curves, "exact": lambda dial: dial.what in tests, "question": lambda dial: len(dial.what) > 10}
    return [name for name in dials if name not in named or not found.get(named[name].kind, lambda _: False)(named[name])]


def faults(root=ROOT, table=None, curves=None):
    """Sentences on what is wrong with the table; none if all is well."""
    if curves is None:
        import catalogue

        curves = catalogue.CURVES
    rows, dials = read() if table is None else table, find(root)
    said = [f"{name} has no curve, no test and no question" for name in without_curve(dials, curves, root, rows)]
    said += [f"{row.name} is in the table, but in no header" for row in rows if row.name not in dials]
    exact = [row.name for row in rows if row.kind == "exact"]
    if len(exact) > MOST_EXACT:
        said.append(f"{len(exact)} dials are excused by a test, more than {MOST_EXACT}")
    if len({row.name for row in rows}) != len(rows):
        said.append("a dial stands in the table twice")
    return said


def _words_of_tests(root):
    words = set()
    for folder in ("tests", "examples", "bindings"):
        for path in (root / folder).rglob("*"):
            if path.suffix in (".cpp", ".c", ".py") and "test" in str(path):
                words.update(re.findall(r"\w+", path.read_text(encoding="utf-8", errors="replace")))
    return words


def main():
    if sys.argv[1:] == ["--list"]:
        print("\n".join(find()))
        return 0
    said = faults()
    print("\n".join(said) if said else f"{len(find())} dials: each has a curve, a test or a question")
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main())
