#!/usr/bin/env python3
"""A picture of what dartsweep_replay --draw FOLDER has written: FOLDER/replay.png. Needs ../demo/requirements.txt."""

import pathlib
import sys

import pyvista


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: draw.py FOLDER")
    folder = pathlib.Path(sys.argv[1])
    plot = pyvista.Plotter(off_screen=True, window_size=(1400, 1000))
    plot.set_background("white")
    found = []
    for file in sorted(folder.glob("*.vtu")):
        mesh = pyvista.read(file)
        if file.stem == "walls":
            plot.add_mesh(mesh, color="lightgrey", opacity=0.15)
            continue
        found.append(mesh)
        colour = "orange" if file.stem.startswith("before_") else "seagreen"
        if "contacts" in file.stem:
            plot.add_mesh(mesh, color="crimson", point_size=12, render_points_as_spheres=True)
        else:
            plot.add_mesh(mesh, color=colour, line_width=4, point_size=10, render_points_as_spheres=True)
    if found:  # near what moves, not all of the environment
        bounds = pyvista.merge(found).bounds
        plot.reset_camera(bounds=bounds)
    plot.add_text("orange: before, green: after, red: contacts", font_size=10, color="black")
    plot.screenshot(str(folder / "replay.png"))


main()
