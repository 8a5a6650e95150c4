#!/usr/bin/env python3
"""Writes the modules of Python that follow from the C headers: enums.py, errors.py and dtypes.py, from those of the folder templates, and
_core.pyi, the types of structs; and for SWIG long_calls.i. Usage: declare.py ROOT PACKAGE_FOLDER INTERFACE_FOLDER"""

import pathlib
import re
import sys
import textwrap

root, package, interface = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(root / "bindings/common"))
from headers import MADE, Enum, Headers, Machine, Member, Struct, lists_of_change  # noqa: E402

templates = pathlib.Path(__file__).parent / "templates"
BASES = {  # of exceptions: built-in ones of that meaning
    "UNSUPPORTED": "ValueError",
    "OUT_OF_RANGE": "ValueError",
    "NON_FINITE": "ValueError",
    "WRONG_SIZE": "ValueError",
    "STALE_ID": "LookupError",
    "OUT_OF_MEMORY": "MemoryError",
    "INDEX_OUT_OF_RANGE": "IndexError",
    "NOT_FOUND": "LookupError",
    "NOT_BUILT": "NotImplementedError",
}
LEFT_OUT = {"ENVIRONMENT_BORROW_POINTS", "RECORDING_BUG_REPORT"}  # flags that calls of Python can't have
LONG = {  # calls that follow the size of arrays or meshes, though their functions of C do not, or not always
    "Body::set_level", "Environment::close", "Environment::get_change", "Environment::get_points", "Environment::info", "Scene::Scene",
    "Scene::close", "sweep_pairs", "sweep_rigid_pairs",
}
SHORT = {  # calls that are shorter than it would take to let others run, though not O(1)
    "Body::add_edge", "Body::add_face", "Body::add_vertex", "Body::collapse_edge", "Body::get_edge_ids", "Body::get_edge_indices",
    "Body::get_face_ids", "Body::get_face_indices", "Body::get_untested_edges", "Body::get_vertex_ids", "Body::remove_edge", "Body::remove_face",
    "Body::remove_vertex", "Body::split_edge", "Environment::cast", "Environment::classify", "Environment::copy_vertices", "Environment::cross_check",
    "Environment::get_centre", "Environment::get_edge_id", "Environment::get_volume_counts", "Environment::is_impassable",
    "Environment::is_valid", "Environment::locate", "Scene::create_particle", "Scene::get_body_ids", "Scene::get_particle_ids",
    "Scene::move_particle", "Scene::start_recording", "Scene::write_bug_report", "Trace::add_walk",
}
NUMPY = {"double": "F8", "uint32_t": "U4", "int32_t": "I4"}
NUMBERS = {"double": "float", "bool": "bool", "char": "str"}  # all others are int
ARRAYS = {"double": "np.float64", "uint32_t": "np.uint32"}  # of structs: np.void

headers = Headers(root)
machine = Machine(headers)


def words(text: str) -> str:
    """A comment with the names of Python; functions are those of C."""
    return headers.translated(text, lambda name: name, lambda enum, item: f"{enum.name}.{item.short}",
                              lambda owner, name: f"dsw_{owner.lower()}_{name}")


def docstring(text: str) -> str:
    lines = text.split("\n")
    if len(lines) == 1 and len(text) > 130:
        lines = textwrap.wrap(text, 130)
    return '    """' + "\n    ".join(lines).replace("\n    \n", "\n\n") + ('\n    """\n' if len(lines) > 1 else '"""\n')


def fill(name: str, **made: str) -> None:
    """Writes a module: its template with what was made in place of # {key}."""
    text = (templates / name).read_text()
    for key, value in made.items():
        assert f"# {{{key}}}" in text, key
        text = text.replace(f"# {{{key}}}", value.strip("\n"))
    (package / name).write_text(f"# {MADE}\n{text}")


# --- enums
def enum_class(enum: Enum, base: str) -> str:
    text = words(enum.paragraphs) if "\n- " in enum.paragraphs else words(enum.comment)
    items = [item for item in enum.items if item.name not in LEFT_OUT]
    return f"\n\nclass {enum.name}({base}):\n{docstring(text)}\n" + "".join(f"    {item.short} = _core.{item.name}\n" for item in items)


