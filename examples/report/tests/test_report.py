"""The report from made-up results: python3 -m unittest discover -s examples/report/tests

Skipped where the modules of requirements.txt are not installed."""
import contextlib
import html.parser
import io
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

try:
    import jinja2  # noqa: F401
    import matplotlib  # noqa: F401
except ImportError as error:
    raise unittest.SkipTest(f"{error}; examples/report/requirements.txt names what the report needs") from error

import make_report
import read
import samples
from scale import ticks_across

EMPTY = {"meta", "br", "hr", "img", "input", "link"}


class Structure(html.parser.HTMLParser):
    """Tags that do not match, ids, and everything that a browser would fetch."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.ids, self.inner, self.fetched, self.tags = [], [], [], [], [], []
        self.feed(text)
        self.faults += [f"<{tag}> is never closed" for tag in self.open]

    def handle_starttag(self, tag, attributes):
        self.handle_startendtag(tag, attributes)
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.append(tag)
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            elif name in ("href", "xlink:href", "src", "srcset", "action", "data"):
                (self.inner if value.startswith("#") else self.fetched).append(value)

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            self.faults.append(f"</{tag}> within <{self.open[-1] if self.open else ''}>, line {self.getpos()[0]}")
        else:
            self.open.pop()


def run(*arguments):
    """(exit code, what was printed) of the program."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        code = make_report.main([str(argument) for argument in arguments])
    return code, out.getvalue()


