"""A catheter in a mesh file: catheter.py [MESH [PICTURE]]

MESH is any volume mesh that meshio reads; without it a bent tube of hexahedra is made here. The catheter is pushed along the mesh from
a volume near its end of least z, slides where it touches, and what it has touched is told. With PICTURE (.png) and PyVista
the scene is drawn.
"""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

import dartsweep as ds

LINKS = 12


def tube() -> ds.Environment:
    """A square tube of 4 x 4 x 40 hexahedra along a parabola."""
    place = np.stack(np.meshgrid(np.arange(5.0), np.arange(5.0), np.arange(41.0), indexing="ij"), axis=-1)
    points = place.reshape(-1, 3)
    points[:, 0] += 0.01 * points[:, 2] ** 2
    index = np.arange(len(points)).reshape(5, 5, 41)
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = np.stack([index[a : a + 4, b : b + 4, c : c + 40].ravel() for a, b, c in corners], axis=1)
    return ds.Environment(points, cells)


def centres(environment: ds.Environment) -> NDArray[np.float64]:
    return np.array([environment.centre(environment.volume_id(i)) for i in range(environment.info.volume_count)])


def push(scene: ds.Scene, start: NDArray[np.float64], step: float) -> tuple[ds.Body, dict[int, int]]:
    """Pushes a short chain along z, tip last; answers contacts by index of the volume in front of the wall."""
    chain = start + np.outer(np.arange(LINKS), (0.0, 0.0, 0.25 * step))
    body = scene.create_body(chain, [(i, i + 1) for i in range(LINKS - 1)])
    slide = ds.options(ds.MoveOptions, vertex_response=ds.Response.SLIDE, edge_response=ds.Response.SLIDE)
    touched: dict[int, int] = {}
    for _ in range(60):
        positions = body.positions()
        forward = np.vstack([positions[1:], 2 * positions[-1] - positions[-2]]) - positions
        body.move(positions + 0.5 * step * forward / np.linalg.norm(forward, axis=1, keepdims=True), slide)
        for contact in body.contacts():
            volume = int(contact["contact"]["front"]["index"])
            touched[volume] = touched.get(volume, 0) + 1
    return body, touched


def main() -> None:
    with ds.meshes.read(sys.argv[1]) if len(sys.argv) > 1 else tube() as environment:
        middle = centres(environment)
        start = middle[np.argsort(middle[:, 2])[len(middle) // 20]]
        step = float(np.ptp(middle[:, 2])) / 40
        with ds.Scene(environment) as scene:
            body, touched = push(scene, start, step)
            print(f"{environment}: the tip went from z = {start[2]:.2f} to {body.positions()[-1, 2]:.2f}")
            print(f"{sum(touched.values())} contacts in {len(touched)} volumes")
            if len(sys.argv) > 2:
                import pyvista

                from dartsweep import plot

                plot.draw(scene, pyvista.Plotter(off_screen=True)).screenshot(sys.argv[2])


if __name__ == "__main__":
    main()
