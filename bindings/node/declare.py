#!/usr/bin/env python3
"""Reads the C headers and writes what JavaScript needs to know of structs, enumerators and statuses: structs.js (layouts), structs.d.ts
(types, with the headers' comments), index.mjs (names for import) and structs.h, in which the compiler checks the layouts.
Usage: declare.py ROOT INDEX.D.TS JAVASCRIPT_FOLDER HEADER_FOLDER"""

import pathlib
import re
import sys
from dataclasses import dataclass

NUMBERS = {  # C type: size, DataView's name of it. size_t has the size of a pointer: Machine.number.
    "double": (8, "Float64"),
    "uint8_t": (1, "Uint8"),
    "int32_t": (4, "Int32"),
    "uint32_t": (4, "Uint32"),
    "uint64_t": (8, "BigUint64"),
    "bool": (1, "Uint8"),
    "char": (1, "Uint8"),  # an array of them is text
}


@dataclass
class Member:
    name: str  # in C
    type: str  # in C, without std::
    dims: list[int]
    offset: int
    comment: str

    @property
    def js(self) -> str:
        first, *rest = self.name.split("_")
        return first + "".join(part.capitalize() for part in rest)


@dataclass
class Struct:
    c_name: str
    name: str
    kind: str  # ID, RECORD, DESCRIPTION or RESULT
    size: int
    members: list[Member]


root, index_types, scripts, includes = map(pathlib.Path, sys.argv[1:])
headers = "\n".join(path.read_text() for path in sorted((root / "include/dartsweep").glob("*.h")))
common = root / "bindings/common"
elements = (common / "elements.i").read_text()
hidden = (common / "structs.i").read_text()


def listed(what: str) -> dict[str, str]:
    block = re.search(rf"%define DSW_EACH_{what}\(X\)(.*?)%enddef", elements, re.S)
    assert block, what
    return dict(re.findall(r"X\(([\w:]+), (\w+)\)", block[1]))


def tidy(comment: str) -> str:
    return re.sub(r"\s+", " ", re.sub(r"^\s*\*(?!/)", "", re.sub(r"^/\*\*<?|\*/$|^//", "", comment), flags=re.M)).strip()


def pieces(body: str) -> list[tuple[str, str]]:
    """Declarations or enumerators with their comments: /** before or /**< (in C++ //) behind."""
    found: list[tuple[str, str]] = []
    before = ""
    for token in re.findall(r"/\*.*?\*/|//[^\n]*|(?:[^/;,{}]|\{[^}]*\})+[;,]?", body, re.S):
        if token.startswith(("/**<", "//")):
            found[-1] = (found[-1][0], tidy(token))
        elif token.startswith("/*"):
            before = tidy(token)
        elif token.strip():
            found.append((" ".join(token.split()), before))
            before = ""
    return found


# --- enumerators
enum_names = listed("ENUM")
enums: dict[str, list[tuple[str, int, str]]] = {}
constants: dict[str, tuple[int, str]] = {}
for c_name, body in re.findall(r"enum (\w*) ?\{(.*?)\n?\}", re.sub(r"(\w) \{ (DSW.*?) \}", r"\1 {\n\2\n}", headers), re.S):
    values = []
    for text, comment in pieces(body):
        item = re.fullmatch(r"DSW_(\w+) = (\w+),?", text)
        assert item, text
        if not item[1].endswith("FORCE_INT32"):
            values.append((item[1], int(item[2], 0), comment))
    if c_name in enum_names:
        shared = values[0][0]
        for name, _, _ in values:
            while not name.startswith(shared):
                shared = shared[:-1]
        prefix = len(shared[: shared.rindex("_") + 1])
        camel = lambda name: "".join(part.capitalize() for part in name.split("_"))
        enums[enum_names[c_name]] = [(camel(name[prefix:]), value, comment) for name, value, comment in values]
    elif not c_name:
        constants |= {name: (value, comment) for name, value, comment in values}
