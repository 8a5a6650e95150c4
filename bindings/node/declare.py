#!/usr/bin/env python3
"""Writes what JavaScript needs to know of structs, enumerators and statuses: structs.js (layouts), structs.d.ts (types, with the headers'
comments), index.mjs (names for import) and structs.h, in which the compiler checks the layouts; and fills in what the files of src leave
open: methods that make the array that another one fills. Usage: declare.py ROOT SOURCE_FOLDER JAVASCRIPT_FOLDER HEADER_FOLDER"""

import pathlib
import re
import sys
import textwrap

root, sources, scripts, includes = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(root / "bindings/common"))
from headers import MADE, Headers, Machine, Member, Method, Parameter, Struct, camel, checks_of_layout, lower_camel  # noqa: E402

VIEWS = {"double": "Float64", "uint8_t": "Uint8", "int32_t": "Int32", "uint32_t": "Uint32", "uint64_t": "BigUint64", "bool": "Uint8",
         "char": "Uint8"}  # DataView's name of a number; an array of char is text

headers = Headers(root)
wide, narrow = Machine(headers, 8), Machine(headers, 4)
structs = wide.structs


def ids() -> list[Struct]:
    return [struct for struct in structs.values() if struct.kind == "ID"]


# --- JavaScript
def reader(machine: Machine, c_type: str, dims: list[int], at: int) -> str:
    """JavaScript that reads a member."""
    if c_type == "char":
        return f"textOf(view, at + {at}, {dims[0]})"
    if dims:
        step = machine.layout(c_type)[0]
        for dim in dims[1:]:
            step *= dim
        return "[" + ", ".join(reader(machine, c_type, dims[1:], at + i * step) for i in range(dims[0])) + "]"
    if c_type in structs:
        return f"structs.{structs[c_type].name}.read(view, at + {at})"
    view = VIEWS[machine.number(c_type)]
    number = f"view.get{view}(at + {at}, true)"
    return f"Number({number})" if view == "BigUint64" else number + " !== 0" if c_type == "bool" else number


def description(machine: Machine, c_name: str) -> str:
    """The struct as structs.js has it."""
    struct = machine.structs[c_name]
    shown = headers.shown(struct)
    reads = {member.name: reader(machine, member.type, member.dims, member.offset) for member in shown}
    if struct.kind == "ID":
        read = f"new {struct.name}(" + ", ".join(reads.values()) + ")"
    elif struct.name == "Vec3":
        read = "[" + ", ".join(reads.values()) + "]"
    else:
        read = "({ " + ", ".join(f"{lower_camel(name)}: {text}" for name, text in reads.items()) + " })"
    fields = []
    for member in shown:
        kind = structs[member.type].name if member.type in structs else VIEWS[machine.number(member.type)]
        if member.type != "char":  # of results, which nobody writes
            fields.append(f"['{lower_camel(member.name)}', {member.offset}, '{kind}', {member.dims}]")
    return (f"{{\n    name: '{struct.name}',\n    size: {struct.size},\n    fields: [{', '.join(fields)}],\n"
            f"    read: (view, at) => {read},\n  }}")


def js_struct(c_name: str) -> str:
    large, small = description(wide, c_name), description(narrow, c_name)
    return f"  {structs[c_name].name}: " + (large if large == small else f"wordBytes === 4 ? {small} : {large}") + ",\n"


lines = [f"// {MADE}\n'use strict';\nconst {{ wordBytes }} = require('./addon.js');\nconst {{ IdOfTwo, IdOfThree }} = require('./ids.js');\n\n"]
for struct in ids():
    lines.append(f"class {struct.name} extends IdOf{'Two' if len(struct.members) == 2 else 'Three'} {{}}\n")
lines.append("exports.ids = { " + ", ".join(struct.name for struct in ids()) + " };\n")
lines.append("exports.lists = [" + ", ".join(f"'{s.name}'" for s in structs.values() if s.kind in ("ID", "RECORD")) + "];\n")
lines.append("exports.enums = {\n")
for enum in headers.enums:
    lines.append(f"  {enum.name}: {{ " + ", ".join(f"{camel(item.short)}: {item.value}" for item in enum.items) + " },\n")
