#!/usr/bin/env python3
"""The checks are tested: what breaks callers is done on purpose, in copies, and each check must refuse what it is there for.

usage: self_test.py checks C++_COMPILER            edits of headers and lists, with a library of empty functions
       self_test.py programs C_COMPILER PROGRAM [ARGUMENT...] [-- PROGRAM [ARGUMENT...]]...   programs run with functions that do something else
"""
import collections
import importlib.util
import itertools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
CHECKS = ["symbols", "needed", "abidiff", "source", "layout", "offsets", "structs", "versions", "calls"]

# An edit is a file, what is found there, and what stands there then. `code` joins the library, `link` its link.
Case = collections.namedtuple("Case", "what caught_by edits code link", defaults=("", ()))


def header(name):
    return f"include/dartsweep/{name}.h"


STRING = (header("base"), r"DSW_API const char \*dsw_status_string\(dsw_status status\);")
REMOVED = (*STRING, "")
RETYPED = (*STRING, "DSW_API const char *dsw_status_string(uint64_t status);")
ADDED = (header("base"), r"\n(DSW_API uint32_t dsw_version)", r"\nDSW_API uint32_t dsw_version_self_test(void);\n\1")
GROWN = [(header("scene"), r"\n} dsw_statistics;", r"\n  uint64_t more;\n} dsw_statistics;"),
         ("abi/layout.c", r"\nGROWS\(dsw_statistics, \w+\);", "\nGROWS(dsw_statistics, more);"),
         ("abi/layout.c", r"SIZE\(dsw_statistics, (\d+)\)",
          lambda size: f"AT(dsw_statistics, more, {size[1]}); SIZE(dsw_statistics, {int(size[1]) + 8})")]
