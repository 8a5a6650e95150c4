"""Charts of curves: error (up, logarithmic) against run time, or against the setting (across, logarithmic)."""
import math
import re

from catalogue import AGAINST_SETTING, PEERS, peer_of
from scale import set_axes
from style import MARKS, colour, power, seconds

import matplotlib.pyplot as plt

import labels


def shade_of(name, role, turn):
    """Colour of a series, the so-manieth of its role. A library has the same one in all charts."""
    if role == "peer":
        return colour(f"peer{list(dict.fromkeys(PEERS.values())).index(peer_of(name)) + 1}")
    return colour("exact" if role == "exact" else f"dial{turn % 6 + 1}")


def looks(panels):
    """(colour, mark) of each series, the same in all panels of a curve."""
    used, found = {"dial": 0, "exact": 0, "peer": 0}, {}
    for name, points in (item for panel in panels for item in panel.series().items()):
        if name not in found:
            role = points[0].role
            found[name] = (shade_of(name, role, used[role]), MARKS[role][used[role] % len(MARKS[role])])
            used[role] += 1
    return found


def is_number(text):
    return re.fullmatch(r"[-+]?[0-9.]+(e[-+]?[0-9]+)?", text) is not None


def line_of(points):
    """How the points of a series are joined: not at all if the settings are no numbers."""
    if len(points) == 1 or not all(is_number(point.setting) for point in points):
        return ""
    return (0, (4, 2)) if points[0].role == "peer" else "-"


def draw_panel(axes, panel, look, tips, by_setting):
    axis = set_axes(axes, panel, by_setting)
    wanted, lines, marks = [], [], []
    for name, points in panel.series().items():
        shade, mark = look[name]
        role, line = points[0].role, line_of(points)
        places = [(float(point.setting) if by_setting else point.seconds, axis.place(point)) for point in points]
        axes.plot(*zip(*places), color=shade, lw=1.8 if role == "dial" else 1.1, ls=line, zorder=3 if role == "dial" else 2)
        lines += list(zip(places, places[1:])) if line else []
        for point, place in zip(points, places):
            tip = f"tip{len(tips)}"
            who = f"{point.method}, {point.label}" if point.setting else point.method
            tips[tip] = f"{who}: {seconds(point.seconds)} per {point.item}, {point.error_name} {spoken(point)}"
            if interval(point):
                least, most = interval(point)
                axes.vlines(place[0], max(least, axis.lowest), most, color=shade, lw=0.9, alpha=0.7, zorder=2)
            axes.plot(*place, marker=mark, color=shade, gid=tip, ls="", zorder=5, markersize=9 if role == "exact" else 6,
                      markerfacecolor=colour("paper") if point.error == 0 and role == "dial" else shade, markeredgewidth=1.3)
            if point.setting and not by_setting and (len(points) > 1 or role == "dial"):
                wanted.append((*place, short_setting(point.setting), shade))
            else:
                marks.append(place)
    axes.figure.canvas.draw()
    labels.place(axes, wanted, lines, marks)


def short_setting(setting):
    """A setting as a label: numbers far from 1 as powers of ten."""
    if not is_number(setting):
        return setting
    value = float(setting)
    return f"{value:g}" if value == 0 or 1e-3 <= abs(value) < 1e4 else power(value)


def interval(point):
    """Where a share of so many cases lies with 95 % confidence (Wilson), or None if the error is no share of cases."""
    cases = point.error * point.count
    if not point.is_share or not 0 < point.error <= 1 or abs(cases - round(cases)) > 1e-5 * point.count:
        return None
    z, n, p = 1.96, point.count, point.error
    middle, half = p + z * z / (2 * n), z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)


def spoken(point):
    """An error in words; of none in so many a bound that holds in 95 of 100 cases: the rule of three."""
    unit = f" {point.error_unit}" if point.error_unit not in ("", "1") else ""
    if point.error > 0:
        return f"{point.error:.3g}{unit}{' (explodes)' if point.exploded else ''}"
    if point.is_share and point.count >= 30:
        return f"0 of {point.count:,} (below {3 / point.count:.1g} with 95 % confidence)"
    return f"exactly 0 in {point.count:,}"


def add_legend(figure, panels, look):
    """Names of all series above the panels, in as many columns as there is room for; returns its height in inches."""
    lines = {name: line_of(points) for panel in panels for name, points in panel.series().items()}
    handles = [plt.Line2D([], [], color=shade, marker=mark, ls=lines[name], label=name) for name, (shade, mark) in look.items()]
    for columns in (4, 3, 2, 1):
        legend = figure.legend(handles=handles, loc="upper left", ncols=columns, borderaxespad=0.2, handlelength=2.2, columnspacing=1.8)
        box = legend.get_window_extent(figure.canvas.get_renderer())
        if box.width <= figure.bbox.width or columns == 1:
            return box.height / figure.dpi
        legend.remove()


def draw_curve(curve):
    """The chart of a curve as a figure, and the words that belong to its marks, by their ids."""
    panels, tips, by_setting = curve.panels(), {}, curve.name in AGAINST_SETTING
    across = min(2, len(panels))
    down = math.ceil(len(panels) / across)
    figure, grid = plt.subplots(down, across, figsize=(7.6 if across == 1 else 10.4, 3.75 * down + 0.55), squeeze=False)
    look = looks(panels)
    top = 1 - (add_legend(figure, panels, look) + 0.02) / figure.get_figheight()
    for axes in grid.flat[len(panels):]:
        axes.set_visible(False)
    # Labels find their places on axes that are where they will be: that takes their ticks, so the layout is made twice.
    for axes, panel in zip(grid.flat, panels):
        set_axes(axes, panel, by_setting)
    figure.tight_layout(rect=(0, 0, 1, top), w_pad=3, h_pad=2.5)
    for axes, panel in zip(grid.flat, panels):
        axes.clear()
        draw_panel(axes, panel, look, tips, by_setting)
    return figure, tips