lines.append("};\nexports.constants = { " + ", ".join(f"{item.name}: {item.value}" for item in headers.constants) + " };\n")
lines.append("exports.statuses = [" + ", ".join(f"['{status.name}', '{status.class_name}']" for status in headers.statuses) + "];\n")
lines.append("const textOf = (view, at, size) => new TextDecoder().decode(new Uint8Array(view.buffer, at, size)).split('\\0', 1)[0];\n")
lines.append("const structs = {\n" + "".join(map(js_struct, structs)) + "};\nexports.structs = structs;\n")
(scripts / "structs.js").write_text("".join(lines))


# --- TypeScript
def comment_of(text: str, indent: str = "") -> str:
    return f"{indent}/** {text} */\n" if text else ""


def ts_type(member: Member) -> str:
    base = {"bool": "boolean", "char": "string"}.get(member.type, "number")
    if member.type in structs:
        base = structs[member.type].name
    elif headers.is_enum(member.type):
        base = headers.enum_of(member.type).name
    if base == "string":
        return base
    if base == "number" and member.dims[-1:] == [3]:
        return "Vec3" if len(member.dims) == 1 else "Vec3[]"
    return base + "[]" * len(member.dims)


lines = [f"// {MADE} A member's comment is that of the C header.\n\n"]
lines.append("/** A point or a vector: x, y, z. */\nexport type Vec3 = [number, number, number];\n\n")
for enum in headers.enums:
    lines.append(comment_of(enum.comment) + f"export enum {enum.name} {{\n")
    lines += [comment_of(item.comment, "  ") + f"  {camel(item.short)} = {item.value},\n" for item in enum.items]
    lines.append("}\n\n")
lines += [comment_of(item.comment) + f"export const {item.name}: {item.value};\n" for item in headers.constants]
for struct in structs.values():
    shown = headers.shown(struct)
    optional = "?" if struct.kind == "DESCRIPTION" else ""
    if struct.name == "Vec3":
        continue
    lines.append("\n" + comment_of(struct.comment))
    if struct.kind == "ID":
        arguments = ", ".join(f"{lower_camel(member.name)}: number" for member in shown)
        lines.append(f"export class {struct.name} {{\n  constructor({arguments});\n  private readonly _kind: '{struct.name}';\n")
        lines += [f"  readonly {lower_camel(member.name)}: number;\n" for member in shown]
        lines.append("  readonly isNull: boolean;\n  equals(other: unknown): boolean;\n}\n")
    else:
        lines.append(f"export interface {struct.name} {{\n")
        lines += [comment_of(member.comment, "  ") + f"  {lower_camel(member.name)}{optional}: {ts_type(member)};\n" for member in shown]
        lines.append("}\n")
    if struct.kind in ("ID", "RECORD"):
        lines.append(f"export class {struct.name}Array extends StructArray<{struct.name}> {{}}\n")
for status in headers.statuses:
    lines.append(comment_of(status.comment) + f"export class {status.class_name}Error extends DartsweepError {{}}\n")
(scripts / "structs.d.ts").write_text("import { DartsweepError, StructArray } from './index.js';\n" + "".join(lines))

types = "".join(lines)

# --- methods that make the array that another one fills: what is asked, then an object with all that can be left out
BY_HAND = {"locate_points", "get_particle_positions", "move_rigid"}  # two arrays, or by bodies and numbers
DEFAULTS = {"by": "0"}
ARRAYS = {"PointsOut": "Float64Array", "int32_t": "Int32Array", "uint32_t": "Uint32Array"}
NAMES = {c_name: name for kind in ("ID", "RECORD", "DESCRIPTION") for c_name, name in headers.listed(kind).items()}


def fillers(owner: str) -> list[tuple[Method, Parameter]]:
    return [(method, answer) for method, answer in headers.fillers(owner) if method.name not in BY_HAND]


def array_type(parameter: Parameter) -> str:
    return ARRAYS.get(parameter.element) or NAMES[parameter.element] + "Array"


