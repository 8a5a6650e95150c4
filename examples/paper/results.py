"""What the programs measured, beside what [JCD10] states: tables, CSV files and a sentence for each figure.

usage: results.py FOLDER FIGURE...

Reads catheter_length.csv (figure 9), fig11.json and fig12.json (of dartsweep_bench) in FOLDER, writes figure9.csv,
figure11.csv, figure12.csv and results.csv there and prints the table. Needs nothing but Python.
"""
import csv
import json
import math
import sys
from pathlib import Path

# All that is known of the paper's figures: these are its words and numbers, not points read off its pictures.
PAPER_SHARE = 0.03  # figure 9: fewer of the tetrahedra are tested, 20 particles in 200,000 tetrahedra
PAPER_PARTICLES = 20
PAPER_MICROSECONDS = 5.0  # figure 11: a particle and step, one core of a Core 2 at 2.4 GHz
PAPER_TESTS = 7.0  # figure 11: orientation tests of a particle
PAPER_VS_BULLET = 3.0  # figure 11: times faster than Bullet's tree of boxes
PAPER_OVERHEAD = 9.0  # figure 12: edges over particles alone
PAPER_OVERHEAD_HYBRID = 3.0

SIZES = {"n1e3": 10**3, "n1e4": 10**4, "n1e5": 10**5, "n1e6": 10**6}
CASTS_PER_PARTICLE = 7  # its own move and six edges
# Name in the figure, key of the time of a cast, what it is.
ENGINES = [("ours", "ns", "casts"), ("Bullet, segment", "bullet_ns", "casts"),
           ("Bullet, triangles in a box", "bullet_box_ns", "casts"),
           ("ours, walls change", "total_ns", "changes"), ("ours, bodies, walls change", "body_total_ns", "changes"),
           ("Bullet, walls change", "bullet_total_ns", "changes"),
           ("GIMPACT, triangles, walls change", "gimpact_total_ns", "changes")]
# Name in the figure, key of the benchmark, the paper's ratio.
ELIMINATIONS = [("none", "edges", "overhead", PAPER_OVERHEAD),
                ("by environment", "edges_environment", "overhead_environment", None),
                ("by motion", "edges_motion", "overhead_motion", None),
                ("hybrid", "edges_hybrid", "overhead_hybrid", PAPER_OVERHEAD_HYBRID)]


class Missing(Exception):
    """A program's output lacks something; the text says what."""