NEW_MAJOR = [("abi/VERSION", r"\ncurrent (\d+)", r"\ncurrent 1\1"), ("abi/dartsweep.map", r"(?s)DARTSWEEP_(\d+).*", r"DARTSWEEP_1\1 { global: dsw_*; local: *; };\n")]
CASES = [
    Case("nothing", "", []),
    # breaks
    Case("a function is removed", "symbols abidiff source", [REMOVED]),
    Case("a parameter gets another type", "abidiff source", [RETYPED]),
    Case("a parameter is added", "abidiff source", [(*STRING, "DSW_API const char *dsw_status_string(dsw_status status, int language);")]),
    Case("a callback gets another parameter", "abidiff source",
         [(header("record"), r"\(\*dsw_write_fn\)\(void \*user,", "(*dsw_write_fn)(void *user, int line,")]),
    Case("members of one type change places", "abidiff source layout offsets",
         [(header("environment"), r"\n  uint32_t volume_index_count;([^;]*) vertex_index_count;",
           r"\n  uint32_t vertex_index_count;\1 volume_index_count;")]),
    Case("members of two types change places", "abidiff source offsets",
         [(header("contact"), r"\n(  dsw_outcome outcome;.*)\n(  uint32_t volumes_visited;.*)", r"\n\2\n\1")]),
    Case("a member is inserted in the middle", "abidiff source layout offsets",
         [(header("contact"), r"\n(  dsw_outcome outcome;)", r"\n  double more;\n\1")]),
    Case("a struct without a size grows", "abidiff source layout offsets",
         [(header("contact"), r"\n} dsw_flight;", r"\n  double more;\n} dsw_flight;")]),
    Case("a struct with a size grows and a member gets another type", "source",
         [*GROWN, (header("scene"), r"uint64_t casts;", "double casts;")]),
    Case("a struct ends in padding", "layout offsets", [(header("scene"), r"\n} dsw_statistics;", r"\n  uint32_t more;\n} dsw_statistics;")]),
    Case("a struct is missing in layout.c", "layout", [("abi/layout.c", r"\nSIZE\(dsw_crossing, 32\);", "")]),
    Case("a function is missing in the test of structs", "structs",
         [("tests/capi/struct_size_test.c", r"  X\(dsw_trace_get_data, dsw_trace_data\)", "")]),
    Case("a function of the last release is no longer called", "calls",
         [("abi/clients/2.0.0/calls/bodies.c", r"TRY\(dsw_body_set_filter\(.*\n", "")]),
    Case("an enumerator gets another value", "abidiff source", [(header("base"), r"DSW_STATUS_OUTSIDE = 19", "DSW_STATUS_OUTSIDE = 119")]),
    Case("an enumerator is removed", "abidiff source", [(header("base"), r"\n  DSW_STATUS_OUTSIDE = 19,", "")]),
    Case("a flag gets another value", "source", [(header("scene"), r"DSW_FEATURE_CROSSINGS = 0x2", "DSW_FEATURE_CROSSINGS = 0x200")]),
    Case("a name without dsw_ is exported", "symbols", [("abi/dartsweep.map", r"dsw_\*;", "dsw_*; leaked;")],
         'extern "C" int leaked() { return 0; }'),
    Case("a C++ name is exported", "symbols", [("abi/dartsweep.map", r"dsw_\*;", "dsw_*; _ZN3dsw*;")], "namespace dsw { int leaked() { return 0; } }"),
    Case("a name that no header declares is exported", "symbols", [], 'extern "C" int dsw_undeclared() { return 0; }'),
    Case("a declared function is not exported", "symbols", [("abi/dartsweep.map", r"dsw_\*;", "dsw_[t-z]*;")]),
    Case("another library is needed", "needed", [], link=("-Wl,--no-as-needed,-l:libstranger.so",)),
    Case("a run path", "needed", [], link=("-Wl,-rpath,/nowhere",)),
    Case("another SONAME", "needed abidiff", [], link=("-Wl,-soname,libdartsweep.so.77",)),
    Case("another version of the symbols", "symbols needed abidiff",
         [("abi/dartsweep.map", r"(?s)DARTSWEEP_\d+ (.*)DARTSWEEP_\d+;", r"DARTSWEEP_77 \1DARTSWEEP_77;")]),
    Case("what is new has the version of the last release", "symbols needed",
         [("abi/dartsweep.map", r"(?s)  local:\n    \*;\n};.*", "    dsw_*;\n  local:\n    *;\n};\n")]),
    Case("a function gets the version of what is new", "symbols abidiff", [("abi/dartsweep.map", r"    dsw_version;\n", "")]),
    Case("the header is of a version that the changelog does not begin with", "versions",
         [(header("base"), r"DSW_VERSION_MINOR (\d+)", r"DSW_VERSION_MINOR 7\1")]),
    Case("a binding is of another version", "versions", [("bindings/java/pom.xml", r"\n  <version>", r"\n  <version>7")]),
    # additions
    Case("a function is added", "", [ADDED]),
    Case("a struct with a size grows", "", GROWN),
    Case("an enumerator is added", "", [(header("base"), r"\n  DSW_STATUS_FORCE", "\n  DSW_STATUS_MORE = 77,\n  DSW_STATUS_FORCE")]),
    Case("what was reserved is put to use", "", [(header("scene"), r"\n  uint32_t reserved;", "\n  uint32_t more;"),
                                                ("abi/layout.c", r"AT\(dsw_statistics, reserved,", "AT(dsw_statistics, more,")]),
    # breaks with another SONAME
    Case("a function is removed, with a new major", "", [REMOVED, *NEW_MAJOR]),
    Case("a parameter gets another type, with a new major", "", [RETYPED, *NEW_MAJOR]),
]

