#!/usr/bin/env python3
"""Adds the Tight-Inclusion CCD of the IPC Toolkit to the curves of single pairs that dartsweep_error has left in a folder.

usage: tight_inclusion.py FOLDER [--most PAIRS] [--budget SECONDS]

It reads FOLDER/pairs_<curve>.csv (exact doubles and the exact time) and appends to FOLDER/<curve>.csv and .txt. Times are of the
processor, one call a pair, means. As many calls on a pair so far apart that the first box settles it are timed beside them and
subtracted: that is what calling from Python costs, and a little more.
"""

import argparse
import csv
import math
import statistics
import time
from pathlib import Path

import numpy as np
from ipctk import tight_inclusion

METHOD = "Tight-Inclusion (Python)"
DEFAULT_TOLERANCE, DEFAULT_ITERATIONS = 1e-6, 10**7
CURVES = ["ccd_vertex_face", "ccd_edge_edge", "degenerate_vertex_face", "degenerate_edge_edge"]
TOLERANCES = [(10.0**-k, DEFAULT_ITERATIONS, f"1e-{k:02d}", "tolerance") for k in (1, 2, 3, 4, 6, 8, 10)]
LIMITS = [(DEFAULT_TOLERANCE, 10**k, f"1e{k}", "iterations at most") for k in (1, 2, 3, 4, 5)]


def read_pairs(path, most):
    """Arguments of one call and the true time, or None, of each pair."""
    pairs = []
    with open(path) as file:
        faces = next(file).split()[2] == "a"
        for line in file:
            fields = line.rstrip("\n").split(",")
            points = np.array([float.fromhex(x) for x in fields[:15]]).reshape(5, 3)
            truth = float.fromhex(fields[15]) if fields[15] else None
            if faces:
                p, to, a, b, c = points
                arguments = (p, a, b, c, to, a, b, c)
            else:
                p, to, q, a, b = points
                arguments = (p, q, a, b, to, q, a, b)
            pairs.append((arguments, truth))
            if len(pairs) == most:
                break
    return (tight_inclusion.point_triangle_ccd if faces else tight_inclusion.edge_edge_ccd), pairs


def ask(function, arguments, options, budget):
    """Answers and seconds a call; stops when the budget of seconds is spent."""
    for one in arguments[:20]:
        function(*one, **options)
    answers = []
    start = time.process_time()
    while len(answers) < len(arguments) and time.process_time() - start < budget:
        answers.extend(function(*one, **options) for one in arguments[len(answers):len(answers) + 20])
    return answers, (time.process_time() - start) / len(answers)


def measure(folder, curve, most, budget):
    function, pairs = read_pairs(folder / f"pairs_{curve}.csv", most)
    with open(folder / f"{curve}.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["method"] != METHOD]
    degenerate = curve.startswith("degenerate")
    arguments = [arguments for arguments, _ in pairs]
    far = tuple(x + (1000.0 if i in ((1, 2, 3, 5, 6, 7) if "face" in curve else (2, 3, 6, 7)) else 0.0)
                for i, x in enumerate(arguments[0]))
    best = None
    # On degenerate pairs small tolerances take millions of iterations and answer nothing else.
    for tolerance, iterations, setting, unit in (TOLERANCES[:5] if degenerate else TOLERANCES) + LIMITS:
        options = {"tolerance": tolerance, "max_iterations": iterations}
        _, call = ask(function, [far] * len(pairs), options, budget)
        answers, whole = ask(function, arguments, options, budget)
        errors, missed, invented, late = [], 0, 0, 0
        for (hit, toi, _), (_, truth) in zip(answers, pairs):
            missed += truth is not None and not hit
            invented += hit and truth is None
            if truth is not None:
                errors.append(abs((toi if hit else 1.0) - truth))
                late += hit and toi > truth
        error = (missed + invented) / len(answers) if degenerate else statistics.fmean(errors)
        row = dict(rows[0], method=METHOD, setting=setting, setting_unit=unit, error=f"{error:.6g}",
                   seconds_per_item=f"{max(whole - call, 1e-9):.6g}", count=len(answers) if degenerate else len(errors),
                   note=f"median {statistics.median(errors):.2g}, largest {max(errors):.2g}; missed {missed}, invented {invented}, "
                        f"later than true {late}; {whole * 1e6:.2f} us a call, of which {call * 1e6:.2f} for a pair far apart are subtracted")
        rows.append(row)
        if tolerance == DEFAULT_TOLERANCE and iterations == DEFAULT_ITERATIONS:
            best = row
    with open(folder / f"{curve}.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    ours, seconds = float(rows[0]["seconds_per_item"]), float(best["seconds_per_item"])
    text = (folder / f"{curve}.txt").read_text().splitlines()[0]
    seen = best["note"].split("; ")[1]  # missed, invented, later than true
    sentence = (f"Tight-Inclusion at its default tolerance of 1e-6: {float(best['error']):.2g} at {seconds * 1e6:.3g} us, "
                f"{seconds / ours:.0f} times the exact test ({seen}).")
    (folder / f"{curve}.txt").write_text(f"{text}\n{sentence}\n")
    print(curve, sentence)
    assert math.isfinite(float(best["error"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--most", type=int, default=2000, help="pairs of each curve")
    parser.add_argument("--budget", type=float, default=2.0, help="seconds for each setting")
    options = parser.parse_args()
    for curve in CURVES:
        if (options.folder / f"pairs_{curve}.csv").exists():
            measure(options.folder, curve, options.most, options.budget)


if __name__ == "__main__":
    main()
