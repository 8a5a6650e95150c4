#!/usr/bin/env python3
"""Checks of the binary interface, and what renews its lists. README.md says what each proves.

usage: check_abi.py symbols LIBRARY        exported names = names declared in the headers, all of the last release among them
       check_abi.py needed LIBRARY [NAME]  nothing beyond the C and C++ runtimes, and NAME if the build asked for it,
                                           is needed; SONAME and symbol version follow VERSION
       check_abi.py size LIBRARY MOST      without symbols the library has at most so many bytes
       check_abi.py abidiff C++_COMPILER   types and signatures that the headers declare against the last release
       check_abi.py source                 the headers declare what those of the last release do, word for word
       check_abi.py layout                 every public struct and member stands in layout.c
       check_abi.py structs                every struct that grows, and function that takes it, is in struct_size_test.c
       check_abi.py calls                  the hosts of each release call every function that it had
       check_abi.py versions               header, CMake, bindings and the changelog's first section have one version
       check_abi.py refused PROGRAM LIBRARY FOLDER
                                           the loader refuses the library to a program of an older SONAME, which starts
                                           with what is in the folder
       check_abi.py describe C++_COMPILER LIBRARY
                                           makes a library with debug information of what the headers declare
       check_abi.py names                  prints the names declared in the headers, sorted
       check_abi.py too_old C_COMPILER LIBRARY
                                           the loader refuses a library of the last release to a host that names a newer function
       check_abi.py map                    renews dartsweep.map after a release
       check_abi.py next-version RELEASE [break]   renews VERSION and dartsweep.map for a release
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ABI = pathlib.Path(__file__).resolve().parent
HEADERS = ABI.parent / "include" / "dartsweep"
STRUCT_TEST = ABI.parent / "tests" / "capi" / "struct_size_test.c"
RUNTIMES = re.compile(r"(libc|libm|libgcc_s|libstdc\+\+|libc\+\+|libc\+\+abi|libpthread|ld-linux[\w-]*)\.so(\.\d+)?$")

MAP_COMMENT = """/* What the shared library lets out: the C interface. Everything else stays inside, templates of the C++ runtime
   included. Each release has a version of symbols for what it added, so a host that calls a newer function than the library
   has is refused when it is loaded. Written by `check_abi.py map`. */