# Programs must notice each of these functions in place of the library's. `real` calls that.
REPLACEMENTS = {
    "dsw_version": ("uint32_t dsw_version(void)", "return 77;"),
    "writes more than struct_size": (
        "dsw_status dsw_environment_get_info(const dsw_environment *environment, dsw_environment_info *info)",
        "dsw_status status = real(environment, info);"
        "if (info != NULL) ((unsigned char *)info)[info->struct_size] = 0; return status;"),
    "refuses the struct_size of the release": (
        "dsw_status dsw_environment_create(dsw_context *context, const dsw_environment_desc *desc, dsw_environment **environment,"
        " dsw_build_report *report)",
        "if (desc != NULL && desc->struct_size <= sizeof *desc) return DSW_STATUS_BAD_STRUCT_SIZE;"
        "return real(context, desc, environment, report);"),
    "refuses what an earlier version has saved": (
        "dsw_status dsw_environment_load(dsw_context *context, const void *block, size_t size_bytes, dsw_environment **environment)",
        "(void)context, (void)block, (void)size_bytes, (void)environment; return DSW_STATUS_BAD_VERSION;"),
    "another default": ("void dsw_move_options_init(dsw_move_options *options, size_t size)",
                        "real(options, size); if (size >= sizeof *options) options->bisection_depth = 21;"),
    "another status for the same mistake": (
        "dsw_status dsw_body_remove_edge(dsw_scene *scene, dsw_body_id body, dsw_body_edge_id edge)",
        "dsw_status status = real(scene, body, edge); return status == DSW_STATUS_STALE_ID ? DSW_STATUS_OUT_OF_RANGE : status;"),
    "another meaning of 0": (
        "dsw_status dsw_environment_cut(dsw_environment *environment, const dsw_cut_desc *desc, dsw_change *change)",
        "dsw_cut_desc known; if (desc == NULL || desc->struct_size != sizeof known || desc->snap != 0) return real(environment, desc, change);"
        "known = *desc; known.snap = 0.02; return real(environment, &known, change);"),
    "memory that is valid for less time": (
        "dsw_status dsw_body_get_edits(const dsw_scene *scene, dsw_body_id body, const dsw_body_edit **edits, size_t *count)",
        "static dsw_body_edit both[2]; static int turn; dsw_status status = real(scene, body, edits, count);"
        "if (status == DSW_STATUS_OK && *count > 0) { turn = !turn; both[turn] = **edits; *edits = &both[turn]; *count = 1; } return status;"),
    "does not look at what it does not know": (
        "dsw_status dsw_scene_create(dsw_environment *environment, const dsw_scene_desc *desc, dsw_scene **scene)",
        "dsw_scene_desc known; if (desc == NULL || desc->struct_size <= sizeof known) return real(environment, desc, scene);"
        "known = *desc; known.struct_size = sizeof known; return real(environment, &known, scene);"),
}


class Copy:
    """What the checks read, in a folder where it can be broken."""

    def __init__(self, folder, compiler):
        self.folder, self.compiler = pathlib.Path(folder), compiler
        shutil.copytree(ROOT / "include", self.folder / "include")
        shutil.copytree(ROOT / "abi", self.folder / "abi", ignore=shutil.ignore_patterns("__pycache__"))
        (self.folder / "tests/capi").mkdir(parents=True)
        shutil.copy(ROOT / "tests/capi/struct_size_test.c", self.folder / "tests/capi")
        for name in ("CHANGELOG.md", "CMakeLists.txt"):
            shutil.copy(ROOT / name, self.folder)
        shutil.copytree(ROOT / "bindings", self.folder / "bindings", ignore=shutil.ignore_patterns("node_modules", "docs"))
        spec = importlib.util.spec_from_file_location("check_abi", self.folder / "abi/check_abi.py")
        self.checks = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.checks)

    def edit(self, path, pattern, replacement):
        text, count = re.subn(pattern, replacement, (self.folder / path).read_text(), count=1)
        if count == 0:
            sys.exit(f"{path} has no {pattern!r}: the test of the checks must follow it")
        (self.folder / path).write_text(text)

    def build(self, case):
        """A library with the functions that the headers declare."""
        if case.link:
            subprocess.run([self.compiler, "-x", "c++", "-", "-shared", "-fPIC", "-Wl,-soname,libstranger.so", "-o", self.folder / "libstranger.so"],
                           input="", text=True, check=True)
        library = self.folder / "libdartsweep.so"
        self.checks.describe(self.compiler, library, case.code, (f"-L{self.folder}", *case.link))
        return library

    def refused_by(self, case):
        for edit in case.edits:
            self.edit(*edit)
        library = self.build(case)
        found = {name: getattr(self.checks, f"check_{name}")() for name in ("source", "layout", "structs", "versions", "calls")}
        found.update((name, getattr(self.checks, f"check_{name}")(library)) for name in ("symbols", "needed"))
        if shutil.which("abidiff"):
            found["abidiff"] = self.checks.abidiff(library)
        offsets = subprocess.run([self.compiler, "-fsyntax-only", "-x", "c++", "-std=c++11", "-Wno-invalid-offsetof",
                                  "-D_Static_assert=static_assert", f"-I{self.folder}/include", self.folder / "abi/layout.c"], capture_output=True)
        found["offsets"] = offsets.returncode != 0
        return {name for name in found if found[name]}, set(found)


