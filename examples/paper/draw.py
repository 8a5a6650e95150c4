"""Draws figures 8 to 12 of [JCD10] as we measure them, with what the paper states in the same axes.

usage: draw.py FOLDER FIGURE...

Reads what results.py reads, writes figure8.svg and .png, and so on. The paper's own pictures are not copied and no point is
read off them: dashed lines and hatched bars are numbers in its text, and a caption says what is not known.
"""
import json
import sys
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

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


def draw8(folder, data):
    """The wall seen along its thinnest direction, far triangles first, and the catheter over it."""
    picture = json.loads((folder / "picture.json").read_text())
    points = np.array(picture["positions"]).reshape(-1, 3)
    triangles = np.array(picture["triangles"]).reshape(-1, 3)
    catheter = np.array(picture["catheter"])
    middle = points.mean(axis=0)
    axes_of = np.linalg.svd(points - middle, full_matrices=False)[2]
    points, catheter = (points - middle) @ axes_of.T, (catheter - middle) @ axes_of.T
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    front = normals[:, 2] < 0  # the half of the wall behind the catheter: its inner side is seen
    order = np.argsort(corners[front, :, 2].mean(axis=1))
    light = 0.35 + 0.65 * np.abs(normals[front] @ np.array([0.3, 0.4, 0.866]))[order]
    colours = np.outer(light, [0.80, 0.55, 0.52]) + np.outer(1 - light, [0.35, 0.16, 0.16])
    figure, axes = plt.subplots(figsize=(11, 4.4))
    axes.add_collection(PolyCollection(corners[front][order][:, :, :2], facecolors=colours, edgecolors=colours, linewidths=0.2, rasterized=True))
    axes.plot(catheter[:, 0], catheter[:, 1], color="white", linewidth=4.5, solid_joinstyle="round")
    axes.plot(catheter[:, 0], catheter[:, 1], color=BLUE, linewidth=2.5, marker="o", markersize=5, markeredgecolor="white", markeredgewidth=0.7,
              label=f"catheter of {len(catheter)} particles")
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.grid(visible=False)
    axes.set_xlabel("mm")
    axes.set_ylabel("mm")
    axes.set_title("Figure 8: a catheter in a vascular network")
    axes.legend(loc="best")
    finish(figure, folder, 8, data.sentence,
           "Seen along the thinnest direction of the network, the nearer half of its wall taken away. The catheter was pushed in from the inlet; its "
           "edges stretched, no particle was added. Where it seems to leave the vessel, the part taken away lies over it. Every step was verified "
           "to be free. Known of the paper's figure: 20 particles, about 200,000 tetrahedra; its network is another one.")


def draw9(folder, data):
    pushes = results.read_pushes(folder)
    figure, (shares, ways) = plt.subplots(2, 1, figsize=(9, 7.4), height_ratios=[2, 1])
    styles = {"catches": (ORANGE, "catches at the wall and is released"), "slides": (BLUE, "slides along the wall")}
    for name, push in pushes.items():
        colour, words = styles.get(name, (GREEN, name))
        at = [row["rest_length_mm"] for row in push]
        shares.plot(at, [row["cells_tested_share"] for row in push], color=colour, linewidth=1.3, label=f"{words}: different tetrahedra")
        shares.plot(at, [row["cell_visits_share"] for row in push], color=colour, linewidth=0.6, alpha=0.6, label=f"{words}: every visit")
        ways.plot(at, [max(row["displacement_mm"], 1e-3) for row in push], color=colour, linewidth=0.9)
        releases = results.releases_of(push)
        for axes, key in ((shares, "cell_visits_share"), (ways, "displacement_mm")):
            axes.plot([row["rest_length_mm"] for row in releases], [row[key] for row in releases], color=colour, marker="v", markersize=4,
                      linestyle="", markerfacecolor="white", label=f"{words}: stress is released" if releases and axes is shares else None)
    shares.axhline(results.PAPER_SHARE, **STATED, label="stated in [JCD10]: below 3 %")
    shares.set_ylim(0, 1.1 * max(results.PAPER_SHARE, max(row["cell_visits_share"] for row in data.rows)))
    shares.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{100 * y:g} %"))
    shares.set_ylabel("tetrahedra tested in a step,\nshare of all")
    shares.set_title(f"Figure 9: a catheter of 20 particles in a vessel of {data.rows[-1]['cells']:,.0f} tetrahedra")
    shares.legend(loc="best", fontsize=8)
    ways.set_yscale("log")
    ways.set_ylabel("farthest way of a\nparticle in the step (mm)")
    ways.set_xlabel("length that was pushed in: of the springs at rest (mm)")
    for axes in (shares, ways):
        axes.set_xlim(0, None)
    finish(figure, folder, 9, data.sentence,
           "Known of the paper's figure: 20 particles whose edges get longer in 200,000 tetrahedra test fewer than 3 % of them; spikes come from stress "
           "that is released. Its curve, the length of its catheter and its mesh are not known. Counted are the different cells that the casts of [JCD10] "
           "4.1 enter, and every visit that the library makes, contacts included. Triangles: steps that move a particle "
           f"{results.RELEASE} times farther than the steps around them. Once contacts are kept for a step (slides), the catheter does not catch.")


