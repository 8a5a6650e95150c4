#!/usr/bin/env python3
"""Checks of the binary interface that need no compiler.

usage: check_abi.py symbols LIBRARY        exported names = symbols.txt = names declared in the headers
       check_abi.py needed LIBRARY [NAME]  nothing beyond the C and C++ runtimes, and NAME if the build asked for it,
                                           is needed; SONAME follows VERSION
       check_abi.py layout                 every public struct and member stands in layout.c
       check_abi.py write-symbols LIBRARY  renews symbols.txt (see README.md before you do)
       check_abi.py self-test C_COMPILER   small bad libraries must be refused
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ABI = pathlib.Path(__file__).resolve().parent
HEADERS = ABI.parent / "include" / "dartsweep"
SYMBOLS = ABI / "symbols.txt"
RUNTIMES = re.compile(r"(libc|libm|libgcc_s|libstdc\+\+|libc\+\+|libc\+\+abi|libpthread|ld-linux[\w-]*)\.so(\.\d+)?$")


def run(*command):
    return subprocess.run(command, check=True, text=True, capture_output=True).stdout


def exported(library):
    """Names of dynamic symbols without their version; the version node itself is absolute and left out."""
    rows = [line.split() for line in run("nm", "-D", "--defined-only", library).splitlines()]
    return sorted(row[2].split("@")[0] for row in rows if row[1] != "A")


def header_text():
    text = "".join(path.read_text() for path in sorted(HEADERS.glob("*.h")))
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def declared():
    return sorted(re.findall(r"^DSW_API\b[^;(]*?(\w+)\(", header_text(), flags=re.M))


def check_symbols(library, symbols=SYMBOLS):
    listed = [line for line in symbols.read_text().split("\n") if line and not line.startswith("#")]
    problems = []
    for title, names in (("exported by the library", exported(library)), ("declared in the headers", declared())):
        problems += [f"{name} is in symbols.txt but not {title}" for name in sorted(set(listed) - set(names))]
        problems += [f"{name} is {title} but not in symbols.txt" for name in sorted(set(names) - set(listed))]
    unprefixed = [name for name in exported(library) if not name.startswith("dsw_")]
    problems += [f"{name} does not begin with dsw_" for name in unprefixed]
    if problems:
        problems.append("A name may only be added. To add one: abi/check_abi.py write-symbols LIBRARY, and a line in "
                        "CHANGELOG.md")
    print(f"abi.unprefixed_symbols {len(unprefixed)}")
    return problems


def wanted_soname():
    numbers = dict(re.findall(r"^(current|revision|age) (\d+)$", (ABI / "VERSION").read_text(), flags=re.M))
    return f"libdartsweep.so.{int(numbers['current']) - int(numbers['age'])}"


def check_needed(library, optional=None):
    dynamic = run("readelf", "-d", library)
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic)
    problems = [f"the library needs {name}" for name in needed if not RUNTIMES.match(name) and name.split(".so")[0] != optional]
    wanted = wanted_soname()
    soname = re.findall(r"\(SONAME\).*\[(.*)\]", dynamic)
    if soname != [wanted]:
        problems.append(f"SONAME is {soname}, abi/VERSION says {wanted}")
    if re.search(r"\((RPATH|RUNPATH|TEXTREL)\)", dynamic):
        problems.append("the library carries a run path or text relocations")
    if not problems:
        print(f"needs only {' '.join(needed)}; SONAME {wanted}")
    return problems


def check_layout():
    layout = (ABI / "layout.c").read_text()
    problems = []
    for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", header_text(), flags=re.S):
        if f"SIZE({name}, " not in layout:
            problems.append(f"layout.c: SIZE({name}, ...) is missing")
        for declaration in filter(None, (part.strip() for part in body.split(";"))):
            for member in re.findall(r"(\w+)\s*(?:\[[^\]]*\]\s*)*(?:,|$)", declaration):
                if f"AT({name}, {member}, " not in layout:
                    problems.append(f"layout.c: AT({name}, {member}, ...) is missing")
    for name in re.findall(r"typedef enum (\w+)", header_text()):
        if f"SIZE({name}, 4)" not in layout:
            problems.append(f"layout.c: SIZE({name}, 4) is missing")
    return problems


def write_symbols(library):
    names = exported(library)
    SYMBOLS.write_text("# What the shared library exports, sorted. README.md says how to change it.\n"
                       + "".join(name + "\n" for name in names))
    print(f"{len(names)} names written to {SYMBOLS}")
    return []


def self_test(compiler):
    def build(folder, name, source, *options):
        path = str(pathlib.Path(folder, name))
        subprocess.run([compiler, "-shared", "-fPIC", "-x", "c", "-", "-o", path, "-Wl,--no-as-needed", *options],
                       input=source, text=True, check=True)
        return path

    source = "".join(f"int {name};\n" for name in declared())
    soname = f"-Wl,-soname,{wanted_soname()}"
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        symbols = pathlib.Path(folder, "symbols.txt")
        symbols.write_text("\n".join(declared()))
        good = build(folder, "good.so", source, soname)
        build(folder, "libstranger.so", "int stranger;\n", "-Wl,-soname,libstranger.so")
        expectations = [
            (check_symbols(good, symbols), True, "a good library"),
            (check_symbols(build(folder, "more.so", source + "int leaked;\n"), symbols), False, "a leaked name"),
            (check_symbols(build(folder, "less.so", "int dsw_version;\n"), symbols), False, "lost names"),
            (check_needed(good), True, "a library that needs libc"),
            (check_needed(build(folder, "a.so", source, soname, f"-L{folder}", "-Wl,-l:libstranger.so")), False,
             "a library that needs a stranger"),
            (check_needed(pathlib.Path(folder, "a.so"), "libstranger"), True, "a library that may need it"),
            (check_needed(build(folder, "b.so", source, f"{soname}9")), False, "a wrong SONAME"),
        ]
        for found, sound, what in expectations:
            if bool(found) == sound:
                problems.append(f"{what} was {'refused' if sound else 'accepted'}: {found}")
    return problems


def main():
    commands = {"symbols": check_symbols, "needed": check_needed, "layout": check_layout,
                "write-symbols": write_symbols, "self-test": self_test}
    if len(sys.argv) < 2 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    problems = commands[sys.argv[1]](*sys.argv[2:])
    print("\n".join(problems) if problems else f"{sys.argv[1]}: in order")
    sys.exit(1 if problems else 0)


main()