"""


def run(*command):
    return subprocess.run(command, check=True, text=True, capture_output=True).stdout


# ---- what there is ---------------------------------------------------------------------------------------------------


def releases():
    """Versions with a folder in clients/, oldest first."""
    return sorted((path.name for path in (ABI / "clients").iterdir()), key=lambda name: [int(n) for n in name.split(".")])


def version_numbers():
    return {name: int(number)
            for name, number in re.findall(r"^(current|revision|age) (\d+)$", (ABI / "VERSION").read_text(), flags=re.M)}


def major():
    """The number in the SONAME."""
    return version_numbers()["current"] - version_numbers()["age"]


def baseline(suffix):
    return ABI / "baseline" / (releases()[-1] + suffix)


def headers_of(release):
    return ABI / "clients" / release / "include" / "dartsweep"


def has_new_major():
    """A library with another SONAME is installed beside the old one: nothing that was linked before will load it."""
    with baseline(".abi").open() as text:
        return major() > int(re.search(r"soname='libdartsweep\.so\.(\d+)'", text.readline()).group(1))


def listed(path):
    return [line for line in path.read_text().split("\n") if line and not line.startswith("#")]


def exported(library):
    """Dynamic symbols and their version; the version itself is an absolute symbol and left out."""
    rows = [line.split() for line in run("nm", "-D", "--defined-only", library).splitlines()]
    return dict((row[2].split("@@") + [""])[:2] for row in rows if row[1] != "A")


def interface_of(release):
    """The interface version of a release: current, revision, age."""
    first_line = (ABI / "baseline" / f"{release}.symbols").read_text().split("\n")[0]
    return [int(re.search(rf"{part} (\d+)", first_line).group(1)) for part in ("current", "revision", "age")]


def nodes(before=None):
    """Versions of symbols of this SONAME, oldest first: the names that each has for good. The last one takes what is new."""
    found, known = {}, set()
    for release in releases():
        current, _, age = interface_of(release)
        if release != before and current - age == major():
            names = listed(ABI / "baseline" / f"{release}.symbols")
            found.setdefault(node_of(age), []).extend(name for name in names if name not in known)
            known.update(names)
            last = age
    return {**found, node_of(last + 1 if found else 0): None}


def node_of(age):
    return f"DARTSWEEP_{major()}" + (f".{age}" if age > 0 else "")


def map_text(before=None):
    text, older = MAP_COMMENT, ""
    for node, names in nodes(before).items():
        lines = [f"    {name};\n" for name in names or ["dsw_*"]]
        text += f"{node} {{\n  global:\n{''.join(lines)}" + ("" if older else "  local:\n    *;\n") + f"}}{older};\n"
        older = f" {node}"
    return text


def header_text(folder=HEADERS):
    text = "".join(path.read_text() for path in sorted(folder.glob("*.h")))
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def normal(text):
    """However it is broken into lines, and wherever stars stand."""
    return re.sub(r" \[", "[", re.sub(r"\s*\*\s*", " *", " ".join(text.split())))


def functions(text):
    return {name: normal(f"{before}{name}{after}")
            for before, name, after in re.findall(r"^DSW_API\b([^;(]*?)(\w+)(\([^;]*\));", text, flags=re.M)}


def structs(text):
    """Members of each public struct, one declaration each."""
    found = {}
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, flags=re.S):
        found[name] = []
        for declaration in filter(None, (normal(part) for part in body.split(";"))):
            kind, first = re.match(r"(.*[ *])(\w[^ ]*)$", declaration.split(",")[0]).groups()
            found[name] += [kind + member.strip() for member in [first, *declaration.split(",")[1:]]]
    return found


def member_name(declaration):
    return re.search(r"(\w+)(\[\w+\])*$", declaration).group(1)


def callbacks(text):
    return {name: normal(before + after) for before, name, after in re.findall(r"^typedef ([^;{]*)\(\*(\w+)\)([^;]*);", text, flags=re.M)}


def constants(text):
    """Enumerators and macros; the version is meant to change."""
    return {name: normal(value) for pattern in (r"\b(DSW_\w+)\s*=\s*([^,}]+)", r"^#define (DSW_(?!VERSION_|API)\w+)[ \t]+(.+)$")
            for name, value in re.findall(pattern, text, flags=re.M)}


def growing(text):
    return [name for name, members in structs(text).items() if members[0] == "uint32_t struct_size"]


def describe(compiler, library, code="", link=()):
    """A library with debug information: each function that the headers declare, with an empty body.

    A function of src/capi whose type is not the declared one does not compile, or is another one that is not exported
    (`symbols` finds that). So this library tells as much as one of src/capi, which takes a minute to compile.
    """
    bodies = [f"{text} {{{'' if text.startswith('void dsw') else ' return {}; '}}}" for text in functions(header_text()).values()]
    subprocess.run([compiler, "-x", "c++", "-", "-g", "-shared", "-fPIC", f"-I{HEADERS.parent}", "-o", library,
                    f"-Wl,-soname,libdartsweep.so.{major()}", f"-Wl,--version-script={ABI}/dartsweep.map", *link],
                   input="\n".join(['#include "dartsweep/dartsweep.h"', code, *bodies]), text=True, check=True)
    return []


# ---- checks: each answers a list of problems --------------------------------------------------------------------------


def check_symbols(library):
    versions, declared = exported(library), functions(header_text())
    names = sorted(versions)
    problems = [f"{name} is declared in the headers but not exported by the library" for name in sorted(set(declared) - set(names))]
    problems += [f"{name} is exported by the library but not declared in the headers" for name in sorted(set(names) - set(declared))]
    unprefixed = [name for name in names if not name.startswith("dsw_")]
    print(f"abi.unprefixed_symbols {len(unprefixed)}")
    problems += [f"{name} does not begin with dsw_" for name in unprefixed]
    if not has_new_major():
        problems += [f"{name} has gone since {releases()[-1]}" for name in listed(baseline(".symbols")) if name not in names]
        wanted = {name: node for node, its_names in nodes().items() for name in its_names or []}
        newest = list(nodes())[-1]
        problems += [f"{name} has the version {versions[name]}, not {wanted.get(name, newest)}: `check_abi.py map` renews dartsweep.map"
                     for name in names if name in declared and versions[name] != wanted.get(name, newest)]
    return problems


def check_needed(library, optional=None):
    dynamic = run("readelf", "-d", library)
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic)
    problems = [f"the library needs {name}" for name in needed if not RUNTIMES.match(name) and name.split(".so")[0] != optional]
    wanted = f"libdartsweep.so.{major()}"
    soname = re.findall(r"\(SONAME\).*\[(.*)\]", dynamic)
    if soname != [wanted]:
        problems.append(f"SONAME is {soname}, abi/VERSION says {wanted}")
    found = set(re.findall(r"\bA ([\w.]+)", run("nm", "-D", "--defined-only", library)))
    if found != set(nodes()):
        problems.append(f"symbols have the versions {found}, abi/VERSION and the baselines say {list(nodes())}")
    if re.search(r"\((RPATH|RUNPATH|TEXTREL)\)", dynamic):
        problems.append("the library carries a run path or text relocations")
    if not problems:
        print(f"needs only {' '.join(needed)}; SONAME {wanted}")
    return problems


def check_size(library, most):
    with tempfile.TemporaryDirectory() as folder:
        stripped = pathlib.Path(folder) / "library.so"
        run("strip", "-o", stripped, library)
        size = stripped.stat().st_size
    print(f"{size} bytes without symbols, of {most} at most")
    return [f"the library has {size} bytes without symbols, {size - int(most)} too many"] if size > int(most) else []


def check_abidiff(compiler):
    with tempfile.TemporaryDirectory() as folder:
        describe(compiler, f"{folder}/libdartsweep.so")
        return abidiff(f"{folder}/libdartsweep.so")


def abidiff(library):
    old, new = structs(header_text(headers_of(releases()[-1]))), structs(header_text())
    with tempfile.NamedTemporaryFile("w", suffix=".ini") as allowed:
        # Members at the end are what struct_size is for. abidiff then no longer looks at those before: `source` does.
        for name in growing(header_text()):
            if len(new[name]) > len(old.get(name, new[name])):
                allowed.write(f"[suppress_type]\ntype_kind = struct\nname = {name}\nhas_data_member_inserted_at = end\n"
                              "has_size_change = yes\n")
        allowed.flush()
        result = subprocess.run(["abidiff", "--no-added-syms", "--drop-private-types", "--suppressions", allowed.name,
                                 "--headers-dir2", HEADERS.parent, baseline(".abi"), library], text=True, capture_output=True)
    if result.returncode == 0:
        return []
    found = [result.stdout + result.stderr, f"abidiff answers {result.returncode}: not what {releases()[-1]} was"]
    if result.returncode & 3 == 0 and has_new_major():
        print("\n".join(found) + ", but the number in the SONAME has grown")
        return []
    return found


def check_source():
    return [] if has_new_major() else source_changes(releases()[-1])


def source_changes(release):
    """What the headers of a release declare and today's do not."""
    old, new = header_text(headers_of(release)), header_text()
    problems = []

    def compare(what, before, after):
        problems.extend(f"{what} {name}: was {before[name]}, is {after.get(name, 'gone')}" for name in before
                        if before[name] != after.get(name))

    compare("function", functions(old), functions(new))
    compare("callback", callbacks(old), callbacks(new))
    compare("value", constants(old), constants(new))
    after = structs(new)
    for name, members in structs(old).items():
        now = after.get(name, [])
        if len(now) > len(members) and name not in growing(old):
            problems.append(f"struct {name} does not begin with its size, so it can't grow")
        for k, member in enumerate(members):
            same_kind = k < len(now) and now[k][: -len(member_name(now[k]))] == member[: -len(member_name(member))]
            if k >= len(now) or (now[k] != member and not (same_kind and member_name(member).startswith("reserved"))):
                problems.append(f"struct {name}: was {member}, is {now[k] if k < len(now) else 'gone'}")
    return problems


