"""Colours and marks of all charts. Each colour has a name, by which the page replaces it with that of a light or dark theme."""
import matplotlib

matplotlib.use("agg")  # measures text; files are SVG all the same

# name: (on paper, on a dark screen). No two of one column are equal: the page finds colours by their value.
THEME = {
    "ink": ("#1d2731", "#e6e8ea"),
    "soft": ("#5c6873", "#a3adb6"),
    "grid": ("#e3e6e9", "#333b43"),
    "band": ("#f3f5f6", "#20262c"),
    "paper": ("#fefefe", "#15191d"),
    "dial1": ("#1f5fa8", "#6aa9ee"),
    "dial2": ("#2a9d8f", "#4fc9b8"),
    "dial3": ("#7a52a6", "#b493df"),
    "dial4": ("#7c8a2e", "#b9c95c"),
    "dial5": ("#3d3f9e", "#9294f0"),
    "dial6": ("#1a7f4b", "#63c78f"),
    "exact": ("#111820", "#f5f7f8"),
    "peer1": ("#d1622b", "#f09a66"),
    "peer2": ("#b3284a", "#ef7590"),
    "peer3": ("#a9822a", "#dcb65a"),
    "peer4": ("#8a4b2f", "#cf8d70"),
    "peer5": ("#6d6a1f", "#bdb95a"),
    "peer6": ("#a0408f", "#dd8ccb"),
    "stable": ("#d5e8e3", "#22463f"),
    "unstable": ("#f1c7bb", "#6b2f22"),
}
MARKS = {"dial": "osD^vp", "exact": "P*Xh", "peer": "vs^D<>phd"}


def colour(name):
    return THEME[name][0]


matplotlib.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "dartsweep",
    "font.family": "sans-serif",
    "font.sans-serif": ["Helvetica Neue", "Helvetica", "Arial", "Liberation Sans", "DejaVu Sans"],
    "font.size": 9, "axes.labelsize": 9, "axes.titlesize": 9.5, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "legend.fontsize": 8.5,
    "text.color": colour("ink"), "axes.labelcolor": colour("soft"), "axes.titlecolor": colour("ink"),
    "axes.edgecolor": colour("soft"), "xtick.color": colour("soft"), "ytick.color": colour("soft"),
    "axes.linewidth": 0.8, "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True,
    "axes.grid": True, "grid.color": colour("grid"), "grid.linewidth": 0.7,
    "xtick.major.size": 3, "ytick.major.size": 0, "xtick.minor.size": 1.5, "ytick.minor.size": 0,
    "axes.facecolor": "none", "figure.facecolor": colour("paper"), "savefig.facecolor": colour("paper"),
    "legend.frameon": False, "lines.linewidth": 1.6, "lines.markersize": 6,
})

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power(value):
    """A short number for an axis or a cell: 0.005, 1, 50, 10⁻⁶, 3·10⁷."""
    if value == 0:
        return "0"
    if 0.001 <= abs(value) < 1000:
        return f"{value:.3g}"
    mantissa, exponent = f"{value:.0e}".split("e")
    exponent = str(int(exponent)).translate(SUPERSCRIPTS)
    return f"10{exponent}" if mantissa == "1" else f"{mantissa}·10{exponent}"


def seconds(value):
    """A time with a unit that suits it."""
    for factor, unit in ((1, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if value >= factor * 0.9995:
            return f"{value / factor:.3g} {unit}"
    return f"{value / 1e-9:.3g} ns"
