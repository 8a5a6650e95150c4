#!/usr/bin/env python3
"""Fails unless every function that may change a scene or an environment is recorded, or stands below with the reason why not.

usage: check_recorded.py ROOT
"""
import pathlib
import re
import sys

NOT_RECORDED = {
    "dsw_environment_destroy": "ends what is recorded",
    "dsw_scene_destroy": "ends the recording",
    "dsw_scene_create": "makes another scene; the recorded one is in the beginning of its recording",
    "dsw_scene_load": "likewise",
    "dsw_scene_start_recording": "the recording itself",
    "dsw_scene_stop_recording": "the recording itself",
    "dsw_scene_write_bug_report": "leaves the scene as it is",
    "dsw_body_find_near_rows": "writes its answer alone, on which no other call depends",
    "dsw_scene_cast": "notes where parts of bodies are, on which no result depends",
    "dsw_scene_find_nearest": "notes where parts of bodies are, on which no result depends",
    "dsw_scene_step_fraction": "moves nothing, and what it remembers of places near the bodies changes no result",
    "dsw_body_find_penetrations": "writes its answer alone, on which no other call depends",
    "dsw_body_find_least_gap": "writes what is remembered of places near the body, on which no result depends",
}

root = pathlib.Path(sys.argv[1])
headers = "\n".join(path.read_text() for path in sorted((root / "include/dartsweep").glob("*.h")))
declared = set(re.findall(r"^DSW_API\b[^;(]*?(dsw_\w+)\s*\(", headers, re.M))
# With a scene or an environment that is not const as its first argument.
changing = set(re.findall(r"^DSW_API\s+\w+\s+(dsw_\w+)\s*\(\s*(?:dsw_scene|dsw_environment)\s*\*", headers, re.M))
recorded = set(re.findall(r"^ *DSW_ROW\(\d+, (dsw_\w+)\)", (root / "src/capi/calls.h").read_text(), re.M))

wrong = []
for name in sorted(changing - recorded - set(NOT_RECORDED)):
    wrong.append(f"{name} takes a scene or an environment that it may change, and is not recorded")
for name in sorted(recorded & set(NOT_RECORDED)):
    wrong.append(f"{name} is recorded and listed as not recorded")
for name in sorted((recorded | set(NOT_RECORDED)) - changing):
    wrong.append(f"{name} is no function that changes anything")
for name in sorted(recorded - declared):
    wrong.append(f"{name} is declared in no header")
if wrong:
    sys.exit("\n".join(wrong))
print(f"{len(recorded)} functions are recorded, {len(NOT_RECORDED)} need not be")
