#!/usr/bin/env python3
"""Checks that words of one compiler or one processor stay in src/base/compiler.h. base/fp_mode has words of processors.

usage: check_compiler.py ROOT          judges ROOT/src and ROOT/include
       check_compiler.py --self-test   makes small bad trees and fails unless each is refused
Exit 0: sound; 1: every violation is named.
"""
import pathlib
import re

import judge

HEADER = "src/base/compiler.h"
MODES = {"src/base/fp_mode.h", "src/base/fp_mode.cpp"}  # registers of processors, and nothing else
CODE = {".h", ".inl", ".c", ".cpp"}
WORDS = re.compile(r"__builtin_|__attribute__|__declspec|__forceinline|\[\[(?:gnu|clang|msvc)::|\b__u?int128|#\s*pragma\s+(?:GCC|clang)"
                   r"|\b_Pragma\b|vector_size|__x86_64__|__aarch64__|__wasm|_M_X64|_M_ARM64|__GNUC__|__clang__|_MSC_VER|__MINGW32__")
INTRINSICS = re.compile(r"\b_mm\d*_|\b__m(?:128|256|512|mask)|intrin\.h")
# Files for one instruction set, by name, and what they include.
KERNELS = re.compile(r"src/.*_(?:avx2|avx512|fma)\.cpp|src/walk/(?:lanes|rows|polyhedron|line_walk|shear_lanes)\.inl"
                     r"|src/walk/walk\.h")
# A macro that says nothing where it is not defined: who asks for it must have included it.
SILENT = re.compile(r"^\s*#\s*(?:el)?if\b.*\bDSW_(?:X86_64|GNU|MSVC|NATIVE_INT128)\b", re.MULTILINE)
INCLUDE = '#include "base/compiler.h"'
# How the library's symbols are exported is public.
EXPORTS = "include/dartsweep/base.h"
EXPORT_WORDS = re.compile(r'__declspec\(dll(?:export|import)\)|__attribute__\(\(visibility\("default"\)\)\)|__GNUC__')


def violations(root):
    found = []
    for path in sorted([*(root / "src").rglob("*"), *(root / "include").rglob("*")]):
        name = path.relative_to(root).as_posix()
        if path.suffix not in CODE or name == HEADER or name in MODES:
            continue
        text = path.read_text()
        for number, line in enumerate(text.splitlines(), 1):
            words = EXPORT_WORDS.sub("", line) if name == EXPORTS else line
            match = WORDS.search(words) or (None if KERNELS.fullmatch(name) else INTRINSICS.search(words))
            if match:
                found.append(f"{path}:{number}: {match.group()} belongs into {HEADER}")
        if path.suffix in {".h", ".cpp"} and SILENT.search(text) and INCLUDE not in text:
            found.append(f"{path}: asks for a macro of base/compiler.h, which it does not include")
    return found


# Each tree breaks one rule once; the first ones break none.
TREES = {
    "sound": ({HEADER: "#if defined(__x86_64__)\n#define DSW_HOT __attribute__((always_inline))\n#endif\n",
               "src/walk/shear_avx2.cpp": INCLUDE + "\n#if DSW_X86_64\n__m256d x = _mm256_setzero_pd();\n#endif\n",
               EXPORTS: '#elif defined(__GNUC__)\n#define DSW_API __attribute__((visibility("default")))\n'}, 0),
    "builtin": ({"src/walk/walk.inl": "int i = __builtin_ctz(7);\n"}, 1),
    "attribute": ({"src/walk/cast.cpp": "__attribute__((noinline)) void f();\n"}, 1),
    "standard form": ({"src/walk/cast.cpp": "[[gnu::cold]] void f();\n"}, 1),
    "standard attribute": ({"src/walk/cast.cpp": "[[noreturn]] void f();\n"}, 0),
    "wide integer": ({"src/predicates/exact.cpp": "__int128 x;\n"}, 1),
    "pragma": ({"src/walk/walk.inl": "#pragma GCC unroll 4\n"}, 1),
    "spaced": ({"src/walk/walk.inl": "#  pragma  clang loop unroll(full)\n"}, 1),
    "pragma once": ({"src/walk/walk.h": "#pragma once\n"}, 0),
    "vectors": ({"src/base/points.cpp": "typedef double Two [[x::vector_size(16)]];\n"}, 1),
    "processor": ({"src/walk/walk.h": "#ifdef __x86_64__\n#endif\n"}, 1),
    "compiler": ({"src/walk/walk.h": "#ifdef _MSC_VER\n#endif\n"}, 1),
    "intrinsics": ({"src/walk/cast.cpp": "auto x = _mm_setzero_pd();\n"}, 1),
    "their header": ({"src/walk/cast.cpp": "#include <immintrin.h>\n"}, 1),
    "silent": ({"src/walk/cast.cpp": "#if DSW_X86_64\n#endif\n"}, 1),
    "modes": ({"src/base/fp_mode.h": "#if defined(__aarch64__)\n#endif\n"}, 0),
    "exports elsewhere": ({"include/dartsweep/body.h": '__attribute__((visibility("default"))) void f(void);\n'}, 1),
}

judge.main(__doc__, violations, TREES, HEADER, f"what is not C++ is in {HEADER} alone")
