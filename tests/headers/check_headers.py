#!/usr/bin/env python3
"""Compiles every public header alone, and twice in a row, in the oldest version of each language that a host may use, and the header that
has them all in every version. What a header lacks does not depend on the version, except that newer standard headers include more. So the
oldest version is the strictest.

usage: check_headers.py INCLUDE_DIR C_COMPILER CXX_COMPILER [--whole]
                     --whole: only the headers that have them all, for a second compiler, which finds what the first doesn't warn of
       check_headers.py --self-test C_COMPILER CXX_COMPILER
Exit 0: all compile; 1: the combinations that do not are named; 77: a compiler is missing.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

C_STANDARDS = ["c99", "c11", "c17"]
CXX_STANDARDS = ["c++98", "c++11", "c++14", "c++17", "c++20", "c++2b"]
HPP_STANDARDS = ["c++17", "c++2b"]
OLDEST = [C_STANDARDS[0], CXX_STANDARDS[0]]
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]
C_WARNINGS = ["-Wstrict-prototypes"]


def compile_header(include_dir, header, compiler, language, standard):
    """Returns the compiler's complaint, empty if there is none."""
    line = f'#include "{header}"\n'
    command = [compiler, "-x", language, f"-std={standard}", "-fsyntax-only", f"-I{include_dir}", *WARNINGS]
    if language == "c":
        command += C_WARNINGS
    result = subprocess.run(command + ["-"], input=line + line, text=True, capture_output=True)
    return "" if result.returncode == 0 else result.stderr


def with_all(include_dir, headers, suffix):
    """The header that includes all others of its language, directly or through others."""
    def reached(header, seen):
        if header not in seen and (include_dir / header).exists():
            seen.add(header)
            for name in re.findall(r'^#include "(.*)"', (include_dir / header).read_text(), flags=re.M):
                reached(name, seen)
        return seen

    every = {header for header in headers if header.endswith(suffix)}
    found = [header for header in every if every <= reached(header, set())]
    if every and not found:
        sys.exit(f"no header includes all others that end in {suffix}")
    return found


def standards_of(header, whole):
    if header.endswith(".hpp"):
        return HPP_STANDARDS if header in whole else HPP_STANDARDS[:1]
    return C_STANDARDS + CXX_STANDARDS if header in whole else OLDEST


def failures(include_dir, c_compiler, cxx_compiler, only_whole=False):
    headers = sorted(str(path.relative_to(include_dir)) for path in include_dir.rglob("*.h*"))
    if not headers:
        sys.exit(f"no header found in {include_dir}")
    cases = [(c_compiler, "c", standard) for standard in C_STANDARDS]
    cases += [(cxx_compiler, "c++", standard) for standard in CXX_STANDARDS]
    found, count = [], 0
    whole = with_all(include_dir, headers, ".h") + with_all(include_dir, headers, ".hpp")
    for header in whole if only_whole else headers:
        for compiler, language, standard in cases:
            if standard not in standards_of(header, whole):
                continue
            count += 1
            complaint = compile_header(include_dir, header, compiler, language, standard)
            if complaint:
                found.append((header, compiler, standard, complaint))
    return count, found


def self_test(c_compiler, cxx_compiler):
    """A check that accepts everything is worth nothing: each of these headers must fail somewhere, and only there."""
    bad = {
        "needs_size_t.h": ("size_t dsw_x;\n", len(C_STANDARDS) + len(CXX_STANDARDS)),
        "trailing_comma.h": ("#pragma once\nenum dsw_e { DSW_A = 0, };\n", 1),  # C++98
        "no_guard.h": ("struct dsw_s { int a; };\n", len(C_STANDARDS) + len(CXX_STANDARDS)),
        "cxx_keyword.h": ("#pragma once\nint dsw_f(int class);\n", len(CXX_STANDARDS)),
        "old_prototype.h": ("#pragma once\nint dsw_f();\n", len(C_STANDARDS)),
        "needs_string.hpp": ("#pragma once\nstd::string dsw_f();\n", len(HPP_STANDARDS)),
        "part_alone.h": ("size_t dsw_x;\n", len(OLDEST)),  # all.h has size_t
        "part_of_all.h": ("#pragma once\nint dsw_f(void);\n#if __cplusplus == 201402L\n!\n#endif\n", 1),  # C++14, in all.h
    }
    for name, (text, expected) in bad.items():
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, name).write_text(text)
            if name.startswith("part"):
                pathlib.Path(folder, "all.h").write_text(f'#pragma once\n#include <stddef.h>\n#include "{name}"\n')
            _, found = failures(pathlib.Path(folder), c_compiler, cxx_compiler)
        if len(found) != expected:
            sys.exit(f"{name} should fail in {expected} combinations but fails in "
                     f"{[standard for _, _, standard, _ in found]}")
    print(f"{len(bad)} bad headers are rejected, each where it should be")


def main():
    only_whole = sys.argv[4:] == ["--whole"]
    if len(sys.argv) != 4 + only_whole:
        sys.exit(__doc__)
    include_dir, c_compiler, cxx_compiler = sys.argv[1:4]
    for compiler in (c_compiler, cxx_compiler):
        if shutil.which(compiler) is None:
            print(f"skipped: no {compiler} here")
            sys.exit(77)
    if include_dir == "--self-test":
        self_test(c_compiler, cxx_compiler)
        return
    count, found = failures(pathlib.Path(include_dir), c_compiler, cxx_compiler, only_whole)
    for header, compiler, standard, complaint in found:
        print(f"FAILED: {header} alone with {compiler} -std={standard}\n{complaint}")
    print(f"{count - len(found)} of {count} combinations compile")
    sys.exit(1 if found else 0)


main()
