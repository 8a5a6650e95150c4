#!/usr/bin/env python3
"""Writes the structs, ids and exceptions of C#: Structs.cs (laid out as C's), Exceptions.cs, and structs.h, in which the compiler checks
the layouts; and Fillers.cs, methods that make the array that another one fills. Usage: declare.py ROOT SOURCE_FOLDER HEADER_FOLDER"""

import pathlib
import re
import sys
import textwrap

root, sources, includes = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(root / "bindings/common"))
from headers import MADE, Headers, Machine, Member, Method, Parameter, Struct, camel, checks_of_layout, lower_camel  # noqa: E402

NUMBERS = {"double": "double", "uint32_t": "uint"}

headers = Headers(root)
machine = Machine(headers)
values = [machine.structs[name] for name in ("dsw_cell", "dsw_contact")]
values += machine.of_kind("ID", "RECORD")  # Vec3 is in Values.cs


def words(text: str, struct: Struct | None = None) -> str:
    """A comment with the names of C#."""
    text = headers.translated(text, lambda name: name, lambda enum, item: f"{enum.name}.{camel(item.short)}" if enum.c_name
                              else f"Library.{item.name}", lambda owner, name: f"{owner}.{camel(name)}")
    for member in struct.members if struct else []:
        text = re.sub(rf"`{member.name}`", f"`{camel(member.name)}`", text)
        if member.dims:
            text = re.sub(rf"\b{member.name}\[(\d)\]", rf"{camel(member.name)}\1", text)
        for item in headers.enum_of(member.type).items if headers.is_enum(member.type) else []:
            text = re.sub(rf"\b{item.short}\b", camel(item.short), text)
    return text.replace("UINT32_MAX", "uint.MaxValue").replace("&", "&amp;").replace("<", "&lt;")


def summary(text: str, indent: str) -> str:
    lines = textwrap.wrap(f"<summary>{text}</summary>", 118 - len(indent), break_long_words=False)
    return "".join(f"{indent}/// {line}\n" for line in lines)


def type_of(member: Member) -> str:
    if member.type in machine.structs:
        return machine.structs[member.type].name
    return headers.enum_of(member.type).name if headers.is_enum(member.type) else NUMBERS[member.type]


def field(member: Member, struct: Struct) -> str:
    """A member; an array becomes members with a number, and three doubles a vector."""
    dims, name, type_name = member.dims, camel(member.name), type_of(member)
    if type_name == "double" and dims[-1:] == [3]:
        dims, type_name = dims[:-1], "Vec3"
    names = ", ".join(f"{name}{i}" for i in range(dims[0])) if dims else name
    if headers.is_hidden(struct, member):
        return f"    internal {type_name} {names};\n"
    told = "" if struct.kind == "ID" else summary(words(member.comment, struct), "    ")
    return f"{told}    public {type_name} {names};\n"


def constructor(struct: Struct) -> str:
    arguments = ", ".join(f"{type_of(member)} {member.name}" for member in struct.members)
    sets = "".join(f"      {camel(member.name)} = {member.name};\n" for member in struct.members)
    return (f"\n    public {struct.name}({arguments})\n    {{\n{sets}    }}\n\n"
            "    public bool IsNull { get { return Generation == 0; } }\n")


def declaration(struct: Struct) -> str:
    body = "".join(field(member, struct) for member in struct.members) + (constructor(struct) if struct.kind == "ID" else "")
    return (summary(words(struct.comment, struct), "  ") + "  [StructLayout(LayoutKind.Sequential)]\n"
            f"  public partial struct {struct.name}\n  {{\n{body}  }}\n")


all_types = ", ".join(f"typeof({name})" for name in ["Vec3", *(struct.name for struct in values)])
(sources / "Structs.cs").write_text(
    f"// {MADE} Structs lie in memory as those of C, so that arrays of them are used by both sides.\n"
    "using System;\nusing System.Runtime.InteropServices;\n\nnamespace Dartsweep\n{\n"
    + "\n".join(map(declaration, values))
    + "\n  internal static class Structs\n  {\n    /// <summary>In the order of dartsweep_size_of.</summary>\n"
    + f"    internal static readonly Type[] All = {{ {all_types} }};\n  }}\n}}\n")

# --- exceptions: that of a closed object is in Errors.cs, and derives from one of these
lines = [f"// {MADE}\nnamespace Dartsweep\n{{\n  internal static partial class Errors\n  {{\n"]
lines.append("    private static DartsweepException OfStatus(Status status, string message)\n    {\n      switch (status)\n      {\n")
for status in headers.statuses:
    lines.append(f"        case Status.{status.class_name}: return new {status.class_name}Exception(message);\n")
lines.append("        default: return new InternalException(message);\n      }\n    }\n  }\n")
for status in headers.statuses:
    name, sealed = f"{status.class_name}Exception", "" if status.name == "NULL_ARGUMENT" else "sealed "
    lines.append(f"\n{summary(words(status.comment), '  ')}  public {sealed}class {name} : DartsweepException\n  {{\n"
                 f"    internal {name}(string message) : base(Status.{status.class_name}, message) {{ }}\n  }}\n")
(sources / "Exceptions.cs").write_text("".join(lines) + "}\n")

# --- results made rather than filled: the arguments that say what is asked, and the answer as an array
LEFT_OUT = {"get_particle_positions", "cast_from_particles", "move_bodies", "move_rigid", "move_together"}  # not so, or by hand in Idioms.cs
ELEMENTS = {element: name for kind in ("ID", "RECORD") for element, name in headers.listed(kind).items()}


def argument_name(name: str) -> str:
    return "fixedEnds" if name == "fixed" else lower_camel(name)


def filler(method: Method, answer: Parameter) -> str:
    asked = [each for each in method.parameters if not (each.is_filled or each.is_start or each.is_options)]
    types = {"Points": "double[]", "double": "double"}
    arguments = ", ".join(f"{types.get(each.type) or ELEMENTS[each.element] + '[]'} {argument_name(each.name)}" for each in asked)
    passed = ", ".join(answer.name if each is answer else argument_name(each.name) if each in asked else "null"
                       for each in method.parameters if not each.default)
    first, element = argument_name(asked[0].name), ELEMENTS.get(answer.element, "double")
    count = f"{first}.Length" + (" / Dimension()" if asked[0].type == "Points" and element != "double" else "")
    return (f"\n{summary(words(headers.sentence(method)), '    ')}    public {element}[] {camel(method.name)}({arguments})\n    {{\n"
            f"      {element}[] {answer.name} = new {element}[{count}];\n      {camel(method.name)}({passed});\n      return {answer.name};\n    }}\n")


lines = [f"// {MADE}\nnamespace Dartsweep\n{{"]
for owner in ("Environment", "Scene"):
    made = "".join(filler(method, answer) for method, answer in headers.fillers(owner) if method.name not in LEFT_OUT)
    lines.append(f"\n  public sealed unsafe partial class {owner}\n  {{{made}  }}\n")
(sources / "Fillers.cs").write_text("".join(lines) + "}\n")

# --- C++
c_names = [struct.c_name for struct in values]
(includes / "structs.h").write_text(
    f"// {MADE}\n#pragma once\n\n#include <cstddef>\n\n#include \"common/host.h\"\n\nnamespace dartsweep_csharp {{\n\n"
    + checks_of_layout(headers, c_names)
    + "\n// In the order of Structs.All.\ninline constexpr std::size_t sizes_of_structs[] = {\n    sizeof(dartsweep::Vec3),\n"
    + "".join(f"    sizeof({name}),\n" for name in c_names) + "};\n\n}  // namespace dartsweep_csharp\n")
