"""Charts of curves: error (up, logarithmic) against run time (across, logarithmic)."""
import html
import io
import math
import re

from catalogue import PEERS, peer_of
from style import MARKS, THEME, colour, power, seconds

import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator

import labels


def shade_of(name, role, turn):
    """Colour of a series, the so-manieth of its role. A library has the same one in all charts."""
    if role == "peer":
        return colour(f"peer{list(dict.fromkeys(PEERS.values())).index(peer_of(name)) + 1}")
    return colour("exact" if role == "exact" else f"dial{turn % 4 + 1}")


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


def zero_place(errors):
    """(lowest tick of the logarithmic part, where an error of exactly 0 is drawn or None)."""
    above = [error for error in errors if error > 0]
    lowest = 10.0 ** math.floor(math.log10(min(above))) if above else 1e-3
    if len(above) == len(errors):
        return lowest, None
    highest = max(above, default=1.0)
    decades = max(1.0, math.log10(highest / lowest))
    return lowest, lowest / 10 ** (0.16 * decades + 0.2)


def set_axes(axes, panel, lowest, zero):
    above = [point.error for point in panel.points if point.error > 0]
    highest = max(above, default=1.0)
    axes.set(xscale="log", yscale="log")
    decades = max(1.0, math.log10(highest / lowest))
    times = [point.seconds for point in panel.points]
    span = math.log10(max(times) / min(times))
    margin = 10 ** max(0.12, 0.1 * span)
    axes.set_xlim(min(times) / margin, max(times) * margin * 10 ** (0.06 * span))
    top = highest * 10 ** min(0.6, 0.1 * decades + 0.1)
    axes.set_ylim((zero / 10 ** (0.08 * decades + 0.1)) if zero else lowest / 10 ** (0.06 * decades), top)
    step = max(1, math.ceil(math.log10(top / lowest) / 7))
    ticks = [lowest * 10.0**k for k in range(0, math.floor(math.log10(top / lowest) + 1e-9) + 1, step)]
    if len(ticks) < 3:
        ticks = [lowest * 10.0**k * m for k in range(0, 3) for m in (1, 2, 5) if lowest * 10.0**k * m <= top]
    names = [power(tick) for tick in ticks]
    if zero:
        if not above:
            ticks, names = [], []
        ticks, names = [zero, *ticks], ["exactly 0", *names]
        axes.axhspan(axes.get_ylim()[0], lowest / 10 ** (0.06 * decades), color=colour("band"), lw=0, zorder=0)
    axes.yaxis.set_major_locator(FixedLocator(ticks))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_yticklabels(names)
    left, right = (math.log10(end) for end in axes.get_xlim())
    axes.xaxis.set_major_locator(LogLocator(10, (1.0,) if right - left > 2.2 else (1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: seconds(value)))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel(f"run time per {panel.item}")
    unit = f" [{panel.error_unit}]" if panel.error_unit not in ("", "1") else ""
    axes.set_title(f"error: {panel.error_name}{unit}", pad=8)


def draw_panel(axes, panel, look, tips):
    lowest, zero = zero_place([point.error for point in panel.points])
    set_axes(axes, panel, lowest, zero)
    wanted, lines = [], []
    for name, points in panel.series().items():
        shade, mark = look[name]
        role, line = points[0].role, line_of(points)
        places = [(point.seconds, point.error or zero) for point in points]
        axes.plot(*zip(*places), color=shade, lw=1.8 if role == "dial" else 1.1, ls=line, zorder=3 if role == "dial" else 2)
        lines += list(zip(places, places[1:]))
        for point, place in zip(points, places):
            tip = f"tip{len(tips)}"
            who = f"{point.method}, {point.label}" if point.setting else point.method
            tips[tip] = f"{who}: {seconds(point.seconds)} per {point.item}, {point.error_name} {spoken(point)}"
            if interval(point):
                least, most = interval(point)
                axes.vlines(point.seconds, max(least, lowest), most, color=shade, lw=0.9, alpha=0.7, zorder=2)
            axes.plot(*place, marker=mark, color=shade, gid=tip, ls="", zorder=5,
                      markersize={"dial": 6, "exact": 9, "peer": 6}[role],
                      markerfacecolor=colour("paper") if point.error == 0 and role == "dial" else shade, markeredgewidth=1.3)
            if point.setting and (len(points) > 1 or role == "dial"):
                wanted.append((*place, point.setting, shade))
    axes.figure.canvas.draw()
    labels.place(axes, wanted, lines)


def interval(point):
    """Where a share of so many cases lies with 95 % confidence (Wilson), or None if the error is no share."""
    if not point.is_share or not 0 < point.error <= 1:
        return None
    z, n, p = 1.96, point.count, point.error
    middle, half = p + z * z / (2 * n), z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)


def spoken(point):
    """An error in words; of none in so many a bound that holds in 95 of 100 cases: the rule of three."""
    unit = f" {point.error_unit}" if point.error_unit not in ("", "1") else ""
    if point.error > 0:
        return f"{point.error:.3g}{unit}"
    if point.is_share and point.count >= 30:
        return f"0 of {point.count:,} (below {3 / point.count:.1g} with 95 % confidence)"
    return f"exactly 0 in {point.count:,}"


def draw_curve(curve):
    """The chart of a curve as a figure, and the words that belong to its marks, by their ids."""
    panels = curve.panels()
    across = min(2, len(panels))
    down = math.ceil(len(panels) / across)
    figure, grid = plt.subplots(down, across, figsize=(7.6 if across == 1 else 10.4, 3.75 * down + 0.55), squeeze=False)
    look = looks(panels)
    tips = {}
    rows = math.ceil(len(look) / (3 if across == 1 else 4))
    figure.tight_layout(rect=(0, 0, 1, 1 - (0.19 * rows + 0.12) / figure.get_figheight()), w_pad=3, h_pad=2.5)
    for axes in grid.flat[len(panels):]:
        axes.set_visible(False)
    for axes, panel in zip(grid.flat, panels):
        draw_panel(axes, panel, look, tips)
    figure.tight_layout(rect=(0, 0, 1, 1 - (0.19 * rows + 0.12) / figure.get_figheight()), w_pad=3, h_pad=2.5)
    lines = {name: line_of(points) for panel in panels for name, points in panel.series().items()}
    handles = [plt.Line2D([], [], color=shade, marker=mark, ls=lines[name], label=name) for name, (shade, mark) in look.items()]
    figure.legend(handles=handles, loc="upper left", ncols=3 if across == 1 else 4, borderaxespad=0.2, handlelength=2.2,
                  columnspacing=1.8)
    return figure, tips


def to_svg(figure, tips, title):
    """A figure as an SVG document on its own; closes it. Marks with words show them under the pointer."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Title": title})
    plt.close(figure)
    svg = buffer.getvalue()
    for tip, words in tips.items():
        svg = svg.replace(f'<g id="{tip}">', f'<g id="{tip}">\n    <title>{html.escape(words)}</title>')
    return svg


def inline(svg, name, title):
    """The same for the page: no prologue, ids of its own, colours by name so that they follow the theme."""
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', svg)
    svg = re.sub(r'href="#([^"]+)"', rf'href="#{name}-\1"', svg)
    svg = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", svg)
    for key, (light, _) in THEME.items():
        svg = svg.replace(light, f"var(--{key})")
    svg = re.sub(r'<svg [^>]*?(viewBox="[^"]+")[^>]*>', rf'<svg \1 role="img" aria-label="{html.escape(title)}">', svg, count=1, flags=re.S)
    return svg
