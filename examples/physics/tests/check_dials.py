#!/usr/bin/env python3
"""Checks the curves that the program dials has written, in a short run: check_dials.py FOLDER."""

import csv
import math
import sys
from pathlib import Path


def errors(folder, curve, method, name=""):
    """The errors of a method by its settings, in the order of the file."""
    with open(folder / f"{curve}.csv", newline="", encoding="utf-8") as file:
        return [float(row["error"]) for row in csv.DictReader(file) if row["method"] == method and row["error_name"].startswith(name)]


def falls(found):
    """Whether the last setting is better than the first."""
    return len(found) > 1 and found[-1] < found[0]


def rises(found):
    return falls(found[::-1])


def bars(folder):
    """(what has to hold, whether it does)."""
    yield "integrators: a shorter step is better", all(falls(errors(folder, "integrator", name)) for name in ("symplectic_euler", "implicit_euler"))
    yield "order and time step: a shorter step is better", all(
        falls(errors(folder, "time_step", method, kind)) for method in ("from the tip", "from the turning end") for kind in ("time", "largest"))
    yield "rod: two linearisations are the reference", errors(folder, "rod", "linearisations", "distance")[-1] == 0 and falls(errors(folder, "rod", "linearisations", "distance"))
    yield "rod: more sweeps are better", falls(errors(folder, "rod", "most sweeps", "distance"))
    yield "rod: a smaller tolerance is no worse", errors(folder, "rod", "tolerance, mm", "distance")[-1] <= errors(folder, "rod", "tolerance, mm", "distance")[0]
    yield "rod: recovery takes depth back", falls(errors(folder, "rod", "recovery", "depth"))
    yield "contacts: more rounds are better", falls(errors(folder, "contact_response", "rounds of impulses"))
    yield "contacts: no memory is the reference", errors(folder, "contact_response", "steps that contacts are kept")[0] == 0
    yield "contacts: a thousand vertices are the reference", errors(folder, "contact_response", "most vertices")[-1] == 0
    yield "negligible: 1e-6 is the reference, 0.1 is not", rises(errors(folder, "negligible", "removal of [JCD10] 7.3.1"))
    for curve in ("integrator", "solver_steps", "shape_matching", "omega", "time_step", "contact_response", "negligible", "rod"):
        with open(folder / f"{curve}.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        good = len(rows) >= 5 and all(math.isfinite(float(row["error"])) and float(row["seconds_per_item"]) > 0 for row in rows)
        yield f"{curve}: five settings, finite", good and (folder / f"{curve}.txt").read_text(encoding="utf-8").strip() != ""


def main():
    missed = [what for what, holds in bars(Path(sys.argv[1])) if not holds]
    print("\n".join(missed) if missed else "all bars hold")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
