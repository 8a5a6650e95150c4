"""Tests of results.py and, where matplotlib is installed, of draw.py: on made figures, nothing is measured."""
import csv
import io
import json
import sys
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout
from importlib.util import find_spec
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import results


def made_figures():
    """What the benchmark writes: a segment test that grows, everything else flat, a grid that is faster."""
    figures = {}
    for i, size in enumerate(results.SIZES):
        for _, key, _ in results.ENGINES:
            figures[f"edges.fig11.{key}.{size}"] = 30.0 if key in ("ns", "total_ns") else 120.0 + 40 * i * (key == "bullet_ns")
        for key in ("vs_bullet_segment", "vs_bullet_box", "vs_gimpact", "vs_gimpact_box", "vs_embree", "vs_grid", "total_vs_bullet",
                    "total_vs_gimpact", "total_vs_embree", "total_vs_grid"):
            figures[f"edges.fig11.{key}.{size}"] = 0.8 if key == "vs_grid" else 4.0
        figures[f"edges.fig11.ms_per_step.{size}"] = 0.3
        figures[f"edges.fig11.cells_per_cast.{size}"] = 1.6
    figures["edges.fig11.flatness"] = 1.1
    figures["edges.fig11.bodies"], figures["edges.fig11.steps"] = 225, 1000
    figures["edges.fig11.orientation_tests_per_cast"] = 5.0
    figures["edges.fig12.ns.points"] = 40.0
    for _, key, overhead, _ in results.ELIMINATIONS:
        figures[f"edges.fig12.ns.{key}"] = 160.0
        figures[f"edges.fig12.{overhead}"] = 4.0
    for key in ("vertices", "none", "coarse.overhead_hybrid", "back_edge_missed_share", "back_edge_not_free_after", "hybrid_not_free_after",
                "similar_motion_not_free_after"):
        figures[f"edges.fig12.{key}"] = 1.0
    return figures


def made_catheter():
    """Two pushes; in step 30 of the first one a particle jumps, and the visits rise."""
    rows = []
    for push in ("catches", "slides"):
        for i in range(1, 61):
            jumps = push == "catches" and i == 30
            rows.append({"push": push, "step": i, "length_mm": 2.5 * i, "rest_length_mm": 2.5 * i, "vertices": 20, "cells": 200000,
                         "displacement_mm": 8.0 if jumps else 0.1, "cells_tested": 30 * i, "cells_tested_share": 1.5e-4 * i,
                         "cell_visits": 80 * i * (2 if jumps else 1), "cell_visits_share": 4e-4 * i * (2 if jumps else 1),
                         "orientation_tests": 40 * i})
    return rows


def made_picture():
    corners = [0, 0, 0, 9, 0, 0, 9, 1, 0, 0, 1, 0, 0, 0, 1, 9, 0, 1]
    return {"cells": 200000, "positions": corners, "triangles": [0, 1, 2, 0, 2, 3, 0, 1, 5, 0, 5, 4],
            "catheter": [[0.45 * i, 0.5, 0.2] for i in range(20)]}


def made_scene():
    body = [[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]
    sizes = ([10, 10, 10], [25, 20, 20], [50, 50, 40], [100, 100, 100])
    return {"lattices": [{"size": size, "obstacles": 50} for size in sizes], "obstacles": [3, 500], "appearing": [77],
            "bodies": [body] * 225, "bodies_at_the_end": [body] * 225}


class PaperTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        results.write_rows(self.folder / "catheter_length.csv", made_catheter())
        (self.folder / "picture.json").write_text(json.dumps(made_picture()))
        (self.folder / "scene.json").write_text(json.dumps(made_scene()))
        self.write_figures(made_figures())

    def write_figures(self, figures):
        for name in ("fig11.json", "fig12.json"):
            (self.folder / name).write_text(json.dumps(figures))

    def run_main(self, *arguments):
        out, error = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(error):
            code = results.main([str(self.folder), *arguments])
        return code, out.getvalue(), error.getvalue()

    def test_every_figure_has_a_table_a_sentence_and_well_formed_csv(self):
        code, out, _ = self.run_main("8", "9", "10", "11", "12")
        self.assertEqual(code, 0)
        for sentence in ("Figure 8: a catheter of 20 particles", "Figure 9 does not hold in: catches: different tetrahedra", "1 of 60 steps release stress", "Figure 10: lattices",
                         "Figure 11 holds", "Faster than we are: a uniform grid", "Figure 12 does not hold in: back edges left out"):
            self.assertIn(sentence, out)
        for name, count in (("figure8", 20), ("figure9", 120), ("figure10", 4), ("figure11", 52)):
            with open(self.folder / f"{name}.csv", newline="") as file:
                rows = list(csv.reader(file))
            self.assertEqual(len(rows), count + 1, name)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])}, name)

    def test_what_holds_follows_from_the_numbers(self):
        held = {row["quantity"]: row["holds"] for row in results.figure12(self.folder).results}
        self.assertEqual(held["edges over particles alone, no flag"], "yes")
        self.assertEqual(held["hybrid"], "no")
        self.assertEqual(held["similar motion (ours)"], "")
        self.assertEqual(held["back edges, over no elimination"], "yes")  # few are left out, so that need not pay

    def test_spikes_are_found_where_stress_is_released(self):
        held = {row["quantity"]: row["holds"] for row in results.figure9(self.folder).results}
        self.assertEqual(held["catches: every visit then, over usual, most"], "yes")
        self.assertEqual(held["catches: different tetrahedra then, over usual, most"], "no")
        self.assertEqual(held["slides: steps that release stress"], "no")

    def test_what_does_not_hold_in_figure_11_is_named(self):
        figures = made_figures()
        figures["edges.fig11.flatness"] = 1.6
        self.write_figures(figures)
        self.assertIn("does not hold in: our time at 1e6 cells over 1e3", results.figure11(self.folder).sentence)

    def test_a_figure_that_is_missing_is_named(self):
        figures = made_figures()
        del figures["edges.fig12.overhead_hybrid"]
        self.write_figures(figures)
        code, _, error = self.run_main("12")
        self.assertEqual(code, 2)
        self.assertIn("edges.fig12.overhead_hybrid", error)

    def test_an_unknown_figure_is_refused(self):
        self.assertEqual(self.run_main("7")[0], 2)

    @unittest.skipUnless(find_spec("matplotlib"), "matplotlib is not installed")
    def test_every_figure_is_drawn(self):
        import draw
        self.assertEqual(draw.main([str(self.folder), "8", "9", "10", "11", "12"]), 0)
        for number in (8, 9, 10, 11, 12):
            if number >= 9 and number != 10:
                self.assertIn("stated in [JCD10]", (self.folder / f"figure{number}.svg").read_text())
            self.assertGreater((self.folder / f"figure{number}.png").stat().st_size, 10000)


if __name__ == "__main__":
    unittest.main()
