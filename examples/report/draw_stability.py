"""Charts of the stability table: a map of stiffness and time step for each integrator, and what springs and energy do."""
import math

from catalogue import in_words
from style import colour, power

import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

SHADES = {"symplectic_euler": "peer1", "implicit_euler": "dial1", "xpbd": "dial2"}


def axis_of(grid, column):
    return sorted({row[column] for row in grid})


def integrators(grid):
    return list(dict.fromkeys(row["integrator"] for row in grid))


def in_cell(row):
    """Energy at the end over that at the start, short enough for a cell."""
    ratio = 1 + row["energy_drift"]
    if not math.isfinite(ratio):
        return "–"
    return f"{ratio:.2f}" if ratio < 9.995 else f"10{power(10.0 ** round(math.log10(ratio)))[2:]}" if ratio >= 1000 else f"{ratio:.0f}"


def draw_map(grid):
    """Integrators side by side: stable or not (colour and a cross), the energy that is left, and the promise below."""
    kinds, stiffnesses, steps = integrators(grid), axis_of(grid, "stiffness"), axis_of(grid, "dt")
    figure, all_axes = plt.subplots(1, len(kinds), figsize=(10.4, 0.34 * len(stiffnesses) + 1.75), sharey=True, squeeze=False)
    for axes, kind in zip(all_axes.flat, kinds):
        rows = [row for row in grid if row["integrator"] == kind]
        for row in rows:
            x, y = steps.index(row["dt"]), stiffnesses.index(row["stiffness"])
            stable = bool(row["stable"])
            axes.add_patch(plt.Rectangle((x + 0.03, y + 0.04), 0.94, 0.92, lw=0, color=colour("stable" if stable else "unstable")))
            axes.text(x + 0.5, y + 0.47, in_cell(row) if stable else f"× {in_cell(row)}", ha="center", va="center", fontsize=8)
        promise = [int(sum(row[name] for row in rows)) for name in ("not_free", "lost", "nonfinite")]
        axes.set(xlim=(0, len(steps)), ylim=(0, len(stiffnesses)), xlabel="time step dt [s]")
        axes.set_xticks([k + 0.5 for k in range(len(steps))], [power(step) for step in steps])
        axes.set_yticks([k + 0.5 for k in range(len(stiffnesses))], [power(stiffness) for stiffness in stiffnesses])
        axes.tick_params(length=0)
        axes.grid(False)
        for spine in axes.spines.values():
            spine.set_visible(False)
        count = sum(bool(row["stable"]) for row in rows)
        axes.set_title(f"{in_words(kind)}: {count} of {len(rows)} stable", pad=7)
        axes.annotate(f"not free {promise[0]} · lost {promise[1]} · non-finite {promise[2]}", (0, 0), (1, -46), xycoords="axes fraction",
                      textcoords="offset points", fontsize=8.5, color=colour("dial2" if not any(promise) else "peer2"), fontweight="bold")
    all_axes.flat[0].set_ylabel("stiffness [m / dt²]")
    figure.tight_layout(w_pad=1.6)
    return figure


def draw_lines(grid):
    """Energy and stretch against stiffness, at each time step; where physics explodes lines are broken off at the top."""
    kinds, steps = integrators(grid), axis_of(grid, "dt")
    figure, all_axes = plt.subplots(1, 2, figsize=(10.4, 3.9))
    quantities = ((lambda row: row["energy_largest"], "largest energy on the way over that at the start"),
                  (lambda row: row["largest_stretch"], "largest stretch of a link, relative to its length"))
    for axes, (value, title) in zip(all_axes, quantities):
        axes.set(xscale="log", yscale="log", xlabel="stiffness [m / dt²]")
        for kind in kinds:
            for turn, step in enumerate(steps):
                rows = sorted((row for row in grid if row["integrator"] == kind and row["dt"] == step), key=lambda row: row["stiffness"])
                places = [(row["stiffness"], value(row)) for row in rows if math.isfinite(value(row)) and value(row) > 0]
                if not places:
                    continue
                weight = (turn + 1) / len(steps)
                axes.plot(*zip(*places), color=colour(SHADES.get(kind, "ink")), lw=0.6 + 1.2 * weight, marker="o", markersize=1.5 + 2.5 * weight,
                          label=in_words(kind) if turn == len(steps) - 1 else None)
        axes.yaxis.set_major_locator(LogLocator(10, numticks=8))
        axes.xaxis.set_major_locator(LogLocator(10, numticks=9))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.yaxis.set_minor_locator(NullLocator())
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda value, _: power(value)))
        axes.set_title(title, pad=8)
    figure.tight_layout(rect=(0, 0, 1, 0.91), w_pad=3)
    handles, names = all_axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="upper left", ncols=3, borderaxespad=0.2)
    return figure