def check_layout():
    layout = "".join(path.read_text() for path in sorted(ABI.glob("layout*.[ch]")))
    text = header_text()
    wanted = [f"SIZE({name}, 4)" for name in re.findall(r"typedef enum (\w+)", text)]
    growable = set(growing(text))
    for name, members in structs(text).items():
        wanted += [f"SIZE({name}, "] + [f"AT({name}, {member_name(member)}, " for member in members]
        if name in growable:
            wanted.append(f"GROWS({name}, {member_name(members[-1])})")
    return [f"layout.c lacks {text}" for text in wanted if text not in layout]


def check_structs():
    names = "|".join(growing(header_text()))
    declared = {(function, name) for function, text in functions(header_text()).items() for name in re.findall(rf"\b({names}) \*", text)}
    tested = set(re.findall(r"^  X\((\w+), (\w+)\)", STRUCT_TEST.read_text(), flags=re.M))
    return ([f"{STRUCT_TEST.name} lacks X({', '.join(pair)})" for pair in sorted(declared - tested)] +
            [f"{STRUCT_TEST.name} has X({', '.join(pair)}), which no header declares" for pair in sorted(tested - declared)])


def check_calls():
    problems = []
    for folder in sorted((ABI / "clients").glob("*/calls")):
        release = folder.parent.name
        called = set(re.findall(r"\b(dsw_\w+)\s*[(,]", "".join(path.read_text() for path in folder.glob("*.c"))))
        names = listed(ABI / "baseline" / f"{release}.symbols")
        problems += [f"clients/{release}/calls calls no {name}" for name in names if name not in called]
    return problems


