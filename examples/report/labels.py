"""Puts labels beside points so that they hide as little as possible."""
from matplotlib.transforms import Bbox

# Offsets in points, and how the label hangs there; those that read best first.
PLACES = ((6, 5, "left", "bottom"), (-6, 5, "right", "bottom"), (6, -5, "left", "top"), (-6, -5, "right", "top"),
          (0, 8, "center", "bottom"), (0, -8, "center", "top"), (9, 0, "left", "center"), (-9, 0, "right", "center"),
          (12, 13, "left", "bottom"), (-12, 13, "right", "bottom"), (12, -13, "left", "top"), (-12, -13, "right", "top"))


def overlap(a, b):
    width = min(a.x1, b.x1) - max(a.x0, b.x0)
    height = min(a.y1, b.y1) - max(a.y0, b.y0)
    return width * height if width > 0 and height > 0 else 0.0


def on_line(box, line):
    """How many of 25 places along a line, given by its ends, lie in the box."""
    (x0, y0), (x1, y1) = line
    places = ((x0 + (x1 - x0) * k / 24, y0 + (y1 - y0) * k / 24) for k in range(25))
    return sum(box.x0 <= x <= box.x1 and box.y0 <= y <= box.y1 for x, y in places)


def place(axes, wanted, lines, marks=()):
    """Labels `wanted`, (x, y, text, colour) each, away from their points, from lines (ends in data) and from `marks`, points without
    a label. A label that finds no room is left out: a table below the chart has all values. Returns how many were placed."""
    renderer = axes.figure.canvas.get_renderer()
    screen = axes.transData.transform
    points = [screen((x, y)) for x, y, _, _ in wanted]
    taken = [Bbox.from_bounds(x - 5, y - 5, 10, 10) for x, y in [*points, *(screen(mark) for mark in marks)]]
    lines = [(screen(start), screen(end)) for start, end in lines]
    frame = axes.get_window_extent(renderer)
    placed = 0
    for x, y, text, colour in wanted:
        label = axes.annotate(text, (x, y), (0, 0), textcoords="offset points", fontsize=7.5, color=colour)
        best, best_cost = None, 60.0
        for rank, (dx, dy, across, up) in enumerate(PLACES):
            label.set(position=(dx, dy), ha=across, va=up)
            box = label.get_window_extent(renderer).padded(1.5)
            outside = box.width * box.height - overlap(box, frame)
            cost = rank + 8 * outside + 3 * sum(overlap(box, other) for other in taken) + 4 * sum(on_line(box, l) for l in lines)
            if cost < best_cost:
                best, best_cost = (dx, dy, across, up, box), cost
        if best is None:
            label.remove()
            continue
        label.set(position=best[:2], ha=best[2], va=best[3])
        taken.append(best[4])
        placed += 1
    return placed
