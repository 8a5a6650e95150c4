"""Each command of ../README.md names what there is: tests of ctest, options of the oracle, figures of the benchmark, curves, programs.

usage: commands_test.py BUILD    BUILD is the folder of the build in which ctest finds the tests

Exit code 1: a command names nothing; 77: the same, and not all programs of tests are built, so ctest does not know all names.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

PAPER = Path(__file__).resolve().parents[1]
ROOT = PAPER.parents[1]


def rows_of(page):
    """The cells of each row of the first table, without its heading."""
    table = re.search(r"^\| paper \|.*\n\|[-| ]+\|\n((?:\|.*\n)+)", page, re.M).group(1)
    return [[cell.strip().replace(r"\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in table.splitlines()]


def tests_of(build):
    """Names and labels of all tests, by ctest."""
    listed = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True).stdout)
    return {test["name"]: next((p["value"] for p in test["properties"] if p["name"] == "LABELS"), []) for test in listed["tests"]}


def text_of(folder, pattern):
    return "\n".join(path.read_text() for path in sorted((ROOT / folder).glob(pattern)))


def faults_of(cells, tests, sources):
    """What is wrong with the command of a row; nothing if the paper's section is empty of statements."""
    name, command = cells[0], cells[-1]
    said = re.findall(r"`([^`]+)`", command)
    if not said and command != "the same" and any(cells[1:]):
        yield f"{name}: no command"
    for each in said:
        words = each.replace('"', "").split()
        if words[0] == "ctest":
            chosen = re.compile(words[2])
            is_there = any(chosen.search(test) if words[1] == "-R" else any(map(chosen.search, tests[test])) for test in tests)
        elif words[0] == "oracle":
            is_there = f'"{words[1]}"' in sources["oracle"]
        elif words[0] == "examples/paper.sh":
            is_there = re.search(rf"\b{words[1]}\b", sources["paper"]) is not None
        elif words[0] in ("bench", "cmake", "examples/report.sh"):
            is_there = True
        elif "." in each:  # a figure of the benchmark, named by its last part
            last = each.rstrip(".*").rsplit(".", 1)[-1]
            is_there = re.search(rf"\b{last}\b", sources["benchmark"]) is not None
        else:
            is_there = f'"{each}"' in sources["curves"]
        if not is_there:
            yield f"{name}: `{each}` names nothing"


def main(build):
    sources = {"oracle": text_of("tests/oracle", "*.cpp"), "benchmark": text_of("tests/benchmark", "*.cpp"),
               "paper": text_of("examples", "paper.sh"), "curves": text_of("examples/report", "catalogue.py")}
    rows, tests = rows_of((PAPER / "README.md").read_text()), tests_of(build)
    faults = [fault for cells in rows for fault in faults_of(cells, tests, sources)]
    made = [fault for cells in (["3.1", "x", "y", "`ctest -R capi.nothing`"], ["4", "x", "y", ""], ["5", "x", "y", "`oracle --nothing 5`"],
                                ["6", "x", "y", "`bench`: `edges.no_such_figure`"]) for fault in faults_of(cells, tests, sources)]
    print("\n".join(faults) or f"{len(rows)} rows: each command names what there is")
    if len(made) != 4 or len(rows) < 30:
        return 1
    return 0 if not faults else 77 if any(name.endswith("_NOT_BUILT") for name in tests) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
