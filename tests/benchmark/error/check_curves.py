#!/usr/bin/env python3
"""Checks the tables that dartsweep_error has written: check_curves.py FOLDER. Columns, five points at least, finite numbers; what is
exact must be exact, and what approximates must not be."""

import csv
import math
import sys
from pathlib import Path

COLUMNS = "curve,method,setting,setting_unit,seconds_per_item,item,error_name,error,error_unit,count,note".split(",")
ULP = 2.0**-53  # of times below 1: they are rounded down
ROUNDING = 1e-13  # of places, in cells, coordinates up to 20
# What the exact method may be off by, by curve.
EXACT = {
    "edge_time": ("dartsweep exact", ULP), "edge_place": ("dartsweep exact", ROUNDING),
    "edge_normal": ("dartsweep exact", 0),
    "move_time": ("dartsweep exact", ULP),
    "ccd_vertex_face": ("dartsweep exact", ULP), "ccd_edge_edge": ("dartsweep exact", ULP),
    "degenerate_vertex_face": ("dartsweep exact", 0), "degenerate_edge_edge": ("dartsweep exact", 0),
    "missed_vessel": ("dartsweep FACES", 0), "missed_faces": ("dartsweep FACES", 0), "missed_spikes": ("dartsweep FACES", 0),
    "contact_point": ("dartsweep exact", ROUNDING), "contact_normal": ("dartsweep exact", 1e-12), "cast_time": ("dartsweep exact", ULP), "cast_through": ("dartsweep exact", 0),
    "elimination": ("dartsweep exact", 0),
    "sampling_vessel": None, "sampling_faces": None, "stand_off_gap": ("dartsweep exact", ROUNDING), "stand_off_fallbacks": None,
}
# What the notes must say: exact times are the largest doubles before the true ones, and everything is free at any setting.
NOTES = {"edge_time": "; 0 times are not", "move_time": "; 0 times are not", "stand_off_gap": "; 0 vertices behind their wall, 0 edges in one",
         "elimination": ", 0 ropes not free"}


def check(folder, name, exact):
    faults = []
    with open(folder / f"{name}.csv", newline="") as file:
        reader = csv.DictReader(file)
        rows = list(reader)
    if reader.fieldnames != COLUMNS:
        faults.append("other columns")
    if len(rows) < 5:
        faults.append(f"{len(rows)} points")
    if not (folder / f"{name}.txt").read_text().strip():
        faults.append("no sentence")
    for row in rows:
        error, seconds, count = float(row["error"]), float(row["seconds_per_item"]), int(row["count"])
        if not (math.isfinite(error) and error >= 0 and math.isfinite(seconds) and seconds > 0):
            faults.append(f"{row['method']} {row['setting']}: error {error}, {seconds} s")
        if row["curve"] != name or not row["method"] or not row["error_name"] or not row["item"]:
            faults.append("an empty field")
        if exact and row["method"] == exact[0] and not (error <= exact[1] and count > 0):
            faults.append(f"{row['method']} {row['setting']} is not exact: {error} over {count}")
    if exact and not any(row["method"] == exact[0] for row in rows):
        faults.append("no exact method")
    ours = [float(row["error"]) for row in rows if exact and row["method"] == exact[0]]
    if ours and not any(float(row["error"]) > max(ours) for row in rows):
        faults.append("nothing is less exact")
    return faults


def main():
    folder = Path(sys.argv[1])
    faults = {}
    for name, exact in EXACT.items():
        found = check(folder, name, exact)
        if found:
            faults[name] = found
    for name, text in NOTES.items():
        with open(folder / f"{name}.csv", newline="") as file:
            for row in csv.DictReader(file):
                if (name not in ("edge_time", "move_time") or row["method"] == "dartsweep exact") and text not in row["note"]:
                    faults.setdefault(name, []).append(f"{row['method']} {row['setting']}: {row['note']}")
    for name, found in faults.items():
        print(f"{name}: {'; '.join(found)}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
