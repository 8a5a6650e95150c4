"""Stability in contact: where each scene and integrator breaks, out of the rows of contact_stability.csv."""
import math
from pathlib import Path

from catalogue import in_words
from read import BadFile, PROMISES, number, read_rows
from style import power

# Axes, and their easy values.
AXES = {"stiffness": 1.0, "dt": 1e-3, "mass_ratio": 1.0, "friction": 0.3, "aspect": 1.0}
LEAST_CONTACTS = 100


def read(folder):
    """The rows, numbers as numbers; none without the file."""
    path = Path(folder) / "contact_stability.csv"
    if not path.exists():
        return []
    rows = []
    for line, row in read_rows(path, ("scene", "integrator", *AXES, "stable", "cause", "steps", "contacts", *PROMISES)):
        for column in (*AXES, "stable", "steps", "contacts", *PROMISES):
            row[column] = number(path, line, row, column, least=0)
        if not row["stable"] and not row["cause"]:
            raise BadFile(f"{path}:{line}: a row that is not stable has no cause")
        rows.append(row)
    return rows


def _span(values, easy):
    """Which values of one axis are stable, in words: (value, stable) with the easy one among them."""
    values = sorted(values)
    if all(stable for _, stable in values):
        return "all"
    here = next((i for i, (value, _) in enumerate(values) if math.isclose(value, easy)), None)
    if here is None:
        raise BadFile("contact_stability.csv: an axis has no row of the easy case")
    if not values[here][1]:
        return "none"
    low = high = here
    while low > 0 and values[low - 1][1]:
        low -= 1
    while high + 1 < len(values) and values[high + 1][1]:
        high += 1
    return f"{power(values[low][0])} to {power(values[high][0])}"


def limits(rows):
    """For each scene and integrator: up to where each axis alone is stable, how many corners are, and what breaks the others."""
    found = []
    for scene, integrator in dict.fromkeys((row["scene"], row["integrator"]) for row in rows):
        mine = [row for row in rows if (row["scene"], row["integrator"]) == (scene, integrator)]
        spans = {}
        for axis, easy in AXES.items():
            alone = [row for row in mine if all(math.isclose(row[other], value) for other, value in AXES.items() if other != axis)]
            spans[axis] = _span([(row[axis], row["stable"] > 0) for row in alone], easy)
        corners = [row for row in mine if sum(not math.isclose(row[axis], easy) for axis, easy in AXES.items()) > 1]
        causes = {}
        for row in mine:
            if not row["stable"]:
                causes[row["cause"]] = causes.get(row["cause"], 0) + 1
        often = sorted(causes, key=lambda cause: (-causes[cause], cause))
        found.append({"scene": scene, "integrator": in_words(integrator), **spans, "corners": f"{sum(row['stable'] > 0 for row in corners)} of {len(corners)}",
                      "causes": "; ".join(f"{cause} ({causes[cause]})" for cause in often) or "–"})
    return found
