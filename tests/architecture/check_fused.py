#!/usr/bin/env python3
"""Fails if objects of the engine multiply and add with one rounding, but for the files that say so themselves: a
compiler that fuses a * b + c changes signs and bits.

usage: check_fused.py OBJDUMP OBJECT... | --self-test
"""
import pathlib
import re
import subprocess
import sys

# x86-64: vfmadd132sd, vfnmsub231pd, vfmaddsub213ps ...; AArch64: fmadd, fnmsub, fmla, with SVE also fmad, fnmls ...
FUSED = re.compile(r"vfn?m(?:add|sub)\w*|fn?m(?:add|sub|la|ls|ad|sb)\b")
PRODUCT = re.compile(r"v?mul[sp][sd]\b|fmul\b")
# By intrinsics, which no option changes: where a fused product is what is meant.
MEANT = re.compile(r"/certified_hits?_fma\.cpp\.o(bj)?$")


def read(lines):
    """Fused instructions of a disassembly as (file, function, instruction), and the number of products."""
    fused, products, path, function = [], 0, "", ""
    for line in lines:
        if line.startswith(" "):
            if not ("mul" in line or "fm" in line or "fnm" in line):  # most lines, and quicker than an expression
                continue
            match = re.match(r"\s+[0-9a-f]+:\s+(?:\{\w+\}\s+)?(\w+)", line)
            if not match:
                continue
            if FUSED.match(match[1]):
                fused.append((path, function, match[1]))
            elif PRODUCT.match(match[1]):
                products += 1
        elif match := re.match(r"(\S.*):\s+file format ", line):
            path = match[1].replace("\\", "/")
        elif match := re.match(r"[0-9a-f]+ <(.*)>:$", line):
            function = match[1]
    return fused, products


def self_test():
    def text(instruction, path="src/walk/walk_avx512.cpp.o"):
        return f"\n{path}:     file format elf64\n\n0000000000000000 <f>:\n   4:\t{instruction}\n".splitlines()

    fused = ["vfmadd132sd %xmm1,%xmm2,%xmm0", "vfnmsub231pd %zmm1,%zmm2,%zmm0{%k1}", "vfmaddsub213ps %ymm1,%ymm2,%ymm0",
             "fmadd\td0, d0, d1, d2", "fnmsub\td0, d0, d1, d2", "fmla\tv0.2d, v1.2d, v2.2d",
             "fmls\tv0.2d, v1.2d, v2.d[0]"]
    others = ["mulsd  %xmm1,%xmm0", "vmulpd %ymm1,%ymm2,%ymm0", "fmul\td0, d0, d1", "fmov\td0, #1.0",
              "fsub\td0, d0, d1"]
    for instruction in fused:
        if read(text(instruction)) != ([("src/walk/walk_avx512.cpp.o", "f", instruction.split()[0])], 0):
            sys.exit(f"not seen: {instruction}")
    if any(read(text(instruction))[0] for instruction in others):
        sys.exit("seen where nothing is fused")
    if sum(read(text(instruction))[1] for instruction in others) != 3:
        sys.exit("products are not counted")
    if not MEANT.search("x/predicates/certified_hits_fma.cpp.o") or MEANT.search("x/predicates/certified_hit.cpp.o"):
        sys.exit("the files that may are not known")
    print(f"{len(fused) + len(others)} instructions judged as they should be")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    objdump, *objects = sys.argv[1:]
    command = [objdump, "-d", "--no-show-raw-insn", *objects]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        fused, products = read(process.stdout)
    if process.returncode != 0:
        sys.exit(f"{objdump} failed")
    if products < 1000:
        sys.exit(f"only {products} products seen: {objdump} does not read these objects")
    wrong = [found for found in fused if not MEANT.search(found[0])]
    for path, function, instruction in wrong[:20]:
        print(f"{pathlib.PurePath(path).name}: {function}: {instruction}")
    if wrong:
        sys.exit(f"{len(wrong)} fused instructions: is -ffp-contract=off missing?")
    print(f"{products} products, none fused, but for {len(fused)} where it is meant")


main()
