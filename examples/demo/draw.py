"""Draws what the demo's C program wrote: the vessel with cloud and catheters, the surface among the
pyramids, and what changes: the organ that is cut, the vessel that beats, the box that bends.

usage: draw.py FOLDER TITLE ORGAN
"""
import os
import sys

import numpy as np
import pyvista

from draw_parts import (CATHETER, HEIGHT, INK, INSERTED, NORMAL, SLEEVE, STATIC, STONE, TISSUE, WALL,
                        WIDTH, arrows, balls, glass, new_plot, save, text, view_axes)


def counts(folder):
    """The table's lines, by their label."""
    with open(os.path.join(folder, "summary.txt"), encoding="utf-8") as lines:
        return {line[:28].strip(): line[28:].split() for line in lines if len(line) > 30}


def add_catheter(plot, folder, name, colour, radius, normals):
    """Edges as tubes, vertices as balls, those that a response inserted in another colour, contacts with normals."""
    catheter = pyvista.read(os.path.join(folder, f"catheter_{name}.vtu"))
    contacts = pyvista.read(os.path.join(folder, f"catheter_{name}_contacts.vtu"))
    plot.add_mesh(catheter.extract_surface(algorithm="dataset_surface").tube(radius=0.55 * radius), color=colour,
                  ambient=0.3)
    inserted = catheter.point_data["inserted"] > 0
    plot.add_mesh(balls(catheter.points[~inserted], 1.2 * radius), color=colour, ambient=0.3, specular=0.5)
    if inserted.any():
        plot.add_mesh(balls(catheter.points[inserted], 1.5 * radius), color=INSERTED, ambient=0.35, specular=0.5)
    if normals and contacts.n_points > 0:
        plot.add_mesh(arrows(contacts, 9 * radius), color=NORMAL, ambient=0.4)


def draw_vessel(folder, title, rows):
    read = lambda name: pyvista.read(os.path.join(folder, name))
    wall, outer, cloud = map(read, ("wall.vtu", "outer.vtu", "demo.vtu"))
    used = wall.points[np.unique(wall.cells_dict[pyvista.CellType.TRIANGLE])]
    right, up, towards = view_axes(used)
    low, high = (np.array([pick(used @ axis) for axis in (right, up, towards)]) for pick in (np.min, np.max))
    size, span = (high - low)[:2]
    scale = max(span * 1.32, size * 1.12 * HEIGHT / WIDTH) / 2
    middle = (low + high) / 2 @ np.array([right, up, towards])

    plot = new_plot()
    fits = max(np.ptp(outer.points @ right) / size, np.ptp(outer.points @ up) / span) < 1.3
    if fits and outer.n_cells != wall.n_cells:
        plot.add_mesh(glass(outer, towards, SLEEVE, 0.0, 0.10), scalars="rgba", rgba=True, lighting=False)
    plot.add_mesh(glass(wall, towards, WALL, 0.07, 0.62), scalars="rgba", rgba=True, smooth_shading=True,
                  specular=0.3, ambient=0.35)
    hits = cloud.point_data["contacts"]
    dots = plot.add_mesh(cloud, scalars="contacts", cmap="plasma", clim=(0, max(1, np.percentile(hits, 90))),
                         render_points_as_spheres=True, point_size=3.6, opacity=0.8, ambient=0.4,
                         show_scalar_bar=False)
    radius = 0.0045 * size
    add_catheter(plot, folder, "static", STATIC, radius, False)
    add_catheter(plot, folder, "adaptive", CATHETER, radius, True)
    plot.add_scalar_bar("wall contacts of a particle", mapper=dots.mapper, title_font_size=15, label_font_size=14,
                        color=INK, n_labels=3, fmt="%.0f", width=0.24, height=0.06, position_x=0.73, position_y=0.03)
    text(plot, title, 28, HEIGHT - 46, 13)
    number = lambda key, i: f"{int(rows[key][i]):,}"
    text(plot, f"cloud: {number('casts', 0)} casts, {number('contacts', 0)} contacts, "
         f"verified free: {rows['verified free'][0]}", 28, HEIGHT - 76)
    touches, inserted = [number("contacts of bodies", i) for i in (0, 1)], number("vertices inserted", 1)
    text(plot, f"catheter, static: {touches[0]} contacts (orange); adaptive: {touches[1]} contacts, {inserted} vertices "
         "inserted (blue, yellow)", 28, HEIGHT - 98)
    text(plot, "normals of the last contacts of the adaptive one (green)", 28, 24)
    save(plot, os.path.join(folder, "demo.png"), middle, towards, up, 4 * size, scale)


