"""What the C headers say, read once for all languages: enumerators, flags, statuses, structs with their members, layouts and comments, and
methods of the C++ interface. The declare.py of each language writes its files from it. As a program it writes what SWIG needs to know
for all of them: headers.py ROOT OUT/lists.i"""

from __future__ import annotations

import pathlib
import re
import sys
from dataclasses import dataclass
from typing import Callable

MADE = "Made by declare.py of the headers of the C interface."
NUMBERS = {"double": 8, "uint8_t": 1, "int32_t": 4, "uint32_t": 4, "uint64_t": 8, "bool": 1, "char": 1}  # sizes; size_t is Machine.word


def camel(name: str) -> str:
    """"edge_parameter" -> "EdgeParameter"."""
    return "".join(part.capitalize() for part in name.split("_"))


def lower_camel(name: str) -> str:
    """"edge_parameter" -> "edgeParameter"."""
    made = camel(name)
    return made[:1].lower() + made[1:]


@dataclass
class Item:
    """An enumerator."""

    name: str  # in C, without DSW_
    short: str  # without what all items of the enum begin with
    value: int
    comment: str


@dataclass
class Enum:
    c_name: str  # empty for flags without a type
    name: str
    comment: str
    paragraphs: str  # the comment with its lines and lists
    items: list[Item]


@dataclass
class Status:
    name: str  # in C, without DSW_STATUS_
    class_name: str
    comment: str


@dataclass
class Member:
    name: str  # in C
    type: str  # in C, without std:: and const
    dims: list[int]
    offset: int
    comment: str


@dataclass
class Struct:
    c_name: str
    name: str
    kind: str  # ID, RECORD, DESCRIPTION, or RESULT
    comment: str
    size: int
    members: list[Member]


@dataclass
class Parameter:
    type: str  # without std::
    name: str
    default: str  # or empty

    @property
    def is_filled(self) -> bool:
        """Whether the call writes it."""
        return self.type == "PointsOut" or bool(re.fullmatch(r"View<(?!const ).*>", self.type))

    @property
    def is_start(self) -> bool:
        """Whether it only says where to look first."""
        return self.type == "View<const dsw_volume_id>" and self.name in ("hints", "starts")

    @property
    def is_options(self) -> bool:
        return self.type.startswith("const dsw_") and self.type.endswith("*")

    @property
    def element(self) -> str:
        """The type of an array's entries, without const."""
        return re.sub(r"^View<(?:const )?(.*)>$", r"\1", self.type)


@dataclass
class Method:
    owner: str  # Environment, Scene, Body or Trace
    name: str
    result: str
    parameters: list[Parameter]
    functions: list[str]  # of C that it calls

    @property
    def answer(self) -> Parameter | None:
        """What the call fills, an entry for each entry of its first argument, where that is all it gives."""
        needed = [each for each in self.parameters if each.is_filled and not each.default]
        first = self.parameters[0] if self.parameters else None
        is_array = first is not None and (first.type == "Points" or first.type.startswith("View<const "))
        # An array of numbers is filled in where the caller has it.
        is_answer = self.result == "void" and is_array and len(needed) == 1 and needed[0].type != "View<double>"
        return needed[0] if is_answer else None


def tidy(comment: str) -> str:
    return re.sub(r"\s+", " ", re.sub(r"^\s*\*(?!/)", "", re.sub(r"^/\*\*<?|\*/$|^//", "", comment), flags=re.M)).strip()


def in_lines(comment: str) -> str:
    """A comment as it stands in the header, with an empty line before a list."""
    text = re.sub(r"^ ?\* {0,2}", "", comment.strip(), flags=re.M)
    return re.sub(r"^((?!- |  ).*)\n(?=- )", r"\1\n\n", text, flags=re.M)


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