def check_versions():
    root = ABI.parent
    version = ".".join(re.findall(r"^#define DSW_VERSION_\w+ (\d+)", (HEADERS / "base.h").read_text(), flags=re.M))
    expected = {"CHANGELOG.md": r"\A(?:(?!## ).*\n)*## \[@\] ", "CMakeLists.txt": r"^project\(Dartsweep VERSION @ ",
                "bindings/python/pyproject.toml": r'^version = "@"', "bindings/java/pom.xml": "^  <version>@<",
                "bindings/csharp/Dartsweep.nuspec": "<version>@<", "bindings/csharp/Dartsweep.csproj": "<Version>@<",
                "bindings/csharp/unity/package.json": '"version": "@"', "bindings/node/package.json": '"version": "@"',
                "bindings/node/package-lock.json": '"name": "dartsweep",\\s+"version": "@"',
                f"bindings/lua/dartsweep-{version}-1.rockspec": '^version = "@-1"'}
    problems = []
    for name, pattern in expected.items():
        pattern = pattern.replace("@", re.escape(version))
        if not (root / name).exists() or not re.search(pattern, (root / name).read_text(), flags=re.M):
            problems.append(f"{name} is not of version {version}, which the header has")
    return problems


def check_refused(program, library, folder):
    """The loader ends a program that finds no library of its name, or one with other symbols under that name."""
    name = re.search(r"\(NEEDED\).*\[(libdartsweep\.so\.\d+)\]", run("readelf", "-d", program))[1]
    node = re.search(r"Name: (DARTSWEEP_\d+)", run("readelf", "-V", program))[1]

    def start(libraries, **settings):
        environment = {"LC_ALL": "C", "LD_LIBRARY_PATH": libraries, "LD_BIND_NOW": "1", **settings}
        return subprocess.run([program], env=environment, text=True, capture_output=True)

    def refused(done, status, message):
        print(done.stderr.strip())
        return done.returncode == status and done.stdout == "" and message in done.stderr

    problems = []
    loaded = start(folder, LD_TRACE_LOADED_OBJECTS="1", LD_WARN="yes")  # tells what is loaded; the program does not run
    text = loaded.stdout + loaded.stderr
    if loaded.returncode != 0 or f"{name} => {folder}/" not in text or re.search("not found|undefined", text):
        problems.append(f"with its own library the program does not start: {text}")
    with tempfile.TemporaryDirectory() as today:
        pathlib.Path(today, f"libdartsweep.so.{major()}").symlink_to(library)
        if not refused(start(today), 127, f"{name}: cannot open shared object file"):
            problems.append(f"the loader should find no {name}")
        pathlib.Path(today, name).symlink_to(library)
        if not refused(start(today), 1, f"version `{node}' not found"):
            problems.append(f"the loader should find no {node} in the library under the name {name}")
    return problems