for name, value in re.findall(r"#define DSW_(VERSION_\w+) (\d+)", headers):
    constants[name] = (int(value), "")

# --- structs
bodies = dict(re.findall(r"typedef struct (\w+) \{(.*?)\n\} \w+;", headers, re.S))
results = dict(re.findall(r"struct (\w+) \{(.*?)\n\};", (root / "include/dartsweep/cpp/results.hpp").read_text(), re.S))
values = re.findall(r"struct (\w+) \{(.*?)\n\};", (root / "include/dartsweep/cpp/arrays.hpp").read_text(), re.S)
bodies |= {"dartsweep::" + name: body for name, body in values}

wanted = {c_name: (name, kind) for kind in ("ID", "RECORD", "DESCRIPTION", "RESULT") for c_name, name in listed(kind).items()}


class Machine:
    """All structs as a machine lays them out whose pointers have `word` bytes."""

    def __init__(self, word: int) -> None:
        self.word = word
        self.structs: dict[str, Struct] = {}
        while len(self.structs) < len(wanted):  # members before what has them
            for c_name, (name, kind) in wanted.items():
                nested = {used for used in re.findall(r"dsw_\w+", re.sub(r"/\*.*?\*/", "", bodies[c_name], flags=re.S)) if used in wanted}
                if c_name not in self.structs and nested <= self.structs.keys():
                    self.add(c_name, name, kind, bodies[c_name])
        for name, body in results.items():
            self.add("dartsweep::" + name, name, "RESULT", body)

    def number(self, c_type: str) -> tuple[int, str]:
        """Size, and DataView's name."""
        if c_type == "size_t":
            c_type = {4: "uint32_t", 8: "uint64_t"}[self.word]
        return (4, "Int32") if c_type in enum_names else NUMBERS[c_type]

    def layout(self, c_type: str) -> tuple[int, int]:
        """Size and alignment."""
        if c_type in self.structs:
            struct = self.structs[c_type]
            return struct.size, max(self.layout(member.type)[1] for member in struct.members)
        size = self.word if c_type.endswith("*") else self.number(c_type)[0]
        return size, size

    def add(self, c_name: str, name: str, kind: str, body: str) -> None:
        members: list[Member] = []
        at, alignment = 0, 1
        comments: list[str] = []
        declaration = ""
        for text, comment in pieces(body):
            declaration += text
            comments.append(comment)
            if not text.endswith(";"):
                continue
            c_type, names = re.fullmatch(r"(?:const )?([\w:]+ ?\*?) ?(.*);", declaration).groups()
            c_type = c_type.replace("std::", "").replace(" ", "")
            c_type = "dartsweep::" + c_type if "dartsweep::" + c_type in wanted else c_type
            for each in names.split(","):
                member, dims = re.fullmatch(r"\s*(\w+)\s*((?:\[\d+\])*)", each).groups()
                sizes = [int(dim) for dim in re.findall(r"\d+", dims)]
                size, align = self.layout(c_type)
                for dim in sizes:
                    size *= dim
                at = -(-at // align) * align
                members.append(Member(member, c_type, sizes, at, " ".join(filter(None, comments))))
                at += size
                alignment = max(alignment, align)
            comments, declaration = [], ""
        self.structs[c_name] = Struct(c_name, name, kind, -(-at // alignment) * alignment, members)

    def read(self, c_type: str, dims: list[int], at: int) -> str:
        """JavaScript that reads a member."""
        if c_type == "char":
            return f"textOf(view, at + {at}, {dims[0]})"
        if dims:
            step = self.layout(c_type)[0]
            for dim in dims[1:]:
                step *= dim
            return "[" + ", ".join(self.read(c_type, dims[1:], at + i * step) for i in range(dims[0])) + "]"
        if c_type in self.structs:
            return f"structs.{self.structs[c_type].name}.read(view, at + {at})"
        view = self.number(c_type)[1]
        number = f"view.get{view}(at + {at}, true)"
        return f"Number({number})" if view == "BigUint64" else number + " !== 0" if c_type == "bool" else number

    def describe(self, c_name: str) -> str:
        """The struct as structs.js has it."""
        struct = self.structs[c_name]
        shown = [member for member in struct.members if not is_hidden(struct, member)]
        if struct.kind == "ID":
            reader = f"new {struct.name}(" + ", ".join(self.read(member.type, member.dims, member.offset) for member in shown) + ")"
        elif struct.name == "Vec3":
            reader = "[" + ", ".join(self.read(member.type, [], member.offset) for member in shown) + "]"
        else:
            reader = "({ " + ", ".join(f"{member.js}: {self.read(member.type, member.dims, member.offset)}" for member in shown) + " })"
        fields = []
        for member in shown:
            kind = self.structs[member.type].name if member.type in self.structs else self.number(member.type)[1]
            if member.type != "char":  # of results, which nobody writes
                fields.append(f"['{member.js}', {member.offset}, '{kind}', {member.dims}]")
        return (f"{{\n    name: '{struct.name}',\n    size: {struct.size},\n    fields: [{', '.join(fields)}],\n"
                f"    read: (view, at) => {reader},\n  }}")


lists_of_change = [name for pair in re.findall(r"^DSW_LIST_OF_CHANGE\((\w+), (\w+)\)", hidden, re.M) for name in pair]


def is_hidden(struct: Struct, member: Member) -> bool:
    if struct.c_name == "dsw_change" and member.name in lists_of_change:
        return True
    owners = ["type"] if f"DSW_CELLS_AS_ARGUMENTS({struct.c_name})" in hidden else []
    return member.name in ("struct_size", "reserved") or any(
        f"%ignore {owner}::{member.name};" in hidden for owner in [*owners, struct.c_name])


# --- JavaScript
machine, narrow = Machine(8), Machine(4)
structs = machine.structs


def js_struct(c_name: str) -> str:
    wide, small = machine.describe(c_name), narrow.describe(c_name)
    return f"  {structs[c_name].name}: " + (wide if wide == small else f"wordBytes === 4 ? {small} : {wide}") + ",\n"


def ids() -> list[Struct]:
    return [struct for struct in structs.values() if struct.kind == "ID"]


made = "Made by declare.py of the headers of the C interface."
errors = re.findall(r"  X\((\w+), (\w+)\)", (root / "include/dartsweep/cpp/error.hpp").read_text())
lines = [f"// {made}\n'use strict';\nconst {{ wordBytes }} = require('./addon.js');\nconst {{ IdOfTwo, IdOfThree }} = require('./ids.js');\n\n"]
for struct in ids():
    lines.append(f"class {struct.name} extends IdOf{'Two' if len(struct.members) == 2 else 'Three'} {{}}\n")
lines.append("exports.ids = { " + ", ".join(struct.name for struct in ids()) + " };\n")
lines.append("exports.lists = [" + ", ".join(f"'{s.name}'" for s in structs.values() if s.kind in ("ID", "RECORD")) + "];\n")
lines.append("exports.enums = {\n")
for name, values in enums.items():
    lines.append(f"  {name}: {{ " + ", ".join(f"{item}: {value}" for item, value, _ in values) + " },\n")
lines.append("};\nexports.constants = { " + ", ".join(f"{name}: {value}" for name, (value, _) in constants.items()) + " };\n")
lines.append("exports.statuses = [" + ", ".join(f"['{name}', '{type_name}']" for name, type_name in errors) + "];\n")
lines.append("const textOf = (view, at, size) => new TextDecoder().decode(new Uint8Array(view.buffer, at, size)).split('\\0', 1)[0];\n")
lines.append("const structs = {\n" + "".join(map(js_struct, structs)) + "};\nexports.structs = structs;\n")
(scripts / "structs.js").write_text("".join(lines))


# --- TypeScript
def comment_of(text: str, indent: str = "") -> str:
    return f"{indent}/** {text} */\n" if text else ""


def ts_type(member: Member) -> str:
    base = (structs[member.type].name if member.type in structs else enum_names.get(member.type)
            or {"bool": "boolean", "char": "string"}.get(member.type, "number"))
    if base == "string":
        return base
    if base == "number" and member.dims[-1:] == [3]:
        return "Vec3" if len(member.dims) == 1 else "Vec3[]"
    return base + "[]" * len(member.dims)


def doc_of(c_name: str) -> str:
    found = re.search(rf"/\*\*((?:(?!\*/).)*)\*/\s*typedef (?:struct|enum) {c_name} ", headers, re.S)
    return comment_of(tidy(found[0][: found[0].index("*/") + 2])) if found else ""


lines = [f"// {made} A member's comment is that of the C header.\n\n"]
lines.append("/** A point or a vector: x, y, z. */\nexport type Vec3 = [number, number, number];\n\n")
for c_name, name in enum_names.items():
    lines.append(doc_of(c_name) + f"export enum {name} {{\n")
    lines += [comment_of(comment, "  ") + f"  {item} = {value},\n" for item, value, comment in enums[name]]
    lines.append("}\n\n")
lines += [comment_of(comment) + f"export const {name}: {value};\n" for name, (value, comment) in constants.items()]
for struct in structs.values():
    shown = [member for member in struct.members if not is_hidden(struct, member)]
    optional = "?" if struct.kind == "DESCRIPTION" else ""
    if struct.name == "Vec3":
        continue
    lines.append("\n" + doc_of(struct.c_name))
    if struct.kind == "ID":
        arguments = ", ".join(f"{member.js}: number" for member in shown)
        lines.append(f"export class {struct.name} {{\n  constructor({arguments});\n  private readonly _kind: '{struct.name}';\n")
        lines += [f"  readonly {member.js}: number;\n" for member in shown]
        lines.append("  readonly isNull: boolean;\n  equals(other: unknown): boolean;\n}\n")
    else:
        lines.append(f"export interface {struct.name} {{\n")
        lines += [comment_of(member.comment, "  ") + f"  {member.js}{optional}: {ts_type(member)};\n" for member in shown]
        lines.append("}\n")
    if struct.kind in ("ID", "RECORD"):
        lines.append(f"export class {struct.name}Array extends StructArray<{struct.name}> {{}}\n")
for name, type_name in errors:
    text = next(comment for item, _, comment in enums["Status"] if item.lower() == name.replace("_", "").lower())
    lines.append(comment_of(text) + f"export class {type_name}Error extends DartsweepError {{}}\n")
(scripts / "structs.d.ts").write_text("import { DartsweepError, StructArray } from './index.js';\n" + "".join(lines))

exported = re.findall(r"^export (?:class|function|const|enum) (\w+)", index_types.read_text() + "".join(lines), re.M)
(scripts / "index.mjs").write_text(
    f"// {made}\nimport dartsweep from './index.js';\n\nexport default dartsweep;\nexport const {{\n"
    + "".join(f"  {name},\n" for name in sorted(exported)) + "} = dartsweep;\n")

# --- C++
lines = [f"// {made}\n#pragma once\n\n#include <cstddef>\n\n#include \"common/host.h\"\n\nnamespace dartsweep_node {{\n\n"]
lines.append("// The place of a struct in structs.js.\ntemplate <class T>\nconstexpr int kind_of = -1;\nconstexpr bool is_narrow = sizeof(void *) == 4;\n")
for index, struct in enumerate(structs.values()):
    small = narrow.structs[struct.c_name]
    lines.append(f"template <>\ninline constexpr int kind_of<{struct.c_name}> = {index};\n")
    checks = [f"sizeof({struct.c_name}) == (is_narrow ? {small.size} : {struct.size})"]
    checks += [f"offsetof({struct.c_name}, {member.name}) == (is_narrow ? {other.offset} : {member.offset})"
               for member, other in zip(struct.members, small.members)]
    lines.append("static_assert(" + " && ".join(checks) + ");\n")
lines.append("\n}  // namespace dartsweep_node\n")
(includes / "structs.h").write_text("".join(lines))
