"""Draws an insertion: the vessel translucent, the catheter at several moments, its contacts. Prints what a caption says.

usage: draw.py INSERTION.json OUT.png
"""
import json
import os
import sys

sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "demo"))

import numpy as np
import pyvista

import draw_parts as parts

MOMENTS = ["#7d54a8", "#1c6fa8", "#159a9c", "#e08a1e"]  # first to last
MOST_CONTACTS = 300


def points_of(frame):
    return np.array(frame["positions"]).reshape(-1, 3)


def add_catheter(plot, frame, colour, radius):
    line = points_of(frame)
    plot.add_mesh(pyvista.lines_from_points(line).tube(radius=0.6 * radius), color=colour, ambient=0.3)
    inserted = np.isin(np.arange(len(line)), frame["inserted"])
    plot.add_mesh(parts.balls(line[~inserted], 1.1 * radius), color=colour, ambient=0.3, specular=0.5)
    if inserted.any():
        plot.add_mesh(parts.balls(line[inserted], 1.3 * radius), color=parts.INSERTED, ambient=0.35, specular=0.5)


def contacts_of(frames):
    """Points and normals of the contacts of all frames, every so many of them."""
    contacts = [contact for frame in frames for contact in frame["contacts"]]
    some = [contacts[i] for i in np.linspace(0, len(contacts) - 1, min(MOST_CONTACTS, len(contacts))).astype(int)]
    cloud = pyvista.PolyData(np.array([c["point"] for c in some]).reshape(-1, 3))
    cloud.point_data["normal"] = np.array([c["normal"] for c in some]).reshape(-1, 3)
    return cloud


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        data = json.load(file)
    frames, summary = data["frames"], data["summary"]
    wall = pyvista.PolyData.from_regular_faces(np.array(data["wall"]["positions"]).reshape(-1, 3),
                                               np.array(data["wall"]["triangles"]).reshape(-1, 3))
    moments = np.linspace(0, len(frames) - 1, len(MOMENTS) + 1).astype(int)[1:]
    right, up, towards = parts.view_axes(wall.points)
    drawn = np.concatenate([wall.points] + [points_of(frames[frame]) for frame in moments])
    low, high = (np.array([pick(drawn @ axis) for axis in (right, up, towards)]) for pick in (np.min, np.max))
    size, span = (high - low)[:2]
    radius = 0.0035 * size

    plot = parts.new_plot()
    plot.add_mesh(parts.glass(wall, towards, parts.WALL, 0.07, 0.55), scalars="rgba", rgba=True, smooth_shading=True,
                  specular=0.3, ambient=0.35)
    for frame, colour in zip(moments, MOMENTS):
        add_catheter(plot, frames[frame], colour, radius)
    if any(frame["contacts"] for frame in frames):  # a rod keeps away from walls and seldom touches them
        plot.add_mesh(parts.arrows(contacts_of(frames), 5 * radius, MOST_CONTACTS), color=parts.NORMAL, ambient=0.4)
    parts.save(plot, sys.argv[2], (low + high) / 2 @ np.array([right, up, towards]), towards, up, 4 * size,
               max(span * 1.12, size * 1.06 * parts.HEIGHT / parts.WIDTH) / 2)
    times = ", ".join(f"{frames[frame]['time']:.3g} s" for frame in moments)
    print(f"{data['title']} after {times} (purple to orange), exactly free at {summary['demo.exactly_free_steps']:,} of "
          f"{summary['demo.steps']:,} steps, {100 * summary['demo.reached_share']:.0f} % of the way; inserted vertices "
          "yellow, normals of contacts green")


if __name__ == "__main__":
    main()
