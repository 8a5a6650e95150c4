"""Makes the report from what the measuring programs wrote: make_report.py FOLDER [--command TEXT] [--quick] [--skipped SENTENCE]

FOLDER holds the CSV, TXT and JSON files; report.html, report.json and an SVG file for each chart are put beside them.
Exit code 1: a bar is not met (the page says which); 2: a file can't be used."""
import argparse
import datetime
import json
import sys
from pathlib import Path

import bars
import catalogue
import contacts
import dials
import machine
import page
import read
from draw import draw_curve
from draw_stability import draw_lines, draw_map
from svg import to_svg


def save(folder, name, svg):
    (folder / f"{name}.svg").write_text(svg, encoding="utf-8")
    return svg


def make(folder, command, quick, skipped):
    """Writes the page and what belongs to it; returns the bars."""
    curves = sorted(read.read_curves(folder), key=lambda curve: catalogue.order(curve.name))
    grid, extremes, summary = read.read_stability(folder)
    left_out, sizes = read.read_left_out(folder)
    pairs, pair_figures = read.read_exact_pairs(folder)
    without = len(dials.without_curve(dials.find(), catalogue.CURVES))
    touching = contacts.read(folder)
    found = bars.check(curves, grid, extremes, summary, pairs, without, touching, quick)
    unmeasured = sorted({dial.what for dial in dials.read() if dial.kind == "curve"} - {curve.name for curve in curves})
    if unmeasured:
        skipped = [*skipped, f"Curves that were not measured: {', '.join(unmeasured)}."]

    described = []
    for curve in curves:
        title = catalogue.title_of(curve.name)
        svg = to_svg(*draw_curve(curve), title)
        described.append(page.describe_curve(curve, save(folder, curve.name, svg)))
    maps = []
    for name, draw in (("stability_map", draw_map), ("stability_lines", draw_lines)):
        svg = save(folder, name, to_svg(draw(grid), {}, name.replace("_", " ")))
        maps.append(page.chart(svg, name, name.replace("_", " "), folder / "stability.csv"))

    def link(name):
        return page.data_link((folder / name).read_text(encoding="utf-8"), "text/csv") if (folder / name).exists() else ""

    root = Path(__file__).resolve().parents[2]
    html = page.render(curves=described, dials=page.describe_dials({curve.name for curve in curves}), bars=found, machine=machine.describe(root), command=command, quick=quick, skipped=skipped,
                       date=datetime.date.today().isoformat(), summary=summary, stability_map=maps[0], stability_lines=maps[1], extremes=extremes,
                       contacts=contacts.limits(touching), contact_rows=len(touching), contacts_link=link("contact_stability.csv"),
                       extremes_link=link("extremes.csv"), left_out=left_out, sizes=sizes, left_out_link=link("left_out.csv"),
                       pairs=pairs, pairs_link=link("exact_pairs.csv"))
    (folder / "report.html").write_text(html, encoding="utf-8")
    figures = {bar.key: bar.value for bar in found}
    figures.update((f"stability.{name}", value) for name, value in summary.items() if f"stability.{name}" not in figures)
    figures.update(pair_figures)
    (folder / "report.json").write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    return found


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Makes the report from what the measuring programs wrote.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--command", default="examples/report.sh", help="the command that the page names")
    parser.add_argument("--quick", action="store_true", help="the page says that runs were short")
    parser.add_argument("--skipped", action="append", default=[], help="a sentence on what could not be measured")
    options = parser.parse_args(arguments)
    try:
        found = make(options.folder, options.command, options.quick, options.skipped)
    except read.BadFile as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    for bar in found:
        print(f"  {bar.key:34} {page.short(bar.value):>8}   {bar.bar}{'' if bar.met else '   NOT MET'}")
    return 0 if all(bar.met for bar in found) else 1


if __name__ == "__main__":
    sys.exit(main())
