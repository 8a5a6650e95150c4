"""What the pictures of the demo have in common: colours, a translucent wall, arrows, a plot without a display."""
import os

os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")  # needs no display, only libOSMesa

import numpy as np
import pyvista
from PIL import Image

WIDTH, HEIGHT = 1200, 700
WALL, SLEEVE, NORMAL, INK = "#c8414b", "#8b7d72", "#1e9e6a", "#22303a"
CATHETER, STATIC, INSERTED, STONE = "#1c6fa8", "#e08a1e", "#f2d31b", "#c3c9ce"
TISSUE = "#c98b7d"


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
