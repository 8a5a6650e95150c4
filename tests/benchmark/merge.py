#!/usr/bin/env python3
"""Puts the figures of all parts into one flat object: merge.py OUT LIBRARY EDITS PART...

Adds core.needed_libraries: what the dynamic section of LIBRARY names beyond the C and C++ runtimes, and
topology.*: what the tests of random changes say in EDITS, their report as GoogleTest writes it."""
import json
import re
import subprocess
import sys

RUNTIMES = re.compile(r"(libc|libm|libpthread|libdl|librt|libgcc_s|libstdc\+\+|libc\+\+|libc\+\+abi|ld-linux.*)\.so")


def main():
    out, library, edits, parts = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
    figures = {}
    for part in parts:
        with open(part, encoding="utf-8") as file:
            for name, value in json.load(file).items():
                if isinstance(value, bool) or not isinstance(value, (int, float)):
                    raise SystemExit(f"{part}: {name} is not a number")
                if name in figures:
                    raise SystemExit(f"{part}: {name} was reported before")
                figures[name] = value
    with open(edits, encoding="utf-8") as file:
        report = json.load(file)
    tests = [test for suite in report["testsuites"] for test in suite["testsuite"]]
    figures["topology.random_ops"] = sum(int(test.get("changes", 0)) for test in tests)
    figures["topology.violations"] = report["failures"] + report["errors"]
    dynamic = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic)
    figures["core.needed_libraries"] = sum(1 for name in needed if not RUNTIMES.match(name))
    with open(out, "w", encoding="utf-8") as file:
        json.dump(figures, file, indent=1)
        file.write("\n")


main()
