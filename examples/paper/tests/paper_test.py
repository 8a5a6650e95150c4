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
    """What the benchmark writes: a segment test that grows, everything else flat."""
    figures = {}
    for i, size in enumerate(results.SIZES):
        for _, key, _ in results.ENGINES:
            figures[f"edges.fig11.{key}.{size}"] = 30.0 if key == "ns" else 120.0 + 40 * i * (key == "bullet_ns")
        for key in ("vs_bullet_segment", "vs_bullet_box", "total_vs_bullet", "total_vs_gimpact"):
            figures[f"edges.fig11.{key}.{size}"] = 4.0 - (key == "vs_bullet_box") * 1.5
    figures["edges.fig11.orientation_tests_per_cast"] = 5.0
    figures["edges.fig11.orientation_tests_per_cast.casts_alone"] = 9.0
    figures["edges.fig12.ns.points"] = 40.0
    for _, key, overhead, _ in results.ELIMINATIONS:
        figures[f"edges.fig12.ns.{key}"] = 160.0
        figures[f"edges.fig12.{overhead}"] = 4.0
    for key in ("vertices", "coarse.overhead_hybrid", "hybrid_missed_share", "hybrid_not_free_after"):
        figures[f"edges.fig12.{key}"] = 1.0
    return figures


def made_catheter():
    return [{"length_mm": 2.5 * i, "vertices": i, "cells": 200000, "cells_tested": 30 * i, "cells_tested_share": 1.5e-4 * i,
             "cell_visits_share": 4e-4 * i, "orientation_tests": 40 * i} for i in range(1, 31)]


class PaperTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        results.write_rows(self.folder / "catheter_length.csv", made_catheter())
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
        code, out, _ = self.run_main("9", "11", "12")
        self.assertEqual(code, 0)
        for sentence in ("Figure 9 holds", "Figure 11 holds against Bullet's segment test, not against", "Figure 12 does not hold in full"):
            self.assertIn(sentence, out)
        for name, count in (("figure9", 30), ("figure11", 28), ("figure12", 5), ("results", 26)):
            with open(self.folder / f"{name}.csv", newline="") as file:
                rows = list(csv.reader(file))
            self.assertEqual(len(rows), count + 1, name)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])}, name)

    def test_what_holds_follows_from_the_numbers(self):
        held = {row["quantity"]: row["holds"] for row in results.figure12(self.folder).results}
        self.assertEqual(held["edges over particles alone, no elimination"], "yes")
        self.assertEqual(held["hybrid"], "no")
        self.assertEqual(held["by motion"], "")

    def test_a_figure_that_is_missing_is_named(self):
        figures = made_figures()
        del figures["edges.fig12.overhead_hybrid"]
        self.write_figures(figures)
        code, _, error = self.run_main("12")
        self.assertEqual(code, 2)
        self.assertIn("edges.fig12.overhead_hybrid", error)

    def test_an_unknown_figure_is_refused(self):
        self.assertEqual(self.run_main("10")[0], 2)

    @unittest.skipUnless(find_spec("matplotlib"), "matplotlib is not installed")
    def test_every_figure_is_drawn(self):
        import draw
        self.assertEqual(draw.main([str(self.folder), "9", "11", "12"]), 0)
        for number in (9, 11, 12):
            self.assertIn("stated in [JCD10]", (self.folder / f"figure{number}.svg").read_text())
            self.assertGreater((self.folder / f"figure{number}.png").stat().st_size, 10000)


if __name__ == "__main__":
    unittest.main()
