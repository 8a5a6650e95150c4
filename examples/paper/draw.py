"""Draws figures 9, 11 and 12 of [JCD10] as we measure them, with what the paper states in the same axes.

usage: draw.py FOLDER FIGURE...

Reads what results.py reads, writes figure9.svg and .png, and so on. The paper's own pictures are not copied and no point is
read off them: dashed lines and hatched bars are numbers in its text, and a caption says what is not known.
"""
import sys
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

import results

# Okabe and Ito's colours, told apart by all kinds of colour vision; marks and dashes say the same again.
INK, SOFT, BLUE, ORANGE, GREEN, PURPLE, SKY = "#222222", "#666666", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9"
STATED = {"color": INK, "linestyle": (0, (5, 3)), "linewidth": 1.4}

plt.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "dartsweep", "font.size": 10, "axes.titlesize": 10.5, "axes.titlelocation": "left",
    "axes.titleweight": "bold", "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True, "axes.grid": True,
    "grid.color": "#e4e4e4", "axes.edgecolor": SOFT, "xtick.color": SOFT, "ytick.color": SOFT, "axes.labelcolor": INK,
    "legend.frameon": False, "legend.fontsize": 9, "lines.linewidth": 1.8, "lines.markersize": 6, "savefig.facecolor": "white",
})


def finish(figure, folder, number, sentence, caption):
    """The sentence and the caption below the axes, and both files."""
    figure.tight_layout()
    width, height = figure.get_size_inches()
    text = "\n".join(textwrap.wrap(sentence, int(13.5 * width))) + "\n\n" + "\n".join(textwrap.wrap(caption, int(15.5 * width)))
    figure.text(0.012, -0.02, text.split("\n\n")[0], va="top", fontsize=10, color=INK, weight="bold")
    lines = text.split("\n\n")[0].count("\n") + 1
    figure.text(0.012, -0.02 - (0.24 + 0.185 * (lines - 1)) / height, text.split("\n\n")[1], va="top", fontsize=8.5, color=SOFT)
    for kind in ("svg", "png"):
        figure.savefig(folder / f"figure{number}.{kind}", dpi=150, bbox_inches="tight", pad_inches=0.15,
                       metadata={"Date": None} if kind == "svg" else None)
    plt.close(figure)


def draw9(folder, data):
    rows = data.rows
    length = [row["length_mm"] for row in rows]
    figure, axes = plt.subplots(figsize=(8, 4.6))
    axes.plot(length, [row["cells_tested_share"] for row in rows], color=BLUE, marker="o", markersize=3.5,
              label="ours: different tetrahedra")
    axes.plot(length, [row["cell_visits_share"] for row in rows], color=SKY, linestyle=(0, (1, 1)), marker="s", markersize=3,
              label="ours: every visit counted, of the whole swept triangles")
    axes.axhline(results.PAPER_SHARE, **STATED, label="stated in [JCD10]: below 3 %")
    twenty = [row["length_mm"] for row in rows if row["vertices"] >= results.PAPER_PARTICLES]
    if twenty:
        axes.axvline(twenty[0], color=SOFT, linewidth=1, linestyle=":")
        axes.text(twenty[0], 0.04, f" {results.PAPER_PARTICLES} vertices, as many as the paper's catheter has", color=SOFT, fontsize=8.5)
    axes.set_yscale("log")
    axes.set_ylim(1e-5, 0.1)
    axes.set_xlim(0, None)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{100 * y:g} %"))
    axes.set_xlabel("length of the catheter in the vessel (mm)")
    axes.set_ylabel("tetrahedra tested in a step,\nshare of all (worst step)")
    axes.set_title(f"Figure 9: a catheter in a vessel of {rows[-1]['cells']:,.0f} tetrahedra")
    axes.legend(loc="lower right")
    finish(figure, folder, 9, data.sentence,
           "Known of the paper's figure: a catheter of 20 particles in 200,000 tetrahedra tests fewer than 3 % of them. Its curve, the length of "
           "its catheter and its mesh are not known. Ours gets vertices where it bends round the wall; counted are the cells that the casts "
           "of [JCD10] 4.1 enter, worst step between two points.")


def curve(axes, rows, engine, **style):
    chosen = [row for row in rows if row["engine"] == engine]
    axes.plot([row["cells"] for row in chosen], [row["us_per_particle_and_step"] for row in chosen], label=engine, **style)
    return chosen


def cells_axis(axes):
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(list(results.SIZES.values())))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("cells of the lattice, n")