def read_rows(path):
    """Rows of a CSV file, numbers as floats."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise Missing(f"{path} has no rows")
    return [{name: as_number(value) for name, value in row.items()} for row in rows]


def as_number(text):
    try:
        return float(text)
    except ValueError:
        return text


def read_figures(path):
    with open(path) as file:
        return json.load(file)


def write_rows(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: text_of(value) for name, value in row.items()} for row in rows)


def text_of(value):
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def figure_of(figures, key):
    try:
        return float(figures[key])
    except KeyError:
        raise Missing(f"the benchmark wrote no {key}") from None


def result(figure, quantity, ours, paper, holds=None):
    """@param paper: what it states, in words. @param holds: null where there is nothing to compare."""
    return {"figure": figure, "quantity": quantity, "ours": ours, "paper": paper,
            "holds": "" if holds is None else "yes" if holds else "no"}


class Figure:
    """Rows for its CSV file, results, and one sentence: does it hold?"""

    def __init__(self, number, rows, results, sentence):
        self.number, self.rows, self.results, self.sentence = number, rows, results, sentence


def figure9(folder):
    rows = read_rows(folder / "catheter_length.csv")
    needed = {"length_mm", "vertices", "cells", "cells_tested", "cells_tested_share", "cell_visits_share",
              "orientation_tests"}
    if not needed <= set(rows[0]):
        raise Missing(f"catheter_length.csv lacks {', '.join(sorted(needed - set(rows[0])))}")
    longest = max(rows, key=lambda row: row["length_mm"])
    share = max(row["cells_tested_share"] for row in rows)
    visits = max(row["cell_visits_share"] for row in rows)
    short = min(rows, key=lambda row: abs(row["vertices"] - PAPER_PARTICLES))
    results = [
        result(9, "tetrahedra in the mesh", longest["cells"], "200000"),
        result(9, "longest catheter, mm", longest["length_mm"], "not known"),
        result(9, "its vertices", longest["vertices"], str(PAPER_PARTICLES)),
        result(9, "share of the tetrahedra tested in a step, most", share, f"below {PAPER_SHARE}", share < PAPER_SHARE),
        result(9, f"the same with about {PAPER_PARTICLES} vertices", short["cells_tested_share"], f"below {PAPER_SHARE}",
               short["cells_tested_share"] < PAPER_SHARE),
        result(9, "every visit counted, most", visits, "not known"),
        result(9, "orientation tests in a step, most", max(row["orientation_tests"] for row in rows), "not known"),
    ]
    sentence = (f"Figure 9 {'holds' if share < PAPER_SHARE else 'does not hold'}: growing to {longest['length_mm']:.0f} mm and "
                f"{longest['vertices']:.0f} vertices, the catheter tests at most {100 * share:.2g} % of {longest['cells']:,.0f} tetrahedra "
                f"in a step; the paper states less than 3 %. Every visit counted, swept triangles included, it is {100 * visits:.2g} %.")
    return Figure(9, rows, results, sentence)


def figure11(folder):
    figures = read_figures(folder / "fig11.json")
    rows, times = [], {}
    for name, key, kind in ENGINES:
        for size, cells in SIZES.items():
            ns = figure_of(figures, f"edges.fig11.{key}.{size}")
            times[key, size] = ns
            rows.append({"engine": name, "work": kind, "cells": cells, "ns_per_cast": ns,
                         "us_per_particle_and_step": ns * CASTS_PER_PARTICLE / 1000})
    growth = {key: times[key, "n1e6"] / times[key, "n1e3"] for _, key, _ in ENGINES}
    microseconds = max(times["ns", size] for size in SIZES) * CASTS_PER_PARTICLE / 1000
    segment = [figure_of(figures, f"edges.fig11.vs_bullet_segment.{size}") for size in SIZES]
    box = [figure_of(figures, f"edges.fig11.vs_bullet_box.{size}") for size in SIZES]
    changing = [figure_of(figures, f"edges.fig11.total_vs_bullet.{size}") for size in SIZES]
    gimpact = [figure_of(figures, f"edges.fig11.total_vs_gimpact.{size}") for size in SIZES]
    tests = figure_of(figures, "edges.fig11.orientation_tests_per_cast.casts_alone")
    eliminated = figure_of(figures, "edges.fig11.orientation_tests_per_cast")
    flat, log_n = 1.5, math.log(SIZES["n1e6"]) / math.log(SIZES["n1e3"])
    results = [
        result(11, "microseconds a particle and step, most", microseconds,
               f"{PAPER_MICROSECONDS:g} (another machine)"),
        result(11, "orientation tests a cast, casts alone", tests, f"{PAPER_TESTS:g} a particle"),
        result(11, "orientation tests a cast, bodies, 6.1", eliminated, f"{PAPER_TESTS:g} a particle"),
        result(11, "ours, 1e6 cells over 1e3", growth["ns"], "flat (1)", growth["ns"] < flat),
        result(11, "Bullet's segment test, 1e6 over 1e3", growth["bullet_ns"], f"log n ({log_n:.3g})",
               growth["bullet_ns"] >= flat),
        result(11, "Bullet's triangles in a box, 1e6 over 1e3", growth["bullet_box_ns"], "flat (1)",
               growth["bullet_box_ns"] < flat),
        result(11, "GIMPACT's triangles, walls change, 1e6 over 1e3", growth["gimpact_total_ns"], "flat (1)",
               growth["gimpact_total_ns"] < flat),
        result(11, "times faster than Bullet's segment test, least", min(segment), f"{PAPER_VS_BULLET:g}",
               min(segment) >= PAPER_VS_BULLET),
        result(11, "times faster than Bullet's triangles in a box, least", min(box), f"{PAPER_VS_BULLET:g}",
               min(box) >= PAPER_VS_BULLET),
        result(11, "times faster than Bullet, walls change, least", min(changing), f"{PAPER_VS_BULLET:g}",
               min(changing) >= PAPER_VS_BULLET),
        result(11, "times faster than GIMPACT, walls change, least", min(gimpact), f"{PAPER_VS_BULLET:g}",
               min(gimpact) >= PAPER_VS_BULLET),
    ]
    holds = growth["ns"] < flat and min(segment) >= PAPER_VS_BULLET
    against_box = "also" if min(box) >= PAPER_VS_BULLET else "not"
    sentence = (f"Figure 11 {'holds' if holds else 'does not hold'} against Bullet's segment test, {against_box} against its triangle/box test: "
                f"from 1e3 to 1e6 cells our time grows by {100 * (growth['ns'] - 1):.0f} %, that of the segment test by "
                f"{100 * (growth['bullet_ns'] - 1):.0f} %; we are {min(segment):.2g} to {max(segment):.2g} times faster than that, "
                f"{min(box):.2g} to {max(box):.2g} times than the triangle/box test (the paper: 3).")
    return Figure(11, rows, results, sentence)


def figure12(folder):
    figures = read_figures(folder / "fig12.json")
    rows = [{"elimination": "particles alone", "ns_per_vertex_and_step": figure_of(figures, "edges.fig12.ns.points"),
             "over_particles_alone": 1.0, "stated": 1.0, "skipped_share": None}]
    for name, key, overhead, stated in ELIMINATIONS:
        skipped = figures.get(f"edges.fig12.skipped_share.{key}", 0.0)
        rows.append({"elimination": name, "ns_per_vertex_and_step": figure_of(figures, f"edges.fig12.ns.{key}"),
                     "over_particles_alone": figure_of(figures, f"edges.fig12.{overhead}"), "stated": stated,
                     "skipped_share": float(skipped)})
    ratio = {row["elimination"]: row["over_particles_alone"] for row in rows}
    missed = figure_of(figures, "edges.fig12.hybrid_missed_share")
    not_free = figure_of(figures, "edges.fig12.hybrid_not_free_after")
    hybrid, none = ratio["hybrid"], ratio["none"]
    results = [
        result(12, "vertices of the surface", figure_of(figures, "edges.fig12.vertices"), "12000"),
        result(12, "edges over particles alone, no elimination", none, f"{PAPER_OVERHEAD:g}", none <= PAPER_OVERHEAD),
        result(12, "by environment", ratio["by environment"], "not known"),
        result(12, "by motion", ratio["by motion"], "not known"),
        result(12, "hybrid", hybrid, f"{PAPER_OVERHEAD_HYBRID:g}", hybrid <= PAPER_OVERHEAD_HYBRID),
        result(12, "hybrid, cubes twice as large", figure_of(figures, "edges.fig12.coarse.overhead_hybrid"),
               f"{PAPER_OVERHEAD_HYBRID:g}"),
        result(12, "contacts that elimination by motion misses, share", missed, "not known"),
        result(12, "edges not free after a step", not_free, "not known"),
    ]
    sentence = (f"Figure 12 {'holds' if none <= PAPER_OVERHEAD and hybrid <= PAPER_OVERHEAD_HYBRID else 'does not hold in full'}: "
                f"edges cost {none:.2g} times the particles alone (the paper: 9), {hybrid:.2g} times with the hybrid elimination "
                f"(the paper: 3); elimination by motion misses {100 * missed:.2g} % of the contacts here.")
    return Figure(12, rows, results, sentence)


FIGURES = {"9": figure9, "11": figure11, "12": figure12}


def write_tables(folder, figures):
    for figure in figures:
        write_rows(folder / f"figure{figure.number}.csv", figure.rows)
    write_rows(folder / "results.csv", [row for figure in figures for row in figure.results])


def print_tables(figures):
    for figure in figures:
        print(f"\nfigure {figure.number}{'':<46}{'ours':>10} | {'paper':<22} holds")
        for row in figure.results:
            print(f"  {row['quantity']:<52}{row['ours']:>10.4g} | {row['paper']:<22} {row['holds']}".rstrip())
        print(figure.sentence)


def main(arguments):
    if len(arguments) < 2 or not set(arguments[1:]) <= set(FIGURES):
        print(__doc__.strip().splitlines()[2], file=sys.stderr)
        return 2
    folder = Path(arguments[0])
    try:
        figures = [FIGURES[name](folder) for name in arguments[1:]]
    except (OSError, ValueError, Missing) as error:
        print(f"results: {error}", file=sys.stderr)
        return 2
    write_tables(folder, figures)
    print_tables(figures)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