flags = {enum.name for enum in headers.flags}
fill("enums.py", enums="".join([*(enum_class(enum, "Constant") for enum in headers.enums if enum.name not in flags),
                                *(enum_class(enum, "Flags") for enum in headers.flags)]))

# --- errors
lines = []
for status in headers.statuses:
    bases = ", ".join(["Error", *filter(None, [BASES.get(status.name)])])
    lines.append(f"\n\nclass {status.class_name}({bases}):\n{docstring(words(status.comment))}\n    status = Status.{status.name}\n")
fill("errors.py", errors="".join(lines))


# --- dtypes
def constant(struct: Struct) -> str:
    return struct.c_name.removeprefix("dsw_").upper()


def dtype(member: Member) -> str:
    name = constant(machine.structs[member.type]) if member.type in machine.structs else NUMPY[machine.number(member.type)]
    shape = str(member.dims[0] if len(member.dims) == 1 else tuple(member.dims))
    return f'("{member.name}", {name}' + (f", {shape})" if member.dims else ")")


def dtype_of(struct: Struct) -> str:
    if struct.kind == "ID":
        names = ", ".join(f'"{member.name}"' for member in struct.members)
        return f'{constant(struct)} = _id("{struct.name}", {names})\n'
    return f"{constant(struct)} = _struct(\n" + "".join(f"    {dtype(member)},\n" for member in struct.members) + ")\n"


arrays = [struct for struct in machine.structs.values() if struct.kind in ("ID", "RECORD")]
in_arrays = {member.type for struct in arrays for member in struct.members}
arrays = [struct for struct in machine.structs.values() if struct in arrays or struct.c_name in in_arrays]
registered = [struct for struct in arrays if struct.c_name != "dsw_contact"]  # which comes in other structs only
fill("dtypes.py", types="".join(map(dtype_of, arrays)),
     registered="".join(f"_core.set_dtype_{struct.name}({constant(struct)})\n" for struct in registered))


# --- types of the structs that SWIG makes
def type_of(member: Member) -> str:
    if member.type == "dartsweep::Vec3" or member.dims and member.type != "char":
        return f"NDArray[{ARRAYS.get(member.type, 'np.float64' if member.type == 'dartsweep::Vec3' else 'np.void')}]"
    return machine.structs[member.type].name if member.type in machine.structs else NUMBERS.get(member.type, "int")


def stub(struct: Struct) -> str:
    lines = [f"\nclass {'Change' if struct.name == 'ChangeNumbers' else struct.name}:\n"]
    if struct.kind == "ID":
        arguments = ", ".join(f"{member.name}: int" for member in struct.members)
        lines.append(f"    def __init__(self, {arguments}) -> None: ...\n"
                     "    def is_null(self) -> bool: ...\n    def __hash__(self) -> int: ...\n")
    for member in headers.shown(struct):
        lines.append(f"    {re.sub('^from$', 'from_', member.name)}: {type_of(member)}\n")
    if struct.name == "ChangeNumbers":
        lines += [f"    {name}: NDArray[np.void]\n" for name in lists_of_change(machine)]
    return "".join(lines)


(package / "_core.pyi").write_text(
    f'# {MADE}\n"""Structs of the C interface. Other names of this module belong to the package; its classes are in the files beside this one."""\n\n'
    "from typing import Any\n\nimport numpy as np\nfrom numpy.typing import NDArray\n\ndef __getattr__(name: str) -> Any: ...\n"
    + "".join(map(stub, machine.listed)))

# --- calls that let other threads of Python run: all whose functions have another cost than O(1)
costs = {f"{owner}::{method.name}": [headers.cost(function) for function in method.functions]
         for owner in ("Environment", "Scene", "Body", "Trace") for method in headers.methods_of(owner)}
is_long = {name for name, each in costs.items() if not all(cost.startswith("O(1)") for cost in each)}
unknown = (LONG | SHORT) - set(costs) - {"sweep_pairs", "sweep_rigid_pairs"}
assert not unknown, f"there is no {unknown}"
(interface / "long_calls.i").write_text(
    f"// {MADE}\n" + "".join(f"DSW_LONG({name})\n" for name in sorted(is_long - SHORT | LONG)))