def asked_by(method: Method) -> list[Parameter]:
    return [each for each in method.parameters if not (each.is_filled or each.is_start or each.is_options)]


def named_by(method: Method, answer: Parameter) -> list[Parameter]:
    """What can be left out; points are always made."""
    given = [each for each in method.parameters if each.is_start or each.is_filled]
    return [each for each in given if each.type != "PointsOut" or each is not answer]


def js_filler(method: Method, answer: Parameter) -> str:
    asked = asked_by(method)
    first = asked[0]
    count = f"Math.trunc({first.name}.length / this.dimension())" if first.type == "Points" else f"{first.name}.length"
    if answer.type == "PointsOut":
        count = f"{first.name}.length"
    new = f"new {'' if answer.type == 'PointsOut' else 'arrays.'}{array_type(answer)}({count})"
    arguments = [each.name + (f" = {DEFAULTS[each.name]}" if each.name in DEFAULTS else "") for each in asked]
    named = [each.name + (f" = {new}" if each is answer else "") for each in named_by(method, answer)]
    named += ["...options"] if any(each.is_options for each in method.parameters) else []
    passed = ["options" if each.is_options else f"idsOf({each.name})" if each.element == "dsw_body_id" else each.name for each in method.parameters]
    name, local = lower_camel(method.name), f"    const {answer.name} = {new};\n" if answer.type == "PointsOut" else ""
    return (f"  {name}({', '.join(arguments)}, {{ {', '.join(named)} }} = {{}}) {{\n{local}"
            f"    super.{name}({', '.join(passed)});\n    return {answer.name};\n  }}\n")


def in_words(text: str) -> str:
    """A comment with the names of JavaScript."""
    return headers.translated(text, lambda name: name, lambda enum, item: f"{enum.name}.{camel(item.short)}" if enum.c_name else item.name,
                              lambda owner, name: f"{owner}.{lower_camel(name)}")


def ts_filler(method: Method, answer: Parameter) -> str:
    def given(each: Parameter) -> str:
        if each.type in ("Points", "double"):
            return {"Points": "Points", "double": "number"}[each.type]
        return f"Structs<{NAMES[each.element]}>" + (" | readonly Body[]" if each.element == "dsw_body_id" else "")

    arguments = [f"{each.name}{'?' if each.name in DEFAULTS else ''}: {given(each)}" for each in asked_by(method)]
    named = [f"{each.name}?: {given(each) if each.is_start else array_type(each)}" for each in named_by(method, answer)]
    options = [NAMES[re.sub(r"const (\w+) \*", r"\1", each.type)] for each in method.parameters if each.is_options]
    filled = [f"`{each.name}`" for each in named_by(method, answer) if each.is_filled]
    text = in_words(headers.sentence(method)) + f" {', '.join(filled)} {'is' if len(filled) == 1 else 'are'} filled where given."
    all_named = " & ".join([*options, f"{{ {'; '.join(named)} }}"])
    return (f"{comment_of(text, '  ')}  {lower_camel(method.name)}({', '.join(arguments)}, options?: {all_named}): {array_type(answer)};\n")


# --- types of the methods that index.d.ts does not have by hand: as SWIG makes them
RESULTS = {"void": "void", "bool": "boolean", "double": "number", "size_t": "number", "string": "string", "Point": "Vec3", "Change": "Change",
           "Array<double>": "Float64Array", "Array<uint8_t>": "Uint8Array", "Array<uint32_t>": "Uint32Array", "Array<size_t>": "number[]"}
GIVEN = {"Point": "Point", "Points": "Points", "Indices": "Indices", "double": "number", "bool": "boolean", "Environment": "Environment",
         "View<const uint32_t>": "Numbers", "View<const uint8_t>": "Uint8Array | readonly number[]", "char": "string", "string": "string"}
STRUCTS = {**{struct.c_name.removeprefix("dartsweep::"): struct.name for struct in structs.values()},
           **{enum.c_name: enum.name for enum in headers.enums}}


