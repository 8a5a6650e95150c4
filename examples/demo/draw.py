"""Draws what the demo's C program wrote: the vessel with cloud and catheters, the surface among the pyramids.

usage: draw.py FOLDER TITLE
"""
import os
import sys

os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")  # needs no display, only libOSMesa

import numpy as np
import pyvista
from PIL import Image

WIDTH, HEIGHT = 1200, 700
WALL, SLEEVE, NORMAL, INK = "#c8414b", "#8b7d72", "#1e9e6a", "#22303a"
CATHETER, STATIC, INSERTED, STONE = "#1c6fa8", "#e08a1e", "#f2d31b", "#c3c9ce"


def view_axes(points):
    """Right, up and towards the viewer: the longest extent lies across the picture, the shortest along the view."""
    centred = points - points.mean(axis=0)
    _, _, axes = np.linalg.svd(centred[:: max(1, len(points) // 4000)], full_matrices=False)
    right, up = (axis * (1 if axis[np.argmax(np.abs(axis))] > 0 else -1) for axis in axes[:2])
    towards = np.cross(right, up)
    tilt = np.radians(14)
    return right, np.cos(tilt) * up - np.sin(tilt) * towards, np.cos(tilt) * towards + np.sin(tilt) * up


def glass(surface, towards, colour, least, most):
    """A surface that is clear where it faces the viewer and dense where it turns away."""
    surface = surface.extract_surface(algorithm="dataset_surface").clean()
    surface = surface.compute_normals(split_vertices=False, auto_orient_normals=False, consistent_normals=True)
    turned = 1 - np.abs(surface.point_data["Normals"] @ towards)
    rgba = np.empty((surface.n_points, 4), np.uint8)
    rgba[:, :3] = np.array(pyvista.Color(colour).int_rgb)
    rgba[:, 3] = np.clip(255 * (least + (most - least) * turned**2), 0, 255)
    surface.point_data["rgba"] = rgba
    return surface


def counts(folder):
    """The table's lines, by their label."""
    with open(os.path.join(folder, "summary.txt"), encoding="utf-8") as lines:
        return {line[:28].strip(): line[28:].split() for line in lines if len(line) > 30}


def arrows(contacts, length, most=160):
    """Normals at contacts, every so many of them."""
    some = contacts.extract_points(np.linspace(0, contacts.n_points - 1, min(most, contacts.n_points)).astype(int))
    arrow = pyvista.Arrow(tip_length=0.35, tip_radius=0.11, shaft_radius=0.035)
    return some.glyph(geom=arrow, orient="normal", scale=False, factor=length)


def balls(points, radius):
    return pyvista.PolyData(points).glyph(geom=pyvista.Sphere(radius=radius), scale=False, orient=False)


def new_plot():
    plot = pyvista.Plotter(off_screen=True, window_size=(WIDTH, HEIGHT), lighting="light kit")
    plot.set_background("white")
    plot.enable_depth_peeling(12)
    plot.enable_anti_aliasing("ssaa")
    return plot


def text(plot, words, x, y, size=9):
    plot.add_text(words, position=(x, y), font_size=size, color=INK, font="arial")


def save(plot, path, middle, towards, up, distance, scale):
    plot.enable_parallel_projection()
    plot.camera.focal_point = middle
    plot.camera.position = middle + distance * towards
    plot.camera.up = up
    plot.camera.parallel_scale = scale
    plot.reset_camera_clipping_range()
    picture = Image.fromarray(plot.screenshot(None, return_img=True))
    picture.quantize(256, kmeans=2, dither=Image.Dither.NONE).save(path, optimize=True)


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
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    table = counts(sys.argv[1])
    draw_vessel(sys.argv[1], sys.argv[2], table)
    draw_surface(sys.argv[1], table)