def cubes(cells, size):
    """Faces of unit cells of a lattice."""
    corner = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    made = []
    for cell in cells:
        at = np.array([cell % size[0], cell // size[0] % size[1], cell // (size[0] * size[1])])
        made += [corner[face] + at for face in faces]
    return made


def draw10(folder, data):
    scene = json.loads((folder / "scene.json").read_text())
    figure = plt.figure(figsize=(12, 5.6))
    near, far = figure.add_subplot(121, projection="3d"), figure.add_subplot(122, projection="3d")
    size = scene["lattices"][0]["size"]
    near.add_collection3d(Poly3DCollection(cubes(scene["obstacles"], size), facecolor=SOFT, edgecolor="white", linewidth=0.3, alpha=0.55))
    near.add_collection3d(Poly3DCollection(cubes(scene["appearing"], size), facecolor=ORANGE, edgecolor="white", linewidth=0.3, alpha=0.55))
    edges = [(i, i | 1 << axis) for i in range(8) for axis in range(3) if not i >> axis & 1]
    bodies = [np.array(body) for body in scene["bodies"]]
    near.add_collection3d(Line3DCollection([body[list(edge)] for body in bodies for edge in edges], colors=BLUE, linewidths=0.6))
    near.set(xlim=(0, size[0]), ylim=(0, size[1]), zlim=(0, size[2]))
    near.set_title(f"n = {data.rows[0]['cells']:,}: {len(bodies)} bodies (blue), fixed obstacles (grey),\nthe first that come (orange)")
    for lattice, colour in zip(scene["lattices"], (BLUE, GREEN, ORANGE, PURPLE)):
        extent = np.array(lattice["size"])
        corners = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * extent - extent / 2
        far.add_collection3d(Line3DCollection([corners[list(edge)] for edge in edges], colors=colour, linewidths=1.4))
        far.plot([], [], [], color=colour, label=f"n = {int(np.prod(extent)):,}: {' x '.join(map(str, extent))}, {lattice['obstacles']:,} obstacles")
    half = max(scene["lattices"][-1]["size"]) / 2
    far.set(xlim=(-half, half), ylim=(-half, half), zlim=(-half, half))
    far.set_title("The four lattices, to one scale: cells are added around")
    far.legend(loc="upper center", bbox_to_anchor=(0.5, -0.02), fontsize=8)
    finish(figure, folder, 10, data.sentence,
           "Cells are cubes of the same size in all lattices, 5 % of them obstacles. Bodies are hexahedra of 8 particles with edges of half a cell, turned at "
           "random; in larger lattices they are as many, spread farther. Every 10 steps 16 obstacles vanish and 16 others appear where no body is. Of the "
           "paper's figure only its title is known.")


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
    curve(times, rows, "GIMPACT, triangles", color=PURPLE, marker="D")
    curve(times, rows, "Embree", color=GREEN, marker="s")
    curve(times, rows, "uniform grid", color=SOFT, marker="x")
    curve(times, rows, "ours, bodies, walls change", color=SKY, marker="o", linestyle=(0, (4, 2)))
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
    changing = {"linestyle": (0, (4, 2))}
    styles = [("Bullet, segment", "ours", {"color": ORANGE, "marker": "^"}),
              ("GIMPACT, triangles", "ours", {"color": PURPLE, "marker": "D"}),
              ("Embree", "ours", {"color": GREEN, "marker": "s"}),
              ("uniform grid", "ours", {"color": SOFT, "marker": "x"}),
              ("Bullet, walls change", "ours, walls change", {"color": ORANGE, "marker": "v", **changing}),
              ("GIMPACT, walls change", "ours, walls change", {"color": PURPLE, "marker": "d", **changing}),
              ("Embree, walls change", "ours, walls change", {"color": GREEN, "marker": "s", **changing})]
    for peer, ours, style in styles:
        ratios.plot(cells, [p / o for p, o in zip(by_engine[peer], by_engine[ours])], label=peer, **style)
    ratios.axhline(results.PAPER_VS_BULLET, **STATED, label="stated in [JCD10]: 3")
    ratios.axhline(1, color=SOFT, linewidth=0.8)
    cells_axis(ratios)
    ratios.set_yscale("log")
    ratios.yaxis.set_major_locator(FixedLocator([0.5, 1, 2, 3, 5, 10, 20, 50]))
    ratios.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:g}"))
    ratios.yaxis.set_minor_formatter(NullFormatter())
    ratios.set_ylabel("their time over ours")
    ratios.set_title("The fair comparison: ratios")
    for axes in (times, ratios):
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, columnspacing=1.2, handlelength=2.4)
    finish(figure, folder, 11, data.sentence,
           "Known of the paper's figure: 225 deformable hexahedra of 8 particles, 1000 steps; 10 ms a step, 5 µs a particle and step on a Core 2 at 2.4 GHz, "
           "3 times less than both tests of Bullet; its own time is flat in n, that of segment tests grows as log n, that of GIMPACT's triangle tests is flat. "
           "Its points are not known. Every engine gets the casts that our bodies make (a particle's move and its three edges; GIMPACT the triangle "
           "of each edge). Dashed: with the changes of obstacles. Embree and the grid are not in the paper. Times are of different machines; "
           "ratios are taken in one process.")


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
           "environment (6.1) and of back edges (6.2) alone, its surface and its environment are not known. Ours: cubes cut into pyramids, the surface falls, "
           f"presses and is lifted; particles alone take {alone:.3g} ns a vertex and step, so a ratio is large where that is small.")


DRAWINGS = {"8": draw8, "9": draw9, "10": draw10, "11": draw11, "12": draw12}


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
