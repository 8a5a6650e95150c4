#!/usr/bin/env python3
"""Writes the ids of Java, a record each, and DartsweepException.java with a class for each status; and for SWIG, which makes structs and
enums, fillers.i: methods that make the array that another one fills. Usage: declare.py ROOT SOURCE_FOLDER INTERFACE_FOLDER"""

import pathlib
import sys

root, sources, interface = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(root / "bindings/common"))
from headers import MADE, Headers, Machine, Method, Parameter, Struct, lower_camel  # noqa: E402

ID = """\
// {made}
package dartsweep;

/** {comment} */
public record {name}({declared}) {{
  /** Names nothing; null does as well where an id is an argument. */
  public static final {name} NULL = new {name}({zeros});

  public boolean isNull() {{
    return generation == 0;
  }}

  static {name} of(int[] numbers) {{
    return new {name}({read});
  }}

  static int[] numbers({name} id) {{
    return id == null ? null : new int[] {{{written}}};
  }}
}}
"""

EXCEPTION = """\
// {made}
package dartsweep;

/** A call has failed, and nothing has changed. The text is the library's; there is a class for each status. */
@SuppressWarnings("serial") // statuses are numbers of one release
public abstract sealed class DartsweepException extends RuntimeException {{
  private final Status status;

  private DartsweepException(Status status, String message) {{
    super(message);
    this.status = status;
  }}

  public Status status() {{
    return status;
  }}

  static DartsweepException of(int status, boolean closed, String message) {{
    if (closed) return new Closed(message);
    return switch (Status.swigToEnum(status)) {{
{cases}      case OK -> throw new AssertionError(message);
    }};
  }}

  /** The object was closed before. */
  public static final class Closed extends NullArgument {{
    private Closed(String message) {{
      super(message);
    }}
  }}
{classes}}}
"""

CLASS = """
  /** {comment} */
  public static {kind} class {name} extends DartsweepException {{
    private {name}(String message) {{
      super(Status.{status}, message);
    }}
  }}
"""

headers = Headers(root)


def words(text: str) -> str:
    """A comment with the names of Java."""
    text = headers.translated(text, lambda name: name, lambda enum, item: f"{enum.name}.{item.short}" if enum.c_name else item.name,
                              lambda owner, name: f"{owner}.{lower_camel(name)}")
    return text.replace("&", "&amp;").replace("<", "&lt;")


def record(struct: Struct) -> str:
    names = [member.name for member in struct.members]
    return ID.format(made=MADE, name=struct.name, comment=words(struct.comment), declared=", ".join(f"int {name}" for name in names),
                     zeros=", ".join("0" for _ in names), read=", ".join(f"numbers[{i}]" for i in range(len(names))),
                     written=", ".join(f"id.{name}" for name in names))


for struct in Machine(headers).of_kind("ID"):
    (sources / f"{struct.name}.java").write_text(record(struct))

cases = "".join(f"      case {status.name} -> new {status.class_name}(message);\n" for status in headers.statuses)
classes = "".join(CLASS.format(comment=words(status.comment), kind="non-sealed" if status.name == "NULL_ARGUMENT" else "final",
                               name=status.class_name, status=status.name) for status in headers.statuses)
(sources / "DartsweepException.java").write_text(EXCEPTION.format(made=MADE, cases=cases, classes=classes))

# --- results made rather than filled: the arguments that say what is asked, and the answer as an array
LEFT_OUT = {"get_particle_positions", "cast_from_particles", "move_bodies", "move_rigid", "move_together"}  # not so, or by hand in idioms.i
ELEMENTS = {element: name for kind in ("ID", "RECORD") for element, name in headers.listed(kind).items()}


def filler(method: Method, answer: Parameter) -> str:
    asked = [each for each in method.parameters if not (each.is_filled or each.is_start or each.is_options)]
    types = {"Points": "double[]", "double": "double"}
    arguments = ", ".join(f"{types.get(each.type) or ELEMENTS[each.element] + 'Array'} {lower_camel(each.name)}" for each in asked)

    def passed(each: Parameter) -> str:
        if each not in asked and each is not answer:
            return "null"
        return f"DoubleBuffer.wrap({lower_camel(each.name)})" if each.type in ("Points", "PointsOut") else lower_camel(each.name)

    all_passed = ", ".join(passed(each) for each in method.parameters if not each.default)
    first = asked[0].name
    made = "double[]" if answer.type == "PointsOut" else ELEMENTS[answer.element] + "Array"
    count = first + (".length" if asked[0].type == "Points" else ".size()")
    new = f"double[{count}]" if answer.type == "PointsOut" else f"{made}({count}{' / dimension()' if asked[0].type == 'Points' else ''})"
    return (f"\n  /** {words(headers.sentence(method))} */\n  public {made} {lower_camel(method.name)}({arguments}) {{\n"
            f"    {made} {answer.name} = new {new};\n    {lower_camel(method.name)}({all_passed});\n    return {answer.name};\n  }}\n")


lines = [f"// {MADE}\n"]
for owner in ("Environment", "Scene"):
    made = "".join(filler(method, answer) for method, answer in headers.fillers(owner) if method.name not in LEFT_OUT)
    lines.append(f"%extend dartsweep::{owner} {{\n%proxycode %{{{made}%}}\n}}\n")
(interface / "fillers.i").write_text("".join(lines))
