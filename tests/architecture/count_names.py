#!/usr/bin/env python3
"""Counts the files that name a function of the C interface, by its own name or by that of its method in any language. Lists that only repeat
names should follow from the headers instead.

usage: count_names.py ROOT [FUNCTION...]    none: those that the last release does not have
"""
import pathlib
import re
import subprocess
import sys

GROUPS = {  # the first that matches
    "tests": r"tests/|.*/(tests?|fuzz)/|.*test\w*\.\w+$",
    "words and examples": r".*\.md$|examples/|.*/examples/",
    "engine": r"src/(?!capi/)",
    "interface": r"include/|src/capi/|abi/|bindings/",
    "rest": "",
}


def pattern_of(function: str) -> str:
    method = re.sub(r"^dsw_(environment|scene|body|trace|particle)_|^dsw_", "", function)
    camel = "".join(part.capitalize() for part in method.split("_"))
    if "_" not in method:  # a word of everyday
        return rf"\b{function}\b"
    return rf"\b({function}|{method}|{camel}|{camel[0].lower()}{camel[1:]})\b"


def main() -> None:
    root = pathlib.Path(sys.argv[1])
    functions = sys.argv[2:]
    if not functions:
        headers = "".join(path.read_text() for path in sorted((root / "include/dartsweep").glob("*.h")))
        released = sorted((root / "abi/baseline").glob("*.symbols"), key=lambda path: [int(n) for n in path.stem.split(".")])[-1]
        old = released.read_text().split()
        functions = [name for name in re.findall(r"^DSW_API\b[^;(]*?(\w+)\(", headers, re.M) if name not in old]
    tracked = subprocess.run(["git", "-C", str(root), "ls-files"], check=True, text=True, capture_output=True).stdout.split("\n")
    texts = {}
    for name in tracked:
        if name and not name.startswith(("abi/baseline/", "abi/clients/")) and (root / name).is_file():
            texts[name] = (root / name).read_text(errors="ignore")
    print(f"{'files':>5} " + " ".join(f"{group:>18}" for group in GROUPS) + "  function")
    for function in functions:
        pattern = re.compile(pattern_of(function))
        named = [name for name, text in texts.items() if pattern.search(text)]
        counts = {group: 0 for group in GROUPS}
        for name in named:
            counts[next(group for group, where in GROUPS.items() if re.match(where, name))] += 1
        print(f"{len(named):5} " + " ".join(f"{count:18}" for count in counts.values()) + f"  {function}")


main()
