"""A guide wire is pushed through a vessel: guidewire.py [VESSEL [PICTURE]]    a surface or a volume mesh, mm; without one a bent tube"""

import sys

import numpy as np
import pyvista

import dartsweep as ds
from dartsweep import plot, rod

if len(sys.argv) == 1:  # rings of 16 points, radius 2.5 mm, along a helix
    turn, around = np.meshgrid(np.linspace(0, 2, 50), np.arange(16) * np.pi / 8, indexing="ij")
    out = 30 + 2.5 * np.cos(around)
    points = np.stack([out * np.cos(turn), out * np.sin(turn), 6 * turn + 2.5 * np.sin(around)], axis=-1).reshape(-1, 3)
    b = np.roll(a := np.arange(49 * 16).reshape(49, 16), -1, axis=1)
    vessel = ds.from_surface((points, np.array([[a, b, b + 16], [a, b + 16, a + 16]]).transpose(0, 2, 3, 1).reshape(-1, 3)))
else:
    vessel = (ds.from_surface if sys.argv[1][-4:] in (".stl", ".obj", ".ply") else ds.meshes.read)(sys.argv[1])
if vessel.region_names.get("tissue") in vessel.regions():
    vessel.mark_region("tissue")  # impassable
length = rod.length_of(way := rod.centreline(vessel))
with ds.Scene(vessel) as scene:
    wire = rod.Rod(scene, way[0], rod.place_on(way, 4) - way[0], length=length + 40, segment=2, radius=0.45, bending=1e6)
    wire.way, stretch, gap = way, 0.0, wire.radius  # the tip is pulled along the way
    while wire.reached(way) < length - 1 and wire.push(1) > 0.5:
        stretch, gap = max(stretch, wire.largest_stretch()), min(gap, wire.smallest_gap())
    print(f"the tip came to {wire.reached(way):.1f} of {length:.1f} mm; the middle line is {'' if wire.is_free() else 'not '}free")
    print(f"largest stretch {stretch:.2%}, smallest gap {gap:.4f} mm")
    if pyvista.system_supports_plotting():
        plot.draw(scene, pyvista.Plotter(off_screen=True)).screenshot(sys.argv[2] if len(sys.argv) > 2 else "guidewire.png")