def test_checks(compiler):
    problems, used = [], set()
    for case in CASES:
        with tempfile.TemporaryDirectory() as folder, open(os.devnull, "w") as nowhere:
            out, sys.stdout = sys.stdout, nowhere
            try:
                refused, ran = Copy(folder, compiler).refused_by(case)
            finally:
                sys.stdout = out
        wanted = set(case.caught_by.split()) & ran
        used |= refused
        print(f"{case.what}: {', '.join(sorted(refused)) or 'accepted'}")
        if refused != wanted:
            problems.append(f"{case.what} should be refused by {sorted(wanted)}, is refused by {sorted(refused)}")
            if not case.edits and not case.link:
                return problems  # the rest would say the same
    problems += [f"{name} has refused nothing" for name in CHECKS if name in ran - used]
    return problems


def ends_well(program, environment):
    """Whether a program returns 0. One that goes on for a hundred times as long as it takes has lost its memory to the library."""
    try:
        return subprocess.run(program, capture_output=True, env=environment, timeout=10).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def test_programs(compiler, arguments):
    """Each program runs as it is; each notices a replacement, and each replacement is noticed."""
    programs = [list(group) for is_end, group in itertools.groupby(arguments, lambda argument: argument == "--") if not is_end]
    problems, noticed = [], {name: [] for name in REPLACEMENTS}
    with tempfile.TemporaryDirectory() as folder:
        for program in programs:
            if subprocess.run(program, capture_output=True).returncode != 0:
                problems.append(f"{program} fails as it is")
        for name, (declaration, body) in REPLACEMENTS.items():
            function = re.search(r"(\w+)\(", declaration).group(1)
            library = pathlib.Path(folder, "replacement.so")
            source = (f'#include <dlfcn.h>\n#include "dartsweep/dartsweep.h"\n{declaration} {{\n'
                      f'__typeof__(&{function}) real = (__typeof__(&{function}))dlsym(RTLD_NEXT, "{function}"); (void)real;\n{body}\n}}\n')
            subprocess.run([compiler, "-D_GNU_SOURCE", "-x", "c", "-", "-shared", "-fPIC", f"-I{ROOT}/include", "-o", library], input=source,
                           text=True, check=True)
            for program in programs:
                if not ends_well(program, {**os.environ, "LD_PRELOAD": str(library)}):
                    noticed[name].append(pathlib.Path(program[-1]).name)
            print(f"{function}, {name}: noticed by {', '.join(noticed[name]) or 'nobody'}")
    problems += [f"{name}: nobody noticed" for name in noticed if not noticed[name]]
    every = {pathlib.Path(program[-1]).name for program in programs}
    problems += [f"{name} noticed nothing" for name in sorted(every - set(sum(noticed.values(), [])))]
    return problems


def main():
    if len(sys.argv) < 3 or sys.argv[1] not in ("checks", "programs"):
        sys.exit(__doc__)
    problems = test_checks(sys.argv[2]) if sys.argv[1] == "checks" else test_programs(sys.argv[2], sys.argv[3:])
    print("\n".join(problems) if problems else "each check refuses what it is there for, and accepts the rest")
    sys.exit(1 if problems else 0)


main()