class Headers:
    """The interface, read from the project's root."""

    def __init__(self, root: pathlib.Path) -> None:
        include = root / "include/dartsweep"
        self.text = "\n".join(path.read_text() for path in sorted(include.glob("*.h")))
        elements = (root / "bindings/common/elements.i").read_text()
        self._prefixes = dict(re.findall(r"^X\((\w+_), (\w+)\)", elements, re.M))
        ignored = set(re.findall(r"^%ignore (dsw_\w+);", (root / "bindings/common/structs.i").read_text(), re.M))
        arrays, results, errors = ((include / "cpp" / name).read_text() for name in ("arrays.hpp", "results.hpp", "error.hpp"))
        self.methods = "\n".join(path.read_text() for path in sorted((include / "cpp").glob("*.hpp")))
        self.functions = re.findall(r"^DSW_API\b[^;(]*?(\w+)\([^;]*\);", re.sub(r"/\*.*?\*/", "", self.text, flags=re.S), re.M)
        self._kinds: dict[str, str] = {}  # of types that hosts see
        for keyword, c_name in re.findall(r"^typedef (struct|enum) (\w+) \{", self.text, re.M):
            if c_name not in ignored:
                self._kinds[c_name] = "ENUM" if keyword == "enum" else self._kind_of(c_name)
        self._kinds["dartsweep::Vec3"] = "RESULT"
        self._enum_names = self.listed("ENUM")
        self.enums: list[Enum] = []
        self.flags: list[Enum] = []
        self.constants: list[Item] = []  # enumerators of enums without a type, and macros
        self._read_enums()
        self.statuses = self._read_statuses(errors)
        self._bodies = dict(re.findall(r"typedef struct (\w+) \{(.*?)\n\} \w+;", self.text, re.S))
        self._results = dict(re.findall(r"struct (\w+) \{(.*?)\n\};", results, re.S))
        self._bodies |= {"dartsweep::" + name: body for name, body in re.findall(r"struct (\w+) \{(.*?)\n\};", arrays, re.S)}

    def _kind_of(self, c_name: str) -> str:
        """ID; DESCRIPTION, which has defaults; RECORD, which comes in arrays; or RESULT."""
        if c_name.endswith("_id"):
            return "ID"
        if c_name + "_init" in self.functions:
            return "DESCRIPTION"
        return "RECORD" if re.search(rf"\b(?:Array|View)<(?:const )?{c_name}>", self.methods) else "RESULT"

    def listed(self, what: str) -> dict[str, str]:
        """Types of a kind: C's name -> the hosts'. The lists of a Change are methods of it; ChangeNumbers are the rest."""
        names = {"dsw_change": "ChangeNumbers", "dartsweep::Vec3": "Vec3"}
        return {c_name: names.get(c_name) or camel(c_name.removeprefix("dsw_")) for c_name, kind in self._kinds.items() if kind == what}

    def comment_of(self, c_name: str) -> str:
        """The comment of a type."""
        found = re.search(rf"/\*\*((?:(?!\*/).)*)\*/\s*typedef (?:struct|enum) {c_name} ", self.text, re.S)
        return tidy(found[0][: found[0].index("*/") + 2]) if found else ""

    def _read_enums(self) -> None:
        text = re.sub(r"(\w) \{ (DSW.*?) \}", r"\1 {\n\2\n}", self.text)
        prefixes = self._prefixes
        for comment, c_name, body in re.findall(r"/\*\*((?:(?!\*/).)*)\*/\s*(?:typedef )?enum (\w*) ?\{(.*?)\n?\}", text, re.S):
            items = []
            for declaration, words in pieces(body):
                parts = re.fullmatch(r"DSW_(\w+) = (\w+),?", declaration)
                assert parts, declaration
                if not parts[1].endswith("FORCE_INT32"):
                    items.append(Item(parts[1], parts[1], int(parts[2], 0), words))
            flags = next((prefix for prefix in prefixes if all(item.name.startswith(prefix) for item in items)), None)
            is_flags = flags is not None and (not c_name or self._enum_names.get(c_name) == prefixes[flags])
            if c_name in self._enum_names:
                shared = items[0].name
                for item in items:
                    while not item.name.startswith(shared):
                        shared = shared[:-1]
                made = self._shortened(c_name, self._enum_names[c_name], comment, items, shared[: shared.rindex("_") + 1])
                self.enums.append(made)
            elif not c_name:
                self.constants += items
            if is_flags and flags is not None:
                self.flags.append(self._shortened(c_name, prefixes[flags], comment, items, flags))
        order = list(self._enum_names)
        self.enums.sort(key=lambda enum: order.index(enum.c_name))
        self.constants += [Item(name, name, int(value), "") for name, value in re.findall(r"#define DSW_(VERSION_\w+) (\d+)", self.text)]
        unknown = set(prefixes.values()) - {enum.name for enum in self.flags}
        assert not unknown, f"elements.i lists {unknown}, which no header has"
        assert len(self.enums) == len(order), "an enum has no comment"

    @staticmethod
    def _shortened(c_name: str, name: str, comment: str, items: list[Item], prefix: str) -> Enum:
        short = [Item(item.name, item.name[len(prefix) :], item.value, item.comment) for item in items]
        return Enum(c_name, name, tidy(f"/**{comment}*/"), in_lines(comment), short)

    def enum(self, name: str) -> Enum:
        return next(enum for enum in self.enums if enum.name == name)

    def is_enum(self, c_type: str) -> bool:
        return c_type in self._enum_names

    def enum_of(self, c_type: str) -> Enum:
        return self.enum(self._enum_names[c_type])

    def _read_statuses(self, errors: str) -> list[Status]:
        named = dict(re.findall(r"  X\((\w+), (\w+)\)", errors))
        items = [item for item in self.enum("Status").items if item.short != "OK"]
        assert list(named) == [item.short for item in items], "error.hpp does not list the statuses of base.h"
        return [Status(item.short, named[item.short], item.comment) for item in items]

    def is_hidden(self, struct: Struct, member: Member) -> bool:
        """Whether hosts don't see a member: arrays are arguments of methods, or methods of a change."""
        if member.name in ("struct_size", "reserved"):
            return True
        of_array = member.type.endswith("*") or member.type == "size_t" and member.name.endswith("_count")
        of_array = of_array or member.name.endswith("stride_bytes") or member.name in ("index_bytes", "rows", "columns")
        return of_array and (struct.kind == "DESCRIPTION" or struct.c_name == "dsw_change")

    def shown(self, struct: Struct) -> list[Member]:
        return [member for member in struct.members if not self.is_hidden(struct, member)]

    def methods_of(self, owner: str) -> list[Method]:
        """The methods of a class of the C++ interface."""
        text = re.sub(r"^#ifndef SWIG\n.*?^#endif\n", "", self.methods, flags=re.S | re.M)
        body = re.search(rf"^class {owner} \{{\n public:\n(.*?)(?:^ private:|^\}};)", text, re.S | re.M)
        assert body, owner
        made = []
        found = list(re.finditer(r"^  (?:static |explicit )?(?:([\w:]+(?:<[\w:]+>)?[ *&]+))?(\w+)\(((?:[^{};]|\{\})*?)\)\s*(?:const )?"
                                 r"(?::[^{};]*(?:\([^()]*\)[^{};]*)*)?\{", body[1], re.M))
        for this, after in zip(found, [*found[1:], None]):
            names = re.findall(r"\bdsw_\w+", body[1][this.end() : after.start() if after else len(body[1])])
            functions = [name for name in names if name in self.functions]
            parameters = []
            for each in re.split(r",\s*(?![^<(]*[>)])", this[3]) if this[3].strip() else []:
                parts = re.fullmatch(r"(.*?[ *&])(\w+)(?: = (.*))?", " ".join(each.split()))
                assert parts, each
                parameters.append(Parameter(parts[1].strip().replace("std::", ""), parts[2], parts[3] or ""))
            made.append(Method(owner, this[2], (this[1] or "").strip(), parameters, functions))
        return made

    def function_comment(self, name: str) -> str:
        """The comment of a function of C."""
        found = re.search(rf"/\*\*((?:(?!\*/).)*)\*/\s*DSW_API [^;(]*?\b{name}\(", self.text, re.S)
        return tidy(f"/**{found[1]}*/") if found else ""

    def cost(self, function: str) -> str:
        """What the comment of a function says of its cost; where it says nothing, it is O(1)."""
        found = re.search(r"Cost: ([^@]*?)(?= Thread|@|$)", self.function_comment(function))
        return found[1] if found else "O(1)"

    def sentence(self, method: Method) -> str:
        """What a method does: the first sentence of its function's comment."""
        return re.split(r"(?<=\.) (?=[A-Z@`])", self.function_comment(method.functions[0]))[0]

    def fillers(self, owner: str) -> list[tuple[Method, Parameter]]:
        """Methods with an answer, and that."""
        return [(method, method.answer) for method in self.methods_of(owner) if method.answer]

    def translated(self, text: str, type_name: Callable[[str], str], item: Callable[[Enum, Item], str], method: Callable[[str, str], str]) -> str:
        """A comment with a host's names for types, enumerators and methods of C. Names that hosts don't have stay."""
        types = {c_name: name for kind in ("ID", "RECORD", "DESCRIPTION", "RESULT", "ENUM") for c_name, name in self.listed(kind).items()}
        types["dsw_change"] = "Change"  # which derives from its numbers
        text = re.sub(r"\bdsw_\w+\b(?!\()", lambda found: type_name(types[found[0]]) if found[0] in types else found[0], text)
        items = {"DSW_" + i.name: item(enum, i) for enum in [*self.flags, *self.enums] for i in enum.items}
        text = re.sub(r"\bDSW_\w+\b", lambda found: items.get(found[0], found[0]), text)

        def named(found: re.Match[str]) -> str:
            known = re.search(rf"\b{found[2]}\(", self.methods)
            return method(found[1].capitalize(), found[2]) if known else found[0]

        return re.sub(r"\bdsw_(environment|scene|body)_(\w+)\b", named, text)


