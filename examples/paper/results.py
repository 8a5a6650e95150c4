"""What the programs measured, beside what [JCD10] states: tables, CSV files and a sentence for each figure.

usage: results.py FOLDER FIGURE...

Reads catheter_length.csv and picture.json (figures 8 and 9), fig11.json, scene.json and fig12.json (of dartsweep_bench) in FOLDER,
writes figure8.csv and so on and results.csv there and prints the table. Needs nothing but Python.
"""
import csv
import json
import statistics
import sys
from pathlib import Path

# All that is known of the paper's figures: these are its words and numbers, not points read off its pictures.
PAPER_SHARE = 0.03  # figure 9: fewer of the tetrahedra are tested, 20 particles in 200,000 tetrahedra
PAPER_PARTICLES = 20
PAPER_BODIES, PAPER_STEPS = 225, 1000  # figures 10 and 11: hexahedra of 8 particles
PAPER_MILLISECONDS = 10.0  # figure 11: a step, one core of a Core 2 at 2.4 GHz
PAPER_MICROSECONDS = 5.0  # figure 11: a particle and step
PAPER_TESTS = 7.0  # 7.1: orientation tests of a particle that is cast
PAPER_VS_BULLET = 3.0  # figure 11: times faster than the others
PAPER_OVERHEAD = 9.0  # figure 12: edges over particles alone
PAPER_OVERHEAD_HYBRID = 3.0
PAPER_BACK_SHARE = 0.5  # 6.2: of the particles can be pruned, most of the time
PAPER_PAYS_FROM = 0.25  # 6.2: of the particles that move inwards

SIZES = {"n1e3": 10**3, "n1e4": 10**4, "n1e5": 10**5, "n1e6": 10**6}
CASTS_PER_PARTICLE = 4  # its own move and three edges
RELEASE = 5  # figure 9: a step that moves a particle so many times farther than usual
WINDOW = 10  # steps on each side, whose median is what is usual
RISE = 1.2  # a spike: so many times what is usual
# Name in the figure, key of the time of a cast, what it is.
ENGINES = [("ours", "ns", "casts"), ("Bullet, segment", "bullet_ns", "casts"),
           ("Bullet, triangles in a box", "bullet_box_ns", "casts"),
           ("GIMPACT, triangles", "gimpact_ns", "casts"), ("GIMPACT, boxes of triangles", "gimpact_box_ns", "casts"),
           ("Embree", "embree_ns", "casts"), ("uniform grid", "grid_ns", "casts"),
           ("ours, walls change", "total_ns", "changes"), ("ours, bodies, walls change", "body_total_ns", "changes"),
           ("Bullet, walls change", "bullet_total_ns", "changes"),
           ("GIMPACT, walls change", "gimpact_total_ns", "changes"), ("Embree, walls change", "embree_total_ns", "changes"),
           ("uniform grid, walls change", "grid_total_ns", "changes")]
# Name in the figure, key of the benchmark, the paper's ratio.
ELIMINATIONS = [("none", "edges", "overhead", PAPER_OVERHEAD),
                ("by environment", "edges_environment", "overhead_environment", None),
                ("back edges", "edges_back_edge", "overhead_back_edge", None),
                ("hybrid", "edges_hybrid", "overhead_hybrid", PAPER_OVERHEAD_HYBRID),
                ("back edges, left", "edges_paper_62", "paper_62", None),
                ("hybrid, left", "edges_paper_63", "paper_63", PAPER_OVERHEAD_HYBRID),
                ("similar motion (ours)", "edges_similar_motion", "overhead_similar_motion", None)]


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


def verdict(results):
    """In words: whether every statement of the paper that was compared holds, and which do not."""
    failing = [row["quantity"] for row in results if row["holds"] == "no"]
    return "holds" if not failing else "does not hold in: " + "; ".join(failing)


class Figure:
    """Rows for its CSV file, results, and one sentence: does it hold?"""

    def __init__(self, number, rows, results, sentence):
        self.number, self.rows, self.results, self.sentence = number, rows, results, sentence


def read_pushes(folder):
    """Rows of catheter_length.csv by push, each with what is usual around it."""
    rows = read_rows(folder / "catheter_length.csv")
    needed = {"push", "length_mm", "vertices", "cells", "displacement_mm", "cells_tested", "cells_tested_share", "cell_visits",
              "cell_visits_share", "orientation_tests"}
    if not needed <= set(rows[0]):
        raise Missing(f"catheter_length.csv lacks {', '.join(sorted(needed - set(rows[0])))}")
    pushes = {}
    for row in rows:
        pushes.setdefault(row["push"], []).append(row)
    for push in pushes.values():
        for i, row in enumerate(push):
            around = push[max(0, i - WINDOW):i + WINDOW + 1]
            for name in ("displacement_mm", "cells_tested", "cell_visits"):
                usual = statistics.median(other[name] for other in around)
                row[f"{name}_over_usual"] = row[name] / usual if usual > 0 else 1.0
    return pushes