def check_too_old(compiler, library):
    """A host that names a function newer than the last release starts with today's library, not with one that has the
    names and versions of that release."""
    newest, name = list(nodes())[-1], f"libdartsweep.so.{major()}"
    added = sorted(set(functions(header_text())) - set(listed(baseline(".symbols"))))
    if has_new_major() or not added:
        print(f"nothing is newer than {releases()[-1]}")
        return []
    with tempfile.TemporaryDirectory() as folder:
        def build(code, *arguments):
            subprocess.run([compiler, "-x", "c", "-", *arguments], input=code, text=True, check=True)

        pathlib.Path(folder, "released.map").write_text(map_text().split(f"{newest} {{")[0])
        build("".join(f"int {each}(void) {{ return 0; }}\n" for each in listed(baseline(".symbols"))), "-shared", "-fPIC", "-o", f"{folder}/{name}",
              f"-Wl,-soname,{name}", f"-Wl,--version-script={folder}/released.map")
        host = f"extern int {added[0]}(void);\nint (*volatile named)(void) = {added[0]};\nint main(void) {{ return named == 0; }}\n"
        build(host, "-o", f"{folder}/host", "-x", "none", library)
        today, old = (subprocess.run([f"{folder}/host"], env={"LC_ALL": "C", "LD_LIBRARY_PATH": str(libraries)}, capture_output=True, text=True)
                      for libraries in (pathlib.Path(library).parent, folder))
    print(old.stderr.strip())
    problems = [] if today.returncode == 0 else [f"the host does not start with today's library: {today.stderr}"]
    if old.returncode != 1 or f"version `{newest}' not found" not in old.stderr:
        problems.append(f"the loader should find no {newest} in the library of {releases()[-1]}, and says: {old.stderr or 'nothing'}")
    return problems


# ---- what renews ------------------------------------------------------------------------------------------------------


def print_names():
    print("\n".join(sorted(functions(header_text()))))
    sys.exit()


def next_version(version, kind=None):
    """By the rules in VERSION. A version that is made again counts from the release before it, too."""
    last = [name for name in releases() if name != version]
    if not last:
        current, revision, age = 1, 0, 0
    else:
        current, revision, age = interface_of(last[-1])
        if kind == "break":
            current, revision, age = current + 1, 0, 0
        elif source_changes(last[-1]):
            return source_changes(last[-1])
        elif len({re.sub(r"#define DSW_VERSION_.*", "", header_text(folder)) for folder in (HEADERS, headers_of(last[-1]))}) == 2:
            current, revision, age = current + 1, 0, age + 1
        else:
            revision += 1
    path = ABI / "VERSION"
    head = re.sub(r"^(current|revision|age) \d+\n", "", path.read_text(), flags=re.M)
    path.write_text(f"{head}current {current}\nrevision {revision}\nage {age}\n")
    (ABI / "dartsweep.map").write_text(map_text(before=version))
    print(f"current {current}, revision {revision}, age {age}: libdartsweep.so.{current - age}.{age}.{revision}")
    return []


def write_map():
    (ABI / "dartsweep.map").write_text(map_text())
    return []


COMMANDS = {"symbols": check_symbols, "needed": check_needed, "size": check_size, "abidiff": check_abidiff, "source": check_source,
            "layout": check_layout, "structs": check_structs, "calls": check_calls, "versions": check_versions, "refused": check_refused,
            "too_old": check_too_old, "map": write_map, "describe": describe, "names": print_names, "next-version": next_version}


def main():
    if len(sys.argv) < 2 or sys.argv[1] not in COMMANDS:
        sys.exit(__doc__)
    problems = COMMANDS[sys.argv[1]](*sys.argv[2:])
    print("\n".join(problems) if problems else f"{sys.argv[1]}: in order")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