class Machine:
    """All structs as a machine lays them out whose pointers have `word` bytes."""

    def __init__(self, headers: Headers, word: int = 8) -> None:
        self.headers = headers
        self.word = word
        self.structs: dict[str, Struct] = {}
        bodies, results = headers._bodies, headers._results
        wanted = {c_name: (name, kind) for kind in ("ID", "RECORD", "DESCRIPTION", "RESULT") for c_name, name in headers.listed(kind).items()}
        while len(self.structs) < len(wanted):  # members before what has them
            for c_name, (name, kind) in wanted.items():
                nested = {used for used in re.findall(r"dsw_\w+", re.sub(r"/\*.*?\*/", "", bodies[c_name], flags=re.S)) if used in wanted}
                if c_name not in self.structs and nested <= self.structs.keys():
                    self._add(c_name, name, kind, bodies[c_name])
        self.listed = [self.structs[c_name] for c_name in wanted]  # ids first
        for name, body in results.items():
            self._add("dartsweep::" + name, name, "RESULT", body)
            self.listed.append(self.structs["dartsweep::" + name])

    def of_kind(self, *kinds: str) -> list[Struct]:
        return [struct for struct in self.listed if struct.kind in kinds]

    def number(self, c_type: str) -> str:
        """The type of a number without names that depend on the machine."""
        if self.headers.is_enum(c_type):
            return "int32_t"
        return {4: "uint32_t", 8: "uint64_t"}[self.word] if c_type == "size_t" else c_type

    def layout(self, c_type: str) -> tuple[int, int]:
        """Size and alignment."""
        if c_type in self.structs:
            struct = self.structs[c_type]
            return struct.size, max(self.layout(member.type)[1] for member in struct.members)
        size = self.word if c_type.endswith("*") else NUMBERS[self.number(c_type)]
        return size, size

    def _add(self, c_name: str, name: str, kind: str, body: str) -> None:
        members: list[Member] = []
        at, alignment = 0, 1
        comments: list[str] = []
        declaration = ""
        for text, comment in pieces(body):
            declaration += text
            comments.append(comment)
            if not text.endswith(";"):
                continue
            parts = re.fullmatch(r"(?:const )?([\w:]+ ?\*?) ?(.*);", declaration)
            assert parts, declaration
            c_type = parts[1].replace("std::", "").replace(" ", "")
            c_type = "dartsweep::" + c_type if "dartsweep::" + c_type in self.structs else c_type
            for each in parts[2].split(","):
                found = re.fullmatch(r"\s*(\w+)\s*((?:\[\d+\])*)", each)
                assert found, declaration
                dims = [int(dim) for dim in re.findall(r"\d+", found[2])]
                size, align = self.layout(c_type)
                for dim in dims:
                    size *= dim
                at = -(-at // align) * align
                members.append(Member(found[1], c_type, dims, at, " ".join(filter(None, comments))))
                at += size
                alignment = max(alignment, align)
            comments, declaration = [], ""
        made = Struct(c_name, name, kind, self.headers.comment_of(c_name), -(-at // alignment) * alignment, members)
        self.structs[c_name] = made


def lists_of_change(machine: Machine) -> list[str]:
    return [member.name for member in machine.structs["dsw_change"].members if member.type.endswith("*")]


def lists(headers: Headers) -> str:
    """For SWIG: lists of types, DSW_EACH_ID(X) and so on, of X(C type, name for hosts); and what hosts don't see."""
    machine = Machine(headers)
    lines = ["// Made by headers.py of the headers of the C interface.\n"]

    def define(what: str, rows: list[str]) -> None:
        lines.append(f"%define DSW_EACH_{what}(X)\n" + "".join(f"X({row})\n" for row in rows) + "%enddef\n")

    for what in ("ID", "RECORD", "DESCRIPTION", "RESULT", "ENUM"):
        define(what, [f"{c_name}, {name}" for c_name, name in headers.listed(what).items()])
    for what, count in (("ID_OF_TWO", 2), ("ID_OF_THREE", 3)):
        define(what, [struct.c_name for struct in machine.of_kind("ID") if len(struct.members) == count])
    change = machine.structs["dsw_change"]
    define("CHANGE_NUMBER", [f"{member.type}, {member.name}" for member in headers.shown(change)])
    for struct in [*machine.of_kind("DESCRIPTION"), change]:
        hidden = [member.name for member in struct.members if headers.is_hidden(struct, member)]
        lines += [f"%ignore {struct.c_name}::{name};\n" for name in hidden if name not in ("struct_size", "reserved")]
    return "".join(lines)


def checks_of_layout(headers: Headers, names: list[str]) -> str:
    """C++ that fails to compile where a struct is not laid out as here."""
    wide, narrow = Machine(headers, 8), Machine(headers, 4)
    lines = ["constexpr bool is_narrow = sizeof(void *) == 4;\n"]
    for name in names:
        large, small = wide.structs[name], narrow.structs[name]
        checks = [f"sizeof({name}) == (is_narrow ? {small.size} : {large.size})"]
        checks += [f"offsetof({name}, {member.name}) == (is_narrow ? {other.offset} : {member.offset})"
                   for member, other in zip(large.members, small.members)]
        lines.append("static_assert(" + " && ".join(checks) + ");\n")
    return "".join(lines)


if __name__ == "__main__":
    pathlib.Path(sys.argv[2]).write_text(lists(Headers(pathlib.Path(sys.argv[1]))))
