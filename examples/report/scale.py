"""Logarithmic axes of a panel, with a band for what has no place on them: errors of exactly 0 below, explosions above."""
import math
import textwrap
from dataclasses import dataclass

from style import colour, power, seconds

from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator


@dataclass(frozen=True)
class Upright:
    """The upright axis; each band has the place of its marks, or None if it is empty."""

    lowest: float  # the lowest power of ten, where the logarithmic part begins
    highest: float  # and where it ends
    zero: float
    exploded: float

    def place(self, point):
        return self.exploded if point.exploded else point.error or self.zero

    @property
    def decades(self):
        return max(1.0, math.log10(self.highest / self.lowest))


def upright(points):
    """The axis that these points need."""
    errors = [point.error for point in points if not point.exploded]
    above = [error for error in errors if error > 0]
    lowest = 10.0 ** math.floor(math.log10(min(above, default=1e-3)))
    largest = max(above, default=1.0)
    decades = max(1.0, math.log10(largest / lowest))
    highest = largest * 10 ** min(0.6, 0.1 * decades + 0.1)
    band = 10 ** (0.16 * decades + 0.2)
    return Upright(lowest, highest, lowest / band if 0 in errors else None,
                   highest * band if any(point.exploded for point in points) else None)


def ticks_between(lowest, highest):
    """Powers of ten, about seven, or more than these where there are few."""
    decades = math.log10(highest / lowest)
    step = max(1, math.ceil(decades / 7))
    ticks = [lowest * 10.0**k for k in range(0, math.floor(decades + 1e-9) + 1, step)]
    return ticks if len(ticks) > 2 else [lowest * 10.0**k * m for k in range(3) for m in (1, 2, 5) if lowest * 10.0**k * m <= highest]


def set_upright(axes, axis, has_errors):
    """`has_errors`: some are neither 0 nor exploded."""
    edge, half = 10 ** (0.06 * axis.decades), 10 ** (0.08 * axis.decades + 0.1)
    bottom = axis.zero / half if axis.zero else axis.lowest / edge
    top = axis.exploded * half if axis.exploded else axis.highest
    axes.set_ylim(bottom, top)
    ticks = ticks_between(axis.lowest, axis.highest) if has_errors else []
    names = [power(tick) for tick in ticks]
    if axis.zero:
        ticks, names = [axis.zero, *ticks], ["exactly 0", *names]
        axes.axhspan(bottom, axis.lowest / edge, color=colour("band"), lw=0, zorder=0)
    if axis.exploded:
        ticks, names = [*ticks, axis.exploded], [*names, "explodes"]
        axes.axhspan(axis.highest * edge, top, color=colour("band"), lw=0, zorder=0)
    axes.yaxis.set_major_locator(FixedLocator(ticks))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_yticklabels(names)


def ticks_across(lowest, highest, most):
    """Round times between two, at least three where there are so many, and at most `most`."""
    decades = range(math.floor(math.log10(lowest)), math.floor(math.log10(highest)) + 1)
    ticks = []
    for parts in ((1,), (1, 2, 5), (1, 1.5, 2, 3, 4, 5, 6, 8), [1 + k / 10 for k in range(90)]):
        ticks = [float(f"{part * 10.0**k:.3g}") for k in decades for part in parts if lowest <= part * 10.0**k <= highest]
        if len(ticks) >= 3:
            break
    return ticks[:: math.ceil(len(ticks) / most)] if ticks else []


def set_across(axes, times):
    """The axis of run times."""
    span = math.log10(max(times) / min(times))
    margin = max(0.12, 0.1 * span)
    axes.set_xlim(min(times) / 10**margin, max(times) * 10 ** (margin + 0.06 * span))
    inches = axes.get_window_extent().width / axes.figure.dpi
    axes.xaxis.set_major_locator(FixedLocator(ticks_across(*axes.get_xlim(), max(3, int(inches / 0.75)))))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: seconds(value)))
    axes.xaxis.set_minor_formatter(NullFormatter())


def set_across_settings(axes, panel):
    """The axis of settings; it is linear below the smallest above 0, which 0 can stand beside."""
    settings = [float(point.setting) for point in panel.points]
    least = min(setting for setting in settings if setting > 0)
    axes.set_xscale("symlog", linthresh=least)
    axes.set_xlim(min(settings) - 0.2 * least, 1.3 * max(settings))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_xlabel(panel.points[0].setting_unit)


def set_axes(axes, panel, by_setting):
    """Both axes and the heading of a panel; returns the upright one."""
    axes.set(xscale="log", yscale="log", xlabel=f"run time per {panel.item}")
    axis = upright(panel.points)
    set_upright(axes, axis, any(point.error > 0 and not point.exploded for point in panel.points))
    if by_setting:
        set_across_settings(axes, panel)
    else:
        set_across(axes, [point.seconds for point in panel.points])
    unit = f" [{panel.error_unit}]" if panel.error_unit not in ("", "1") else ""
    axes.set_title(textwrap.fill(f"error: {panel.error_name}{unit}", 62), pad=8)
    return axis