class Page(unittest.TestCase):
    """One page, looked at from several sides."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        samples.write(cls.path)
        cls.code, cls.printed = run(cls.path, "--command", "examples/report.sh --quick", "--quick", "--skipped", "No peer <X>.")
        cls.html = (cls.path / "report.html").read_text(encoding="utf-8")
        cls.structure = Structure(cls.html)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_ends_well_when_all_bars_are_met(self):
        self.assertEqual(self.code, 0, self.printed)

    def test_is_well_formed(self):
        self.assertEqual(self.structure.faults, [])
        self.assertEqual(len(self.structure.ids), len(set(self.structure.ids)), "ids are not unique")
        self.assertLessEqual({address[1:] for address in self.structure.inner}, set(self.structure.ids))

    def test_fetches_nothing(self):
        self.assertEqual([address for address in self.structure.fetched if not address.startswith("data:")], [])
        self.assertEqual(re.findall(r"@import|url\((?!#)", self.html), [])
        self.assertNotIn("script", self.structure.tags)

    def test_has_every_curve_with_its_advice_and_files(self):
        for number in range(8):
            name = f"curve_{number}"
            self.assertIn(f'<h3 id="{name}">', self.html)
            self.assertEqual(self.html.count(f"Take setting {number}: it is &lt; 1 &amp; good."), 2)
            self.assertIn(f'download="{name}.csv" href="data:text/csv', self.html)
            ElementTree.parse(self.path / f"{name}.svg")
        self.assertEqual(self.structure.tags.count("svg"), 10)

    def test_counts_its_curves_and_lists_all_dials(self):
        self.assertIn("8 curves of dials are here", self.html)
        self.assertIn("<td><code>dsw_move_options.min_part</code></td><td>Least part of an edge, not measured here</td>", self.html)
        self.assertIn("Curves that were not measured: back_edges, ", self.html)
        self.assertIn("report.dials_without_curve", self.html)

    def test_says_where_contacts_break(self):
        row = re.search(r"<tr[^>]*><td>posts</td><td>symplectic Euler</td>.*?</tr>", self.html)[0]
        self.assertIn("<td>0.01 to 1</td>", row)
        self.assertIn("stiffness or integrator (200)", row)
        figures = json.loads((self.path / "report.json").read_text(encoding="utf-8"))
        self.assertEqual((figures["stability.rows"], figures["stability.contact_broken"]), (1200, 0))

    def test_draws_every_point_and_says_what_it_is(self):
        tips = re.findall(r"<title>([^<]*)</title>", (self.path / "curve_0.svg").read_text(encoding="utf-8"))
        self.assertEqual(len([tip for tip in tips if " per sweep, " in tip]), 16)

    def test_gives_errors_of_zero_a_place(self):
        svg = (self.path / "curve_0.svg").read_text(encoding="utf-8")
        self.assertEqual(svg.count(">exactly 0</text>"), 2)
        self.assertIn("0 of 20,000 (below 0.0001 with 95 % confidence)", svg)

    def test_text_of_the_files_stays_text(self):
        self.assertIn("a, &#34;note&#34; &lt;b&gt;", self.html)
        self.assertIn("No peer &lt;X&gt;.", self.html)

    def test_has_the_table_of_moving_pairs(self):
        self.assertIn('<h2 id="exact-pairs">', self.html)
        self.assertIn("<td>FCL (Newton)</td>", self.html)
        self.assertIn('download="exact_pairs.csv" href="data:text/csv', self.html)
        figures = json.loads((self.path / "report.json").read_text(encoding="utf-8"))
        self.assertEqual((figures["pairs.wrong"], figures["pairs.queries"]), (0, 3085))

    def test_writes_the_figures_of_the_summary(self):
        figures = json.loads((self.path / "report.json").read_text(encoding="utf-8"))
        self.assertEqual(figures["report.curves"], 8)
        self.assertEqual(figures["report.curves_with_peers"], 4)
        self.assertEqual(figures["stability.implicit_max_stable_k"], 1e12)
        for key in ("report.points_least", "stability.lost", "stability.extremes_going_on"):
            self.assertIn(f"<code>{key}</code>", self.html)


class Ticks(unittest.TestCase):
    def test_are_few_and_round_however_short_the_axis_is(self):
        for lowest, highest in ((1e-7, 1e-1), (3e-6, 4e-5), (4.2e-4, 8.3e-4), (2.1e-4, 2.6e-4)):
            for most in (3, 5, 9):
                ticks = ticks_across(lowest, highest, most)
                self.assertTrue(2 <= len(ticks) <= most, (lowest, highest, ticks))
                self.assertTrue(all(lowest <= tick <= highest and float(f"{tick:.2g}") == tick for tick in ticks), ticks)


class Folder(unittest.TestCase):
    """Results that fall short, or that can't be used."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        samples.write(self.path, curves=1, peers=1)

    def edit(self, name, old, new):
        path = self.path / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, 1), encoding="utf-8")

    def refused(self, *words):
        code, printed = run(self.path)
        self.assertEqual(code, 2, printed)
        for word in words:
            self.assertIn(word, printed)

    def test_too_few_curves_fail_and_the_page_says_so(self):
        code, printed = run(self.path)
        self.assertEqual(code, 1)
        self.assertIn("NOT MET", printed)
        self.assertIn("not met", (self.path / "report.html").read_text(encoding="utf-8"))

    def test_a_broken_promise_counts_though_the_summary_hides_it(self):
        self.edit("stability.csv", "400,1000,0,0,0,0", "400,1000,0,0,0,7")
        run(self.path)
        self.assertEqual(json.loads((self.path / "report.json").read_text(encoding="utf-8"))["stability.lost"], 7)

    def test_an_answer_on_a_moving_pair_that_is_not_exact(self):
        self.edit("exact_pairs.csv", "Dartsweep,3085,248,0,0,0,0,", "Dartsweep,3085,248,1,0,0,2,")
        run(self.path)
        self.assertEqual(json.loads((self.path / "report.json").read_text(encoding="utf-8"))["pairs.wrong"], 3)

    def test_moving_pairs_may_be_absent(self):
        (self.path / "exact_pairs.csv").unlink()
        run(self.path)
        self.assertNotIn("exact-pairs", (self.path / "report.html").read_text(encoding="utf-8"))

    def test_all_errors_may_be_zero(self):
        rows = [(name, *rest[:6], 0, *rest[7:]) for name, *rest in samples.curve("curve_0", False)]
        samples.write_rows(self.path / "curve_0.csv", read.CURVE_COLUMNS, rows)
        self.assertEqual(run(self.path)[0], 1)
        self.assertIn(">exactly 0</text>", (self.path / "curve_0.svg").read_text(encoding="utf-8"))

    def test_what_explodes_does_not_stretch_the_axis(self):
        self.edit("curve_0.csv", ",0.3,,20000,\"a,", ",1e19,,20000,\"explodes,")
        self.assertEqual(run(self.path)[0], 1)
        svg = (self.path / "curve_0.svg").read_text(encoding="utf-8")
        self.assertIn(">explodes</text>", svg)
        self.assertNotIn(">10¹", svg)

    def test_a_dial_that_costs_nothing_is_drawn_against_its_setting(self):
        rows = [("omega", "dartsweep dial", setting, "weight", 1e-4, "step", "rotation", 1 + setting, "degrees", 9, "")
                for setting in (0, 0.5, 1, 7)]
        samples.write_rows(self.path / "omega.csv", read.CURVE_COLUMNS, rows)
        (self.path / "omega.txt").write_text("Take 0.", encoding="utf-8")
        self.assertEqual(run(self.path)[0], 1)
        svg = (self.path / "omega.svg").read_text(encoding="utf-8")
        self.assertIn(">weight</text>", svg)
        self.assertNotIn("run time per step", svg)

    def test_a_heading_that_is_not_agreed_on(self):
        self.edit("curve_0.csv", "seconds_per_item", "time")
        self.refused("curve_0.csv:1:", "the heading must be curve,method,")

    def test_an_error_that_is_no_number(self):
        self.edit("curve_0.csv", ",0.3,,", ",nan,,")
        self.refused("curve_0.csv:2:", "error must be a finite number of at least 0, not 'nan'")

    def test_a_time_of_zero(self):
        self.edit("curve_0.csv", ",2e-07,", ",0,")
        self.refused("curve_0.csv:2:", "seconds_per_item must be a finite number above 0")

    def test_a_row_that_is_too_short(self):
        self.edit("curve_0.csv", ',"a, ""note"" <b>"', "")
        self.refused("curve_0.csv:2:", "10 values under 11 columns")

    def test_a_curve_under_another_name(self):
        self.edit("curve_0.csv", "\ncurve_0,", "\ncurve_9,")
        self.refused("curve is 'curve_9' in the file of 'curve_0'")

    def test_a_curve_without_advice(self):
        (self.path / "curve_0.txt").unlink()
        self.refused("curve_0.txt", "which setting to pick")

    def test_files_that_are_absent_or_empty(self):
        (self.path / "extremes.csv").write_text("", encoding="utf-8")
        self.refused("extremes.csv", "empty")
        (self.path / "extremes.csv").unlink()
        self.refused("extremes.csv", "No such file")
        (self.path / "curve_0.csv").unlink()
        self.refused("no curves")


if __name__ == "__main__":
    unittest.main()
