#!/usr/bin/env python3
"""Layouts of the public structs on other targets than LP64: they follow from the declarations, whose rules give the frozen numbers of
layout.c for pointers of 8 bytes. clang compares them with what it makes of the headers for WebAssembly (pointers of 4 bytes), Windows and
Linux.

usage: layouts.py [CLANG]    without it only the rules are checked, and the test is skipped
       layouts.py table      prints size and offsets with pointers of 8 and of 4 bytes
"""
import pathlib
import re
import subprocess
import sys

import check_abi

TARGETS = {"wasm32-unknown-unknown": 4, "x86_64-pc-windows-msvc": 8, "aarch64-pc-windows-msvc": 8, "x86_64-unknown-linux-gnu": 8,
           "aarch64-unknown-linux-gnu": 8}
NUMBERS = {"double": 8, "uint64_t": 8, "int64_t": 8, "uint32_t": 4, "int32_t": 4, "int": 4, "uint8_t": 1, "char": 1}


class Layouts:
    """Size, alignment and offsets of each struct: each member lies at the next multiple of its alignment."""

    def __init__(self, pointer_bytes):
        text = check_abi.header_text()
        self.pointer_bytes = pointer_bytes
        self.structs = check_abi.structs(text)
        self.enums = set(re.findall(r"typedef enum (\w+)", text))
        self.callbacks = set(check_abi.callbacks(text))
        self.known = {}

    def of_type(self, name):
        """Size and alignment."""
        name = name.replace("const ", "").strip()
        if "*" in name or name in self.callbacks or name == "size_t":
            return self.pointer_bytes, self.pointer_bytes
        if name in self.structs:
            return self.of_struct(name)[:2]
        size = 4 if name in self.enums else NUMBERS[name]
        return size, size

    def of_struct(self, name):
        """Size, alignment, offsets, and where the last member ends."""
        if name not in self.known:
            end, most, offsets = 0, 1, {}
            for declaration in self.structs[name]:
                kind, member, counts = re.match(r"(.*[ *])(\w+)((?:\[\w+\])*)$", declaration).groups()
                size, alignment = self.of_type(kind)
                end += -end % alignment
                offsets[member] = end
                for count in re.findall(r"\[(\d+)\]", counts):
                    size *= int(count)
                end, most = end + size, max(most, alignment)
            self.known[name] = end + -end % most, most, offsets, end
        return self.known[name]

    def all(self):
        """(struct, member) or (struct, "") and its number."""
        numbers = {}
        for name in self.structs:
            size, _, offsets, _ = self.of_struct(name)
            numbers[name, ""] = size
            numbers.update(((name, member), at) for member, at in offsets.items())
        return numbers

    def padded(self):
        """Structs that grow and end in padding, which older callers leave as it is."""
        growing = check_abi.growing(check_abi.header_text())
        return [name for name in growing if self.of_struct(name)[0] != self.of_struct(name)[3]]


def frozen():
    text = "".join(path.read_text() for path in sorted(check_abi.ABI.glob("layout*.[ch]")))
    numbers = {(name, ""): int(size) for name, size in re.findall(r"\bSIZE\((\w+), (\d+)\)", text)}
    numbers.update(((name, member), int(at)) for name, member, at in re.findall(r"\bAT\((\w+), (\w+), (\d+)\)", text))
    return numbers


def source(layouts, wrong=0):
    lines = ["#include <stddef.h>", '#include "dartsweep/dartsweep.h"',
             f'_Static_assert(sizeof(void *) == {layouts.pointer_bytes} && sizeof(size_t) == {layouts.pointer_bytes}, "pointers");']
    lines += [f'_Static_assert(sizeof({name}) == 4, "{name}");' for name in sorted(layouts.enums)]
    for (name, member), number in layouts.all().items():
        what = f"offsetof({name}, {member})" if member else f"sizeof({name})"
        lines.append(f'_Static_assert({what} == {number + wrong}, "{what} is not {number + wrong}");')
    return "\n".join(lines)


def compiles(clang, target, code):
    done = subprocess.run([clang, f"--target={target}", "-ffreestanding", "-std=c11", "-fsyntax-only", "-ferror-limit=20", "-x", "c",
                           f"-I{check_abi.HEADERS.parent}", "-"], input=code, text=True, capture_output=True)
    return done.returncode == 0, done.stderr


def check_rules():
    """The rules give what layout.c has: of every struct and member."""
    derived = Layouts(8).all()
    numbers = {key: number for key, number in frozen().items() if key in derived}
    problems = [f"{name}.{member}: layout.c has {numbers.get((name, member))}, the declarations give {number}"
                for (name, member), number in derived.items() if numbers.get((name, member)) != number]
    if not problems:
        print(f"the rules give the {len(derived)} numbers of layout.c")
    return problems


def check_targets(clang):
    problems = []
    for target, pointer_bytes in TARGETS.items():
        layouts = Layouts(pointer_bytes)
        fits, errors = compiles(clang, target, source(layouts))
        print(f"{target}: {len(layouts.structs)} structs, {'as derived' if fits else 'OTHERWISE'}")
        if not fits:
            problems.append(errors)
        elif compiles(clang, target, source(layouts, wrong=1))[0]:
            problems.append(f"{target}: wrong numbers are accepted")
    print(f"end in padding with pointers of 4 bytes, which are linked statically: {', '.join(Layouts(4).padded()) or 'none'}")
    return problems


def table():
    wide, narrow = Layouts(8).all(), Layouts(4).all()
    for key in wide:
        print(f"{'.'.join(filter(None, key))} {wide[key]} {narrow[key]}")


def main():
    if sys.argv[1:] == ["table"]:
        return table()
    problems = check_rules()
    if len(sys.argv) > 1 and pathlib.Path(sys.argv[1]).exists():
        problems += check_targets(sys.argv[1])
    elif not problems:
        print("skipped: there is no clang")
    print("\n".join(problems) if problems else "layouts: in order")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
