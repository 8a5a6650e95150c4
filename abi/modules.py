#!/usr/bin/env python3
"""Names and signatures of the modules of Python, Java, C#, Lua and JavaScript, one a line: modules/LANGUAGE.txt has those that were
agreed on. Nothing is compiled: what SWIG, declare.py and the sources by hand declare is read.

usage: modules.py check LANGUAGE...   fails when lines were added, removed or changed; languages that need SWIG are skipped without it
       modules.py write [LANGUAGE...] renews the files: all of them by default
       modules.py self_test           names that go, and other signatures, are seen
"""
import ast
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BINDINGS = ROOT / "bindings"
LISTS = ROOT / "abi" / "modules"
CSHARP = ["-namespace", "Dartsweep", "-dllimport", "dartsweep_csharp", "-DSWIG_CSHARP_NO_EXCEPTION_HELPER",
          "-DSWIG_CSHARP_NO_STRING_HELPER", "-DSWIG_CSHARP_NO_IMCLASS_STATIC_CONSTRUCTOR"]  # as in bindings/csharp/CMakeLists.txt


def run(*command):
    done = subprocess.run([str(each) for each in command], text=True, capture_output=True)
    if done.returncode != 0:
        sys.exit(f"{command[0]}: {done.stderr}")


def python(script, *arguments):
    run(sys.executable, "-B", BINDINGS / script, *arguments)


def swig(language, out, made, *options):
    interface = {"java": "java.i", "csharp": "csharp.i", "lua": "interface.i"}[language]
    folders = (made, BINDINGS / language, BINDINGS, ROOT / "include")
    run("swig", "-c++", f"-{language}", *options, "-outdir", out, "-o", out / "wrap.cpp", *(f"-I{folder}" for folder in folders),
        BINDINGS / language / interface)


# ---- languages with braces --------------------------------------------------------------------------------------------


def bare(text):
    """Without comments; texts are empty."""
    found = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", re.S)
    return found.sub(lambda part: '""' if part[0][0] in "\"'" else " ", text)


def normal(text):
    text = " ".join(text.split())
    text = re.sub(r" ?([(),;<>\[\]]) ?", r"\1", text)
    text = re.sub(r"\b0x[0-9a-f]+\b", lambda number: str(int(number[0], 16)), text)  # SWIG 4.1 writes 0x10 where 4.5 writes 16
    return re.sub(r"([,;\])>])(?=[\w{])", r"\1 ", text)


def body_end(text, at):
    """Behind the brace that closes the one before `at`."""
    depth = 1
    while depth > 0:
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
    return at


TYPE = re.compile(r"\b(?:class|interface|enum|struct|record)\s+(\w+)")
ANNOTATION = re.compile(r"@\w+(?:\([^)]*\))?|(?:(?<=^)|(?<=[;{}\]]))\s*\[[A-Z][^\]]*\]")


def declared(text, is_public, owner=""):
    """What stands before each body and each semicolon, if it is public."""
    lines, start, at, depth = [], 0, 0, 0
    while at < len(text):
        sign, at = text[at], at + 1
        depth += {"(": 1, ")": -1, "[": 1, "]": -1}.get(sign, 0)
        if depth > 0 or sign not in "{;":
            continue
        declaration = normal(ANNOTATION.sub("", text[start:at - 1].replace("}", " ")))
        if re.match(r"namespace \w+$", declaration):
            start = at
            continue
        kind = TYPE.search(declaration)
        end = body_end(text, at) if sign == "{" else at
        if sign == "{" and kind and "=" not in declaration and "new " not in declaration:
            if is_public(declaration):
                name = f"{owner}.{kind[1]}" if owner else kind[1]
                lines.append(f"{owner}: {declaration}" if owner else declaration)
                inside = text[at:end - 1]
                if re.search(r"\benum ", declaration):
                    constants, _, inside = inside.partition(";")
                    lines += [f"{name}: {normal(each)}" for each in re.split(r",(?![^(]*\))", constants) if each.strip()]
                public = (lambda _: True) if re.search(r"\binterface ", declaration) else is_public
                lines += declared(inside, public, name)
        elif is_public(declaration) and declaration:
            accessors = re.findall(r"\b(get|set)\b\s*(?=[{;=])", text[at:end]) if sign == "{" and ")" not in declaration else []
            value = re.sub(r"\) ?: ?(?:this|base)\(.*|=(?!.*=>)(?!\s*-?[\d\"]).*", lambda cut: cut[0][:1].strip("="), declaration).strip()
            lines.append(f"{owner}: {value}{' { ' + ' '.join(accessors) + ' }' if accessors else ''}")
        start = at = end
    return lines


def in_files(paths, is_public):
    return [line for path in sorted(paths) for line in declared(re.sub(r"^\s*#.*$", "", bare(path.read_text()), flags=re.M), is_public)]