def frame_of(points):
    """The axes of view_axes, and the box of the points along them."""
    axes = view_axes(points)
    low, high = (np.array([pick(points @ axis) for axis in axes]) for pick in (np.min, np.max))
    return (*axes, low, high)


def used_points(mesh):
    return mesh.points[np.unique(mesh.cells_dict[pyvista.CellType.TRIANGLE])]


def draw_scalpel(folder, rows, column):
    read = lambda name: pyvista.read(os.path.join(folder, name))
    tissue, blades, probe = map(read, ("tissue.vtu", "scalpel.vtu", "probe.vtu"))
    skin = tissue.extract_surface(algorithm="dataset_surface").clean()
    rod = probe.points - probe.points.mean(axis=0)
    up = np.linalg.svd(rod, full_matrices=False)[2][0]
    up *= np.sign((probe.points[1] - probe.points[0]) @ up)
    along = blades.points[-1] - blades.points[0]
    along = along - (along @ up) * up
    along /= np.linalg.norm(along)
    towards = 0.75 * up + 0.62 * np.cross(up, along) + 0.2 * along
    towards /= np.linalg.norm(towards)
    plot = new_plot()
    plot.add_mesh(skin, color=TISSUE, show_edges=True, edge_color="#8c5046", line_width=1, ambient=0.25, specular=0.2)
    plot.add_mesh(probe.extract_surface(algorithm="dataset_surface").compute_normals(split_vertices=False),
                  color=CATHETER, smooth_shading=True, ambient=0.25, specular=0.6)
    length = np.linalg.norm(probe.points[1] - probe.points[0])
    plot.add_mesh(pyvista.lines_from_points(blades.points[0::2]).tube(radius=0.006 * length), color=INK)
    number = lambda key: f"{int(rows[key][column]):,}"
    text(plot, f"A scalpel cuts {sys.argv[3]}, a probe enters the cut", 28, HEIGHT - 46, 13)
    text(plot, f"{number('volumes at the end')} volumes; {number('cuts or deformations')} changes, "
         f"{rows['ms for each change'][column]} ms each; probe free after every step: {rows['free after every step'][column]}",
         28, HEIGHT - 76)
    text(plot, f"way of the scalpel (black), probe (blue): it touches {rows['floor of the cut'][-1]} below the surface, the floor "
         f"of the cut is at {rows['floor of the cut'][0]}", 28, 24)
    save(plot, os.path.join(folder, "scalpel.png"), blades.points.mean(axis=0) + 0.45 * length * up, towards, up,
         20 * length, 1.6 * length)


def draw_beating(folder, rows, column):
    read = lambda name: pyvista.read(os.path.join(folder, name))
    rest, wall = map(read, ("wall.vtu", "beating.vtu"))
    right, up, towards, low, high = frame_of(used_points(rest))
    size, span = (high - low)[:2]
    plot = new_plot()
    plot.add_mesh(glass(rest, towards, SLEEVE, 0.0, 0.30), scalars="rgba", rgba=True, lighting=False)
    plot.add_mesh(glass(wall, towards, WALL, 0.10, 0.75), scalars="rgba", rgba=True, smooth_shading=True,
                  specular=0.3, ambient=0.35)
    add_catheter(plot, folder, "beaten", CATHETER, 0.0045 * size, True)
    number = lambda key: f"{int(rows[key][column]):,}"
    text(plot, "A vessel that beats squeezes a catheter", 28, HEIGHT - 46, 13)
    text(plot, f"{number('cuts or deformations')} deformations, {rows['ms for each change'][column]} ms each; "
         f"{number('contacts of walls')} contacts of the wall, vertices pushed {number('vertices pushed')} times; free after every step: "
         f"{rows['free after every step'][column]}", 28, HEIGHT - 76)
    text(plot, "at rest (grey), squeezed (red), catheter with inserted vertices (blue, yellow), normals where the wall has "
         "pushed it (green)", 28, 24)
    save(plot, os.path.join(folder, "beating.png"), (low + high) / 2 @ np.array([right, up, towards]), towards, up,
         4 * size, max(span * 1.32, size * 1.12 * HEIGHT / WIDTH) / 2)