def releases_of(push):
    """Steps in which stress is released: they move a particle much farther than the steps around them."""
    return [row for row in push if row["displacement_mm_over_usual"] >= RELEASE]


def figure8(folder):
    with open(folder / "picture.json") as file:
        picture = json.load(file)
    rows = [{"particle": i, "x_mm": x, "y_mm": y, "z_mm": z} for i, (x, y, z) in enumerate(picture["catheter"])]
    cells, particles = float(picture["cells"]), len(rows)
    results = [
        result(8, "tetrahedra in the mesh", cells, "about 200000", abs(cells / 200000 - 1) < 0.25),
        result(8, "particles of the catheter", particles, str(PAPER_PARTICLES), particles == PAPER_PARTICLES),
        result(8, "triangles of the vessels' wall", len(picture["triangles"]) // 3, "not known"),
    ]
    return Figure(8, rows, results, f"Figure 8: a catheter of {particles} particles in a vascular network of {cells:,.0f} tetrahedra.")


def figure9(folder):
    pushes = read_pushes(folder)
    rows = [row for push in pushes.values() for row in push]
    share = max(row["cells_tested_share"] for row in rows)
    visits = max(row["cell_visits_share"] for row in rows)
    vertices = {row["vertices"] for row in rows}
    results = [
        result(9, "tetrahedra in the mesh", rows[0]["cells"], "about 200000"),
        result(9, "particles, in every step", max(vertices), str(PAPER_PARTICLES), vertices == {PAPER_PARTICLES}),
        result(9, "share of the tetrahedra tested in a step, most", share, f"below {PAPER_SHARE}", share < PAPER_SHARE),
        result(9, "every visit counted, most", visits, "not known"),
        result(9, "orientation tests in a step, most", max(row["orientation_tests"] for row in rows), "not known"),
    ]
    said = []
    for name, push in pushes.items():
        half = len(push) // 2
        grows = statistics.mean(row["cells_tested"] for row in push[half:]) > statistics.mean(row["cells_tested"] for row in push[:half])
        releases = releases_of(push)
        rise = max((row["cells_tested_over_usual"] for row in releases), default=1.0)
        visit_rise = max((row["cell_visits_over_usual"] for row in releases), default=1.0)
        results += [
            result(9, f"{name}: length of the catheter at the end, mm", push[-1]["length_mm"], "not known"),
            result(9, f"{name}: tests grow with the length", float(grows), "yes", grows),
            result(9, f"{name}: steps that release stress", len(releases), "some", bool(releases)),
            result(9, f"{name}: different tetrahedra then, over usual, most", rise, "a spike", rise >= RISE),
            result(9, f"{name}: every visit then, over usual, most", visit_rise, "a spike", visit_rise >= RISE),
        ]
        spikes = "no spike" if max(rise, visit_rise) < RISE else (
            f"a spike of {visit_rise:.2g} times the usual visits, {rise:.2g} times the usual different tetrahedra")
        said.append(f"where it {name}, {len(releases)} of {len(push)} steps release stress, with {spikes}")
    sentence = (f"Figure 9 {verdict(results)}. Its edges stretched until the catheter is "
                f"{max(row['length_mm'] for row in rows):.0f} mm long, its {max(vertices):.0f} particles test at most {100 * share:.2g} % of "
                f"{rows[0]['cells']:,.0f} tetrahedra in a step; the paper states less than 3 %. The paper's spikes: {'; '.join(said)}.")
    return Figure(9, rows, results, sentence)


def figure10(folder):
    with open(folder / "scene.json") as file:
        scene = json.load(file)
    rows = [{"cells": lattice["size"][0] * lattice["size"][1] * lattice["size"][2], "x": lattice["size"][0], "y": lattice["size"][1],
             "z": lattice["size"][2], "obstacles": lattice["obstacles"]} for lattice in scene["lattices"]]
    bodies = len(scene["bodies"])
    results = [
        result(10, "hexahedra that move", bodies, str(PAPER_BODIES), bodies == PAPER_BODIES),
        result(10, "particles of each", len(scene["bodies"][0]), "8", len(scene["bodies"][0]) == 8),
    ] + [result(10, f"fixed obstacles among {row['cells']:,} cells", row["obstacles"], "some", row["obstacles"] > 0) for row in rows]
    return Figure(10, rows, results, f"Figure 10: lattices of {rows[0]['cells']:,} to {rows[-1]['cells']:,} hexahedra, cells being added around; "
                  f"{bodies} deformable hexahedra are spread over all of it.")


def figure11(folder):
    figures = read_figures(folder / "fig11.json")
    rows, times = [], {}
    for name, key, kind in ENGINES:
        for size, cells in SIZES.items():
            ns = figure_of(figures, f"edges.fig11.{key}.{size}")
            times[key, size] = ns
            rows.append({"engine": name, "work": kind, "cells": cells, "ns_per_cast": ns,
                         "us_per_particle_and_step": ns * CASTS_PER_PARTICLE / 1000})
    small, large = list(SIZES)[0], list(SIZES)[-1]
    growth = {key: times[key, large] / times[key, small] for _, key, _ in ENGINES}
    least = {key: min(figure_of(figures, f"edges.fig11.{key}.{size}") for size in SIZES)
             for key in ("vs_bullet_segment", "vs_bullet_box", "vs_gimpact", "vs_gimpact_box", "vs_embree", "vs_grid",
                         "total_vs_bullet", "total_vs_gimpact", "total_vs_embree", "total_vs_grid")}
    bodies, steps = figure_of(figures, "edges.fig11.bodies"), figure_of(figures, "edges.fig11.steps")
    milliseconds = max(figure_of(figures, f"edges.fig11.ms_per_step.{size}") for size in SIZES)
    tests = figure_of(figures, "edges.fig11.orientation_tests_per_cast")
    ours_grows = figure_of(figures, "edges.fig11.flatness")
    cells_grow = (figure_of(figures, f"edges.fig11.cells_per_cast.{large}") / figure_of(figures, f"edges.fig11.cells_per_cast.{small}"))
    flat = 1.4

    def faster(quantity, key):
        return result(11, f"times faster than {quantity}, least", least[key], f"{PAPER_VS_BULLET:g}", least[key] >= PAPER_VS_BULLET)

    results = [
        result(11, "deformable hexahedra, shape matching", bodies, str(PAPER_BODIES), bodies == PAPER_BODIES),
        result(11, "time steps", steps, str(PAPER_STEPS), steps == PAPER_STEPS),
        result(11, "ms for a step, walls change, most", milliseconds, f"{PAPER_MILLISECONDS:g} (Core 2)", milliseconds <= PAPER_MILLISECONDS),
        result(11, "us for a particle and step, walls change, most",
               max(times["total_ns", size] for size in SIZES) * CASTS_PER_PARTICLE / 1000, f"{PAPER_MICROSECONDS:g} (Core 2)",
               max(times["total_ns", size] for size in SIZES) * CASTS_PER_PARTICLE / 1000 <= PAPER_MICROSECONDS),
        result(11, "orientation tests of a cast, no elimination", tests, f"{PAPER_TESTS:g}", tests <= PAPER_TESTS),
        result(11, "our time at 1e6 cells over 1e3, walls change", ours_grows, "flat", ours_grows <= flat),
        result(11, "cells that our casts enter at 1e6 over 1e3", cells_grow, "flat", cells_grow <= flat),
        result(11, "Bullet's segment test at 1e6 over 1e3", growth["bullet_ns"], "grows as log n", growth["bullet_ns"] > flat),
        result(11, "GIMPACT's triangles at 1e6 over 1e3", growth["gimpact_ns"], "flat", growth["gimpact_ns"] <= flat),
        faster("Bullet, segments", "vs_bullet_segment"),
        faster("GIMPACT, triangles", "vs_gimpact"),
        faster("Bullet, walls change", "total_vs_bullet"),
        faster("GIMPACT, walls change", "total_vs_gimpact"),
    ]
    results += [result(11, f"times faster than {name}, least", least[key], "not in the paper")
                for name, key in (("Bullet, triangles in a box", "vs_bullet_box"), ("GIMPACT, boxes of triangles", "vs_gimpact_box"),
                                  ("Embree", "vs_embree"), ("a uniform grid", "vs_grid"), ("Embree, walls change", "total_vs_embree"),
                                  ("a uniform grid, walls change", "total_vs_grid"))]
    slower = [name for name, key in (("Bullet, triangles in a box", "vs_bullet_box"), ("GIMPACT, boxes of triangles", "vs_gimpact_box"),
                                     ("Embree", "vs_embree"), ("a uniform grid", "vs_grid")) if least[key] < 1]
    sentence = (f"Figure 11 {verdict(results)}. Least over all sizes, we are "
                f"{least['vs_bullet_segment']:.2g} times faster than Bullet's segment test and {least['vs_gimpact']:.2g} times than GIMPACT "
                f"(the paper: 3); from 1e3 to 1e6 cells our time changes by {100 * (ours_grows - 1):+.0f} %, that of the segment test "
                f"by {100 * (growth['bullet_ns'] - 1):+.0f} %, that of GIMPACT by {100 * (growth['gimpact_ns'] - 1):+.0f} %. "
                f"Faster than we are: {', '.join(slower) if slower else 'none of the peers'}.")
    return Figure(11, rows, results, sentence)


def figure12(folder):
    figures = read_figures(folder / "fig12.json")
    rows = [{"elimination": "particles alone", "ns_per_vertex_and_step": figure_of(figures, "edges.fig12.ns.points"),
             "over_particles_alone": 1.0, "stated": 1.0, "skipped_share": None}]
    for name, key, overhead, stated in ELIMINATIONS:
        skipped = figures.get(f"edges.fig12.skipped_share.{key.removeprefix('edges_')}", 0.0)
        rows.append({"elimination": name, "ns_per_vertex_and_step": figure_of(figures, f"edges.fig12.ns.{key}"),
                     "over_particles_alone": figure_of(figures, f"edges.fig12.{overhead}"), "stated": stated,
                     "skipped_share": float(skipped)})
    ratio = {row["elimination"]: row["over_particles_alone"] for row in rows}
    missed = figure_of(figures, "edges.fig12.back_edge_missed_share")
    not_free = sum(figure_of(figures, f"edges.fig12.{name}_not_free_after") for name in ("back_edge", "hybrid", "similar_motion"))
    hybrid, none, back = ratio["hybrid"], ratio["none"], ratio["back edges"]
    share = {row["elimination"]: row["skipped_share"] for row in rows}["back edges"]
    pays = share < PAPER_PAYS_FROM or back < none
    results = [
        result(12, "vertices of the surface", figure_of(figures, "edges.fig12.vertices"), "12000"),
        result(12, "edges over particles alone, edges inside of a cell cast too", figure_of(figures, "edges.fig12.none"), f"{PAPER_OVERHEAD:g}",
               figure_of(figures, "edges.fig12.none") <= PAPER_OVERHEAD),
        result(12, "edges over particles alone, no flag", none, f"{PAPER_OVERHEAD:g}", none <= PAPER_OVERHEAD),
        result(12, "by environment", ratio["by environment"], "not known"),
        result(12, "back edges", back, "not known"),
        result(12, "back edges left out, share of the tests", share, f"about {PAPER_BACK_SHARE:g}", abs(share - PAPER_BACK_SHARE) <= 0.1),
        result(12, "back edges, over no elimination", back / none, "< 1", pays),
        result(12, "hybrid", hybrid, f"{PAPER_OVERHEAD_HYBRID:g}", hybrid <= PAPER_OVERHEAD_HYBRID),
        result(12, "back edges left untested", ratio["back edges, left"], "not known"),
        result(12, "hybrid, back edges left untested", ratio["hybrid, left"], f"{PAPER_OVERHEAD_HYBRID:g}", ratio["hybrid, left"] <= PAPER_OVERHEAD_HYBRID),
        result(12, "hybrid, cubes twice as large", figure_of(figures, "edges.fig12.coarse.overhead_hybrid"),
               f"{PAPER_OVERHEAD_HYBRID:g}"),
        result(12, "similar motion (ours)", ratio["similar motion (ours)"], "not in the paper"),
        result(12, "contacts that back edges miss, share", missed, "not known"),
        result(12, "edges not free after a step", not_free, "not known"),
    ]
    sentence = (f"Figure 12 {verdict(results)}. "
                f"Edges cost {none:.2g} times the particles alone (the paper: 9), {hybrid:.2g} times with the hybrid elimination "
                f"and {ratio['hybrid, left']:.2g} times if edges that go inwards are left untested (the paper: 3). "
                f"Back edges leave out {100 * share:.0f} % of the tests (the paper: about half) and take {back / none:.2g} of the "
                f"time without elimination; they miss {100 * missed:.2g} % of the contacts here. Unless it is left, what is left out is cast once where the "
                "edge arrives, so that the body is exactly free after every move, which the paper does not ask for.")
    return Figure(12, rows, results, sentence)


FIGURES = {"8": figure8, "9": figure9, "10": figure10, "11": figure11, "12": figure12}


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