def is_public(declaration):
    return re.match(r"(public|protected)\b", declaration) is not None


def java(folder):
    out, made = folder / "java", folder / "made"
    python("java/declare.py", ROOT, out, made)
    swig("java", out, made, "-package", "dartsweep")
    python("common/enumerators.py", out, ".java")
    by_hand = (BINDINGS / "java/src/main/java/dartsweep").glob("*.java")
    return in_files([*(path for path in out.glob("*.java") if path.name != "DartsweepJNI.java"), *by_hand], is_public)


def csharp(folder):
    out, made = folder / "csharp", folder / "made"
    swig("csharp", out, made, *CSHARP)
    python("common/enumerators.py", out, ".cs", "camel")
    python("csharp/declare.py", ROOT, out, made)
    unused = ("LibraryPINVOKE.cs", "SWIGTYPE_p_double.cs", "SWIGTYPE_p_unsigned_int.cs")
    sources = [*(path for path in out.glob("*.cs") if path.name not in unused), *(BINDINGS / "csharp/src").glob("*.cs")]
    return in_files(sources, is_public)


def javascript(folder):
    out = folder / "node"
    shutil.copytree(BINDINGS / "node/src", out, dirs_exist_ok=True)
    python("node/declare.py", ROOT, BINDINGS / "node/src", out, folder / "made")
    return [line for name in ("index.d.ts", "structs.d.ts") for line in typed(bare((out / name).read_text()))]


def typed(text):
    """Declarations of TypeScript: those of a class, an interface or an enum with its name."""
    lines, at = [], 0
    while found := re.compile(r"export (?:declare |abstract )*(?:class|interface|enum|namespace) (\w+)[^{]*\{").search(text, at):
        lines += parts_of(text[at:found.start()], ";")
        end = body_end(text, found.end())
        lines.append(normal(found[0][:-1]))
        lines += [f"{found[1]}: {part}" for part in parts_of(text[found.end():end - 1], "," if " enum " in found[0] else ";")]
        at = end
    return lines + parts_of(text[at:], ";")


def parts_of(text, separator):
    """What stands between separators that are in no braces."""
    parts, depth = [""], 0
    for sign in text:
        depth += {"{": 1, "(": 1, "}": -1, ")": -1}.get(sign, 0)
        if sign == separator and depth == 0:
            parts.append("")
        else:
            parts[-1] += sign
    return [normal(part) for part in parts if part.strip()]


# ---- Lua --------------------------------------------------------------------------------------------------------------


def lua(folder):
    out = folder / "lua"
    python("lua/declare.py", ROOT, BINDINGS / "lua/src/dartsweep.lua", out / "dartsweep.lua")
    swig("lua", out, folder / "made")
    text = (out / "wrap.cpp").read_text()
    counts = dict(re.findall(r"static int (_wrap_\w+)\(lua_State\* L\) \{\s*(?:(?!\nstatic int ).)*?SWIG_check_num_args\(\"[^\"]*\",(\d+,\d+)\)", text, flags=re.S))
    lines = []
    for name, entries in re.findall(r"static swig_lua_method swig_(\w+)_methods\[\]\s*=\s*\{(.*?)\n\};", text, flags=re.S):
        lines += [f"{name}: {method}({counts.get(wrapper, 'any')} arguments)" for method, wrapper in re.findall(r'\{ "(\w+)", (\w+)\}', entries)]
    for name, entries in re.findall(r"static swig_lua_attribute swig_(\w+)_attributes\[\]\s*=\s*\{(.*?)\n\};", text, flags=re.S):
        lines += [f"{name}.{attribute}{', read only' if 'set_immutable' in set_it else ''}"
                  for attribute, set_it in re.findall(r'\{ "(\w+)", \w+, (\w+)', entries)]
    lines += [f"constant {name}" for name in re.findall(r'SWIG_LUA_CONSTTAB_\w+\("(\w+)"', text)]
    lines += re.findall(r"^function ([\w.]+[.:]\w+\([^)]*\))", (out / "dartsweep.lua").read_text(), flags=re.M)
    return lines


# ---- Python -----------------------------------------------------------------------------------------------------------


def of_python_class(node, module):
    yield f"{module}: class {node.name}({', '.join(ast.unparse(base) for base in node.bases)})"
    owner = f"{module}: {node.name}"
    for part in node.body:
        if isinstance(part, (ast.FunctionDef, ast.AsyncFunctionDef)) and (part.name[0] != "_" or part.name.endswith("__")):
            yield f"{owner}.{function_text(part)}"
        elif isinstance(part, ast.AnnAssign) and not part.target.id.startswith("_"):
            yield f"{owner}.{part.target.id}: {ast.unparse(part.annotation)}"
        elif isinstance(part, ast.Assign) and isinstance(part.targets[0], ast.Name) and part.targets[0].id[0] != "_":
            yield f"{owner}.{ast.unparse(part)}"