def draw_box(folder, rows, column):
    read = lambda name: pyvista.read(os.path.join(folder, name))
    box = read("box.vtu").extract_surface(algorithm="dataset_surface")
    towards = np.array([0.35, -0.85, 0.40])
    towards /= np.linalg.norm(towards)
    plot = new_plot()
    plot.add_mesh(glass(box, towards, SLEEVE, 0.05, 0.25), scalars="rgba", rgba=True, lighting=False)
    plot.add_mesh(box.extract_all_edges(), color="#9aa4ac", line_width=1, opacity=0.35)
    low, high = np.array(box.bounds).reshape(3, 2).T
    size = np.max(high - low)
    for name, colour in (("ring_one", CATHETER), ("ring_two", STATIC)):
        ring = read(f"{name}.vtu").extract_surface(algorithm="dataset_surface").compute_normals(split_vertices=False)
        plot.add_mesh(ring, color=colour, smooth_shading=True, specular=0.3, ambient=0.25)
        contacts = read(f"{name}_contacts.vtu")
        if contacts.n_points > 0:
            plot.add_mesh(arrows(contacts, 0.05 * size, 120), color=NORMAL, ambient=0.4)
    number = lambda key: f"{int(rows[key][column]):,}"
    text(plot, "Two soft rings collide in a box that bends, level FACES", 28, HEIGHT - 46, 13)
    text(plot, f"{number('vertices of bodies')} vertices, {number('contacts of bodies')} contacts, "
         f"{number('of these with bodies')} of them with each other; free after every step: {rows['free after every step'][column]}", 28, HEIGHT - 76)
    text(plot, "normals of the last contacts (green)", 28, 24)
    save(plot, os.path.join(folder, "box.png"), (low + high) / 2 + np.array([0, 0, 0.03 * size]), towards,
         np.array([0, 0, 1.0]), 6 * size, 0.84 * size)


def draw_surface(folder, rows):
    read = lambda name: pyvista.read(os.path.join(folder, name))
    surface, obstacles, contacts = map(read, ("surface.vtu", "obstacles.vtu", "surface_contacts.vtu"))
    plot = new_plot()
    plot.add_mesh(obstacles.extract_surface(algorithm="dataset_surface"), color=STONE, show_edges=True,
                  edge_color="#7d868e", ambient=0.3)
    body = surface.extract_surface(algorithm="dataset_surface").compute_normals(split_vertices=False)
    hits = body.point_data["contacts"]
    skin = plot.add_mesh(body, scalars="contacts", cmap=["#e9c1a4", "#d9653b", "#8c1d18"], smooth_shading=True,
                         clim=(0, max(1, np.percentile(hits[hits > 0], 90) if (hits > 0).any() else 1)),
                         specular=0.25, ambient=0.25, show_scalar_bar=False)
    low, high = np.array(obstacles.bounds).reshape(3, 2).T
    size = np.max(high - low)
    if contacts.n_points > 0:
        plot.add_mesh(arrows(contacts, 0.055 * size, 250), color=NORMAL, ambient=0.4)
    plot.add_scalar_bar("contacts of a vertex", mapper=skin.mapper, title_font_size=15, label_font_size=14, color=INK,
                        n_labels=3, fmt="%.0f", width=0.24, height=0.06, position_x=0.73, position_y=0.03)
    number = lambda key: f"{int(rows[key][-1]):,}"
    text(plot, f"A closed surface of {number('vertices at the end')} vertices on pyramids, level FACES", 28,
         HEIGHT - 46, 13)
    time = f"{float(rows['ms per step'][-1]):.3g} ms a step"
    text(plot, f"{number('contacts of bodies')} contacts in {rows['steps'][-1]} steps, {time}, "
         f"verified free: {rows['bodies verified free'][-1]}; normals of the last step (green)", 28, HEIGHT - 76)
    towards = np.array([0.42, -0.80, 0.40])
    middle = (low + high) / 2 + np.array([0, 0, 0.03 * size])
    save(plot, os.path.join(folder, "surface.png"), middle, towards / np.linalg.norm(towards), np.array([0, 0, 1.0]),
         6 * size, 0.47 * size)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    table = counts(sys.argv[1])
    draw_vessel(sys.argv[1], sys.argv[2], table)
    draw_surface(sys.argv[1], table)
    for column, draw in enumerate((draw_scalpel, draw_beating, draw_box)):
        draw(sys.argv[1], table, column)