def type_of(c_type: str, is_result: bool) -> str:
    c_type = re.sub(r"^const (\w+) ?[&*]$", r"\1", c_type.replace("std::", "").replace("dartsweep::", "")).strip()
    array = re.fullmatch(r"(?:Array|View)<(?:const )?(dsw_\w+)>", c_type)
    if array:
        return f"{STRUCTS[array[1]]}Array" if is_result else f"Structs<{STRUCTS[array[1]]}>"
    if re.fullmatch(r"u?int(8|32|64)_t|size_t", c_type):
        return "number"
    return (RESULTS if is_result else GIVEN).get(c_type) or STRUCTS[c_type]


def ts_method(method: Method) -> str:
    arguments = []
    for each in method.parameters:
        is_start = each.type == "dsw_volume_id" and each.name in ("hint", "start")
        optional = is_start or each.default != "" or each.is_options and each is method.parameters[-1]
        name = "options" if each.name == "desc" else lower_camel(each.name)
        arguments.append(f"{name}{'?' * optional}: {type_of(each.type, False)}{' | null' * is_start}")
    comment = comment_of(in_words(headers.sentence(method)), "  ") if method.functions else ""
    return f"{comment}  {lower_camel(method.name)}({', '.join(arguments)}): {type_of(method.result, True)};\n"


def methods(owner: str) -> str:
    """The methods of a class that make arrays, and those that are not there by hand."""
    by_hand = (sources / "index.d.ts").read_text().partition(f"export class {owner} ")[2].partition("\n}\n")[0]
    known = {lower_camel(owner), *re.findall(r"^  (?:static )?(\w+)\(", by_hand, re.M)}
    lines = []
    for method in headers.methods_of(owner):
        if method.answer and method.name not in BY_HAND:
            lines.append(ts_filler(method, method.answer))
        elif lower_camel(method.name) not in known:
            lines.append(ts_method(method))
    return "".join(lines)


def fill(name: str, **made: str) -> str:
    """Writes a file of src with what was made in place of // {key}."""
    text = (sources / name).read_text()
    for key, value in made.items():
        mark = re.compile(rf"^ *// \{{{key.replace('_', ' ')}\}}\n", re.M)
        assert mark.search(text), key
        text = mark.sub(lambda _: value, text)
    (scripts / name).write_text(text)
    return text


for name, owner in (("environment.js", "Environment"), ("scene.js", "Scene")):
    fill(name, fillers="\n".join(js_filler(*each) for each in fillers(owner)))
made = {f"methods_of_{owner}": methods(owner) for owner in ("Environment", "Scene", "Body", "Trace")}
declared = (sources / "index.d.ts").read_text() + "".join(made.values())
used = set(re.findall(r"\w+", re.sub(r"/\*.*?\*/|//[^\n]*", "", declared, flags=re.S)))
names = [name for name in re.findall(r"^export (?:class|interface|type|enum) (\w+)", types, re.M) if name in used]
imports = textwrap.fill(", ".join(sorted(names)) + ",", 120, initial_indent="  ", subsequent_indent="  ")
index_types = fill("index.d.ts", imports=f"import type {{\n{imports}\n}} from './structs.js';\n", **made)

exported = re.findall(r"^export (?:class|function|const|enum) (\w+)", index_types + types, re.M)
(scripts / "index.mjs").write_text(
    f"// {MADE}\nimport dartsweep from './index.js';\n\nexport default dartsweep;\nexport const {{\n"
    + "".join(f"  {name},\n" for name in sorted(exported)) + "} = dartsweep;\n")

# --- C++
lines = [f"// {MADE}\n#pragma once\n\n#include <cstddef>\n\n#include \"common/host.h\"\n\nnamespace dartsweep_node {{\n\n"]
lines.append("// The place of a struct in structs.js.\ntemplate <class T>\nconstexpr int kind_of = -1;\n")
for index, c_name in enumerate(structs):
    lines.append(f"template <>\ninline constexpr int kind_of<{c_name}> = {index};\n")
lines.append(checks_of_layout(headers, list(structs)))
lines.append("\n}  // namespace dartsweep_node\n")
(includes / "structs.h").write_text("".join(lines))
