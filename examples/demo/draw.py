"""Draws what the demo's C program wrote: the wall, the cloud, the chain and the contact normals.

usage: draw.py FOLDER TITLE
"""
import os
import sys

os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")  # needs no display, only libOSMesa

import numpy as np
import pyvista
from PIL import Image

WIDTH, HEIGHT = 1200, 700
WALL, SLEEVE, CHAIN, NORMAL, INK = "#c8414b", "#8b7d72", "#1c6fa8", "#1e9e6a", "#22303a"


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


def draw(folder, title):
    read = lambda name: pyvista.read(os.path.join(folder, name))
    wall, outer, cloud, chain, contacts = map(read, ("wall.vtu", "outer.vtu", "demo.vtu", "chain.vtu", "contacts.vtu"))
    rows = counts(folder)
    used = wall.points[np.unique(wall.cells_dict[pyvista.CellType.TRIANGLE])]
    right, up, towards = view_axes(used)
    low, high = (np.array([pick(used @ axis) for axis in (right, up, towards)]) for pick in (np.min, np.max))
    size, span = (high - low)[:2]
    scale = max(span * 1.32, size * 1.12 * HEIGHT / WIDTH) / 2
    middle = (low + high) / 2 @ np.array([right, up, towards])

    plot = pyvista.Plotter(off_screen=True, window_size=(WIDTH, HEIGHT), lighting="light kit")
    plot.set_background("white")
    plot.enable_depth_peeling(12)
    plot.enable_anti_aliasing("ssaa")
    fits = max(np.ptp(outer.points @ right) / size, np.ptp(outer.points @ up) / span) < 1.3
    if fits and outer.n_cells != wall.n_cells:
        plot.add_mesh(glass(outer, towards, SLEEVE, 0.0, 0.10), scalars="rgba", rgba=True, lighting=False)
    plot.add_mesh(glass(wall, towards, WALL, 0.07, 0.62), scalars="rgba", rgba=True, smooth_shading=True,
                  specular=0.3, ambient=0.35)
    hits = cloud.point_data["contacts"]
    dots = plot.add_mesh(cloud, scalars="contacts", cmap="plasma", clim=(0, max(1, np.percentile(hits, 90))),
                         render_points_as_spheres=True, point_size=4.5, ambient=0.4, show_scalar_bar=False)
    radius = 0.0055 * size
    plot.add_mesh(chain.extract_surface(algorithm="dataset_surface").tube(radius=0.5 * radius), color=CHAIN, ambient=0.3)
    plot.add_mesh(pyvista.PolyData(chain.points).glyph(geom=pyvista.Sphere(radius=1.25 * radius), scale=False,
                                                       orient=False), color=CHAIN, ambient=0.3, specular=0.5)
    if contacts.n_points > 0:
        some = contacts.extract_points(np.linspace(0, contacts.n_points - 1, min(160, contacts.n_points)).astype(int))
        arrow = pyvista.Arrow(tip_length=0.35, tip_radius=0.11, shaft_radius=0.035)
        length = np.clip(1.3 * float(rows["radius of the lumen, about"][0]), 0.012 * size, 0.03 * size)
        plot.add_mesh(some.glyph(geom=arrow, orient="normal", scale=False, factor=length), color=NORMAL, ambient=0.4)
    plot.add_scalar_bar("wall contacts of a particle", mapper=dots.mapper, title_font_size=15, label_font_size=14,
                        color=INK, n_labels=3, fmt="%.0f", width=0.24, height=0.06, position_x=0.73, position_y=0.03)
    plot.add_text(title, position=(28, HEIGHT - 46), font_size=13, color=INK, font="arial")
    fact = lambda key: f"{int(rows[key][0]):,}"
    plot.add_text(f"{fact('casts')} casts, {fact('contacts')} contacts, verified free: {rows['verified free'][0]}",
                  position=(28, HEIGHT - 76), font_size=9, color=INK, font="arial")
    plot.add_text("chain of 20 (blue), contact normals (green)", position=(28, 24), font_size=9, color=INK,
                  font="arial")
    plot.enable_parallel_projection()
    plot.camera.focal_point = middle
    plot.camera.position = middle + 4 * size * towards
    plot.camera.up = up
    plot.camera.parallel_scale = scale
    plot.reset_camera_clipping_range()
    picture = Image.fromarray(plot.screenshot(None, return_img=True))
    picture.quantize(256, kmeans=2, dither=Image.Dither.NONE).save(os.path.join(folder, "demo.png"), optimize=True)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(sys.argv[1], sys.argv[2])