def draw11(folder, data):
    rows = data.rows
    figure, (times, ratios) = plt.subplots(1, 2, figsize=(11, 4.8))
    curve(times, rows, "ours", color=BLUE, marker="o", linewidth=2.4)
    segment = curve(times, rows, "Bullet, segment", color=ORANGE, marker="^")
    curve(times, rows, "Bullet, triangles in a box", color=GREEN, marker="s")
    curve(times, rows, "ours, walls change", color=SKY, marker="o", linestyle=(0, (4, 2)))
    curve(times, rows, "GIMPACT, triangles, walls change", color=PURPLE, marker="D", linestyle=(0, (4, 2)))
    first = segment[0]["us_per_particle_and_step"] / len(str(segment[0]["cells"] // 10))
    times.plot([row["cells"] for row in segment], [first * len(str(row["cells"] // 10)) for row in segment], color=SOFT, linewidth=1,
               linestyle=":", label="shape stated for the segment test: log n\n(scaled to its first point)")
    times.axhline(results.PAPER_MICROSECONDS, **STATED, label="stated for the paper's method: 5 µs, flat\n(Core 2, 2.4 GHz)")
    cells_axis(times)
    times.set_yscale("log")
    times.set_ylabel("time for a particle and step (µs)")
    times.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:g}"))
    times.set_ylim(None, 12)
    times.set_title("Figure 11: time against n")

    by_engine = {}
    for row in rows:
        by_engine.setdefault(row["engine"], []).append(row["ns_per_cast"])
    cells = list(results.SIZES.values())
    styles = [("Bullet, segment", "ours", {"color": ORANGE, "marker": "^"}),
              ("Bullet, triangles in a box", "ours", {"color": GREEN, "marker": "s"}),
              ("Bullet, walls change", "ours, walls change", {"color": SKY, "marker": "v", "linestyle": (0, (4, 2))}),
              ("GIMPACT, triangles, walls change", "ours, walls change", {"color": PURPLE, "marker": "D", "linestyle": (0, (4, 2))})]
    for peer, ours, style in styles:
        ratios.plot(cells, [p / o for p, o in zip(by_engine[peer], by_engine[ours])], label=peer, **style)
    ratios.axhline(results.PAPER_VS_BULLET, **STATED, label="stated in [JCD10] for Bullet's tree: 3")
    ratios.axhline(1, color=SOFT, linewidth=0.8)
    cells_axis(ratios)
    ratios.set_yscale("log")
    ratios.yaxis.set_major_locator(FixedLocator([1, 2, 3, 5, 10, 20, 50]))
    ratios.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:g}"))
    ratios.yaxis.set_minor_formatter(NullFormatter())
    ratios.set_ylim(0.9, None)
    ratios.set_ylabel("their time over ours")
    ratios.set_title("The fair comparison: ratios")
    for axes in (times, ratios):
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, columnspacing=1.2, handlelength=2.4)
    finish(figure, folder, 11, data.sentence,
           "Known of the paper's figure: 5 µs and 7 orientation tests for a particle and step on a Core 2 at 2.4 GHz, 3 times less than Bullet's tree "
           "of axis-parallel boxes; its own time is flat in n, Bullet's grows as log n with segment tests and is flat with triangle tests. Its points, and "
           "what it measured as a triangle test, are not known; we show two ways. A particle and step is seven casts here (the move and six edges). "
           "Times are of different machines; ratios are taken in one process.")


def draw12(folder, data):
    rows = data.rows
    figure, (costs, skips) = plt.subplots(1, 2, figsize=(11, 4.6), gridspec_kw={"width_ratios": [2.2, 1]})
    names = [row["elimination"] for row in rows]
    places = range(len(rows))
    bars = costs.bar([x - 0.19 for x in places], [row["over_particles_alone"] for row in rows], 0.36, color=BLUE, label="ours")
    costs.bar_label(bars, fmt="%.2g", padding=2, fontsize=9)
    known = [(x, row["stated"]) for x, row in zip(places, rows) if row["stated"] is not None]
    stated = costs.bar([x + 0.19 for x, _ in known], [y for _, y in known], 0.36, facecolor="white", edgecolor=INK, hatch="///", linestyle="--",
                       label="stated in [JCD10]")
    costs.bar_label(stated, fmt="%g", padding=2, fontsize=9)
    for x, row in zip(places, rows):
        if row["stated"] is None:
            costs.text(x + 0.19, 0.12, "not known", rotation=90, ha="center", va="bottom", fontsize=8.5, color=SOFT)
    costs.set_xticks(list(places), ["particles\nalone"] + ["edges,\n" + ("no elimination" if n == "none" else n) for n in names[1:]])
    costs.set_ylabel("time of a step over that of particles alone")
    costs.set_title("Figure 12: what edges cost on a surface of 12,000 vertices")
    costs.grid(axis="x", visible=False)
    costs.legend(loc="upper right")

    skipped = [row for row in rows[1:] if row["elimination"] != "none"]
    bars = skips.bar([row["elimination"] for row in skipped], [100 * row["skipped_share"] for row in skipped], 0.5, color=SKY)
    skips.bar_label(bars, fmt="%.3g %%", padding=2, fontsize=9)
    skips.set_ylim(0, 112)
    skips.set_ylabel("edges left out in a step (%)")
    skips.set_title("What is eliminated (ours)")
    skips.grid(axis="x", visible=False)
    alone = rows[0]["ns_per_vertex_and_step"]
    finish(figure, folder, 12, data.sentence,
           "Known of the paper's figure: edges cost 9 times the particles alone, 3 times with the hybrid elimination (6.3). Its bars for elimination by "
           "environment (6.1) and by motion (6.2) alone, its surface and its environment are not known. Ours: cubes cut into pyramids, the surface falls, "
           f"presses and is lifted; particles alone take {alone:.3g} ns a vertex and step, so a ratio is large where that is small.")


DRAWINGS = {"9": draw9, "11": draw11, "12": draw12}


def main(arguments):
    if len(arguments) < 2 or not set(arguments[1:]) <= set(DRAWINGS):
        print(__doc__.strip().splitlines()[2], file=sys.stderr)
        return 2
    folder = Path(arguments[0])
    try:
        for name in arguments[1:]:
            DRAWINGS[name](folder, results.FIGURES[name](folder))
    except (OSError, ValueError, results.Missing) as error:
        print(f"draw: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