def function_text(node):
    marks = "".join(f"@{ast.unparse(mark)} " for mark in node.decorator_list)
    returned = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{marks}{node.name}({ast.unparse(node.args)}){returned}"


def of_python_module(path, module, wanted):
    """Public names; in a module with an underscore those that others show or derive from."""
    for node in ast.parse(path.read_text()).body:
        name = getattr(node, "name", None) or (ast.unparse(node.targets[0]) if isinstance(node, ast.Assign) else "_")
        if name.startswith("_") and name != "__all__" or module.rpartition(".")[2].startswith("_") and module != "_core" and name not in wanted:
            continue
        if isinstance(node, ast.ClassDef):
            yield from of_python_class(node, module)
        elif isinstance(node, ast.FunctionDef):
            yield f"{module}: {function_text(node)}"
        elif name == "__all__":
            yield from (f"{module}: {each}" for each in ast.literal_eval(node.value))
        elif isinstance(node, ast.Assign):
            yield f"{module}: {ast.unparse(node)}"


def python_package(folder):
    out, sources = folder / "python", BINDINGS / "python/src/dartsweep"
    python("python/declare.py", ROOT, out, folder / "made")
    paths = {**{path.name: path for path in sources.glob("*.py")}, **{path.name: path for path in out.glob("*.py*")}}
    wanted = set()
    for path in paths.values():
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom):
                wanted |= {each.name for each in node.names if each.asname == each.name or path.stem == "__init__"}
            elif isinstance(node, ast.ClassDef):
                wanted |= {ast.unparse(base) for base in node.bases}
    lines = []
    for name, path in sorted(paths.items()):
        lines += of_python_module(path, path.stem, wanted)
    return lines


LANGUAGES = {"python": python_package, "java": java, "csharp": csharp, "lua": lua, "javascript": javascript}
WITH_SWIG = ("java", "csharp", "lua")


def lines_of(language):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for each in ("python", "java", "csharp", "lua", "node", "made"):
            (folder / each).mkdir()
        python("common/headers.py", ROOT, folder / "made" / "lists.i")
        return sorted({line for line in LANGUAGES[language](folder) if not re.search(r"\bVERSION_(?:MAJOR|MINOR|PATCH)\b|^import ", line)})


def differences(language, before, after):
    removed, added = sorted(set(before) - set(after)), sorted(set(after) - set(before))
    return [f"{language}: - {line}" for line in removed] + [f"{language}: + {line}" for line in added]


def check(languages):
    problems = []
    for language in languages:
        if language in WITH_SWIG and shutil.which("swig") is None:
            print(f"skipped: {language}, there is no swig")
            continue
        before, after = (LISTS / f"{language}.txt").read_text().splitlines(), lines_of(language)
        print(f"{language}: {len(after)} names and signatures")
        problems += differences(language, before, after)
    if problems:
        problems.append("if that is meant: `abi/modules.py write`, and a line in CHANGELOG.md")
    return problems


def write(languages):
    LISTS.mkdir(exist_ok=True)
    for language in languages or LANGUAGES:
        (LISTS / f"{language}.txt").write_text("".join(f"{line}\n" for line in lines_of(language)))
    return []


def self_test():
    """A name that goes, a parameter that is added and a type that changes are seen in each language's words."""
    text = "namespace N { public class A { public int Get(int a) { if (a > 0) { return a; } return 0; } int hidden; } }"
    cases = [(text, text.replace("int a", "long a")), (text, text.replace("Get", "Take")), (text, text.replace("public int", "int"))]
    problems = []
    for before, after in cases:
        lines = [declared(bare(each), is_public) for each in (before, after)]
        if not differences("made", *lines):
            problems.append(f"{after} is not told from {before}")
    if declared(bare(text), is_public) != ["public class A", "A: public int Get(int a)"]:
        problems.append(f"read as {declared(bare(text), is_public)}")
    known = {language: (LISTS / f"{language}.txt").read_text().splitlines() for language in LANGUAGES}
    wanted = {"python": "environment: Environment.locate(", "java": "Environment: public void castSegments(", "csharp": "Body: public Level GetLevel(",
              "lua": "Body: get_level(1,1 arguments)", "javascript": "Body: getLevel()"}
    problems += [f"{language}.txt has no {text}" for language, text in wanted.items() if not any(line.startswith(text) for line in known[language])]
    return problems


def main():
    commands = {"check": check, "write": write}
    if len(sys.argv) == 2 and sys.argv[1] == "self_test":
        problems = self_test()
    elif len(sys.argv) > 1 and sys.argv[1] in commands and set(sys.argv[2:]) <= set(LANGUAGES):
        problems = commands[sys.argv[1]](sys.argv[2:])
    else:
        sys.exit(__doc__)
    print("\n".join(problems) if problems else "modules: in order")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
