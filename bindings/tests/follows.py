#!/usr/bin/env python3
"""Adds a status, an enum, a flag, a struct and a function to a copy of the headers, and fails unless what every language makes of the headers
has them. Usage: follows.py ROOT"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

COMMENT = r"/\*\*(?:(?!\*/)[\s\S])*\*/\s*"
ADDED = [  # file, what stands before, what is added
    ("base.h", "  DSW_STATUS_FORCE_INT32", "  DSW_STATUS_LATE = 77, /**< It was late. */\n"),
    ("cpp/error.hpp", r"(?<=\))(?=\n\nnamespace)", " \\\\\n  X(LATE, Late)"),
    ("sweep.h", COMMENT + r"enum \{\s*(?:" + COMMENT + r")?DSW_SWEEP_", "/** How late. */\ntypedef enum dsw_late {\n  DSW_LATE_NONE = 0, /**< Not. */\n  DSW_LATE_VERY = 3 /**< Very. */\n} dsw_late;\n\n"),
    ("query.h", "  DSW_CAST_START_KNOWN", "  /** Late. */\n  DSW_CAST_LATE = 0x400,\n"),
    ("contact.h", COMMENT + r"typedef struct dsw_crossing \{",
     "/** Something new. */\ntypedef struct dsw_new_thing {\n  double place[3]; /**< Where. */\n  dsw_cell cell; /**< What. */\n"
     "  double share; /**< How much. */\n} dsw_new_thing;\n\n"),
    ("query.h", COMMENT + r"DSW_API dsw_status dsw_environment_find_inside",
     "/** Finds new things at points.\n * @note Cost: O(n). */\nDSW_API dsw_status dsw_environment_find_things(const dsw_environment *environment, size_t count,\n"
     "    const double *points, dsw_new_thing *things);\n\n"),
    ("cpp/environment.hpp", "  void find_inside",
     "  void find_things(Points points, View<const dsw_volume_id> hints, View<dsw_new_thing> things) const {\n"
     "    check(dsw_environment_find_things(state_->handle, points.count, points.data, things.data));\n  }\n"),
]
EXPECTED = {  # what is made, and what it has then
    "lists.i": ["X(dsw_new_thing, NewThing)", "X(dsw_late, Late)"],
    "python/enums.py": ["LATE = _core.STATUS_LATE", "VERY = _core.LATE_VERY", "LATE = _core.CAST_LATE"],
    "python/errors.py": ["class Late(Error):"],
    "python/dtypes.py": ["NEW_THING = _struct(", '("cell", CELL)', "set_dtype_NewThing(NEW_THING)"],
    "python/_core.pyi": ["class NewThing:", "    place: NDArray[np.float64]", "    share: float"],
    "python/long_calls.i": ["DSW_LONG(Environment::find_things)"],
    "csharp/Structs.cs": ["public partial struct NewThing", "public Vec3 Place;", "public Cell Cell;"],
    "csharp/Exceptions.cs": ["class LateException : DartsweepException"],
    "csharp/Fillers.cs": ["public NewThing[] FindThings(double[] points)"],
    "csharp/structs.h": ["offsetof(dsw_new_thing, share) == (is_narrow ? 40 : 40)"],
    "java/DartsweepException.java": ["class Late extends DartsweepException", "case LATE -> new Late(message);"],
    "java/fillers.i": ["public NewThingArray findThings(double[] points)"],
    "node/structs.js": ["Late: { None: 0, Very: 3 }", "['LATE', 'Late']", "name: 'NewThing'"],
    "node/structs.d.ts": ["export class LateError", "export interface NewThing {", "export const CAST_LATE: 1024;"],
    "node/index.d.ts": ["  findThings(points: Points, options?: { hints?: Structs<VolumeId>; things?: NewThingArray }): NewThingArray;"],
    "node/environment.js": ["  findThings(points, { hints, things = new arrays.NewThingArray("],
    "node/index.mjs": ["  NewThingArray,\n"],
    "lua/dartsweep.lua": ["function Environment:find_things(points, hints, things)"],
}

root = pathlib.Path(sys.argv[1])
with tempfile.TemporaryDirectory() as folder:
    copy, out = pathlib.Path(folder, "copy"), pathlib.Path(folder, "out")
    shutil.copytree(root / "include", copy / "include")
    shutil.copytree(root / "bindings", copy / "bindings", ignore=shutil.ignore_patterns("node_modules", "docs", "__pycache__"))
    for name, before, added in ADDED:
        path = copy / "include/dartsweep" / name
        text, count = re.subn(before, lambda found: added.replace("\\\\", "\\") + found[0], path.read_text(), count=1)
        if count == 0:
            sys.exit(f"{name} has no {before!r}: this test must follow it")
        path.write_text(text)
    for language in ("python", "csharp", "java", "node", "lua"):
        (out / language).mkdir(parents=True)
    source = copy / "bindings"
    shutil.copytree(source / "node/src", out / "node", dirs_exist_ok=True)
    for script, *arguments in (
        ("common/headers.py", out / "lists.i"),
        ("python/declare.py", out / "python", out / "python"),
        ("csharp/declare.py", out / "csharp", out / "csharp"),
        ("java/declare.py", out / "java", out / "java"),
        ("node/declare.py", source / "node/src", out / "node", out / "node"),
        ("lua/declare.py", source / "lua/src/dartsweep.lua", out / "lua/dartsweep.lua"),
    ):
        subprocess.run([sys.executable, "-B", source / script, copy, *arguments], check=True)
    missing = [f"{name}: {text}" for name, texts in EXPECTED.items() for text in texts if text not in (out / name).read_text()]
if missing:
    sys.exit("what was added to the headers is not in\n" + "\n".join(missing))
print(f"bindings: {len(EXPECTED)} files follow the headers")
