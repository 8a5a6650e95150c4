#!/usr/bin/env python3
"""Fails unless flags that change the arithmetic of doubles are refused by base/fp_rules.h or by CMake, and undone by
the options that each target gets.

usage: check_fp_rules.py ROOT CMAKE COMPILER GNU|Clang OPTION...
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BY_MACRO = ["-ffast-math", "-Ofast", "-ffinite-math-only"]
BY_CMAKE = [*BY_MACRO, "-funsafe-math-optimizations", "-fassociative-math", "-freciprocal-math", "-fno-signed-zeros",
            "-fapprox-func", "-fsingle-precision-constant", "-ffp-model=fast", "-fdenormal-fp-math=positive-zero",
            "-fdenormal-fp-math=preserve-sign,preserve-sign", "-mfpmath=387", "-mfpmath=sse+387", "-mdaz-ftz"]
HARMLESS = ["", "-O3 -march=native", "-fno-fast-math", "-ffp-contract=fast", "-mfpmath=sse", "-fdenormal-fp-math=ieee",
            "-DNAME=-ffast-math"]
UNDONE = ["-ffast-math", "-Ofast", "-funsafe-math-optimizations",
          "-fassociative-math -fno-signed-zeros -fno-trapping-math", "-freciprocal-math", "-ffinite-math-only",
          "-fno-signed-zeros", "-ffp-contract=fast"]
# Options of GCC and of clang's first pass when they are on, or have this value. Arithmetic that may trap is only slow.
UNSAFE = {
    "GNU": re.compile(r"-f(?:associative-math|reciprocal-math|finite-math-only|unsafe-math-optimizations)\s+\[enabled\]"
                      r"|-fsigned-zeros\s+\[disabled\]|-ffp-contract=\S*\s+(?:fast|on)"),
    "Clang": re.compile(r'"-(?:ffast-math|menable-unsafe-fp-math|menable-no-infs|menable-no-nans|mreassociate'
                        r'|freciprocal-math|fno-signed-zeros|ffinite-math-only|fapprox-func|ffp-contract=(?:fast|on)'
                        r'|ffp-exception-behavior=strict)"'),
}


def run(command, folder=None):
    result = subprocess.run(command, capture_output=True, text=True, cwd=folder)
    return result.returncode, result.stdout + result.stderr


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    root, cmake, compiler, kind, *options = sys.argv[1:]
    root = pathlib.Path(root)
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "rules.cpp")
        source.write_text('#include "base/fp_rules.h"\n')

        def compile_with(flags):
            return run([compiler, "-std=c++17", f"-I{root / 'src'}", *flags, "-c", str(source), "-o", os.devnull])

        code, text = compile_with([])
        if code != 0:
            sys.exit(f"refused without a reason:\n{text}")
        macros = run([compiler, "-dM", "-E", "-x", "c++", os.devnull])[1]
        by_macro = BY_MACRO + (["-mfpmath=387"] if kind == "GNU" and "__x86_64__" in macros else [])
        for flag in by_macro:
            code, text = compile_with([flag])
            if code == 0 or "Dartsweep" not in text:
                sys.exit(f"{flag} is not refused by base/fp_rules.h:\n{text}")
        code, text = compile_with(["-ffast-math", *options])
        if code != 0:
            sys.exit(f"-ffast-math is not undone by {options}:\n{text}")

        for flags in ["", *UNDONE]:
            ask = ["-Q", "--help=optimizers"] if kind == "GNU" else ["-###"]
            text = run([compiler, "-O3", *flags.split(), *options, "-c", str(source), *ask], folder)[1]
            if "math" not in text:
                sys.exit(f"{compiler} does not tell its options:\n{text}")
            if match := UNSAFE[kind].search(text):
                sys.exit(f"{flags}, then {' '.join(options)}: still {match[0]}")
        # The search above must be able to find something.
        text = run([compiler, "-O3", "-ffast-math", "-c", str(source), *ask], folder)[1]
        if not UNSAFE[kind].search(text):
            sys.exit(f"nothing is found where all is unsafe:\n{text}")

        def configure(flags):
            script = pathlib.Path(folder, "flags.cmake")
            script.write_text(f'include("{(root / "src/cmake/floating_point.cmake").as_posix()}")\n'
                              f'dsw_find_bad_flag(bad "{flags}")\nmessage("bad: ${{bad}}")\n')
            return re.search(r"^bad: (.*)$", run([cmake, "-P", str(script)])[1], re.M)[1]

        for flag in BY_CMAKE:
            if configure(f"-O2 {flag} -g") != flag:
                sys.exit(f"{flag} is not refused by CMake")
        for flags in HARMLESS:
            if bad := configure(flags):
                sys.exit(f"{flags}: CMake refuses {bad}")
    print(f"{len(by_macro)} flags are refused by macros, {len(BY_CMAKE)} by CMake, {len(UNDONE)} are undone")


main()
