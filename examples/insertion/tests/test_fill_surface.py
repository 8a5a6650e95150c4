"""Surfaces that the main job takes: fill_surface.py fills one, and the demo's reader of meshes reads what it writes."""

from __future__ import annotations

import pathlib
import subprocess
import sys

import meshio
import numpy as np
import trimesh

EXAMPLES = pathlib.Path(__file__).parents[2]


def run(program: str, *arguments: pathlib.Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, EXAMPLES / program, *arguments], capture_output=True, text=True, check=False)


def test_a_surface_of_two_parts_with_an_open_end(tmp_path: pathlib.Path) -> None:
    large, small = trimesh.creation.icosphere(), trimesh.creation.icosphere(radius=0.1)
    small.apply_translation((3, 0, 0))
    large.update_faces(large.triangles_center[:, 2] < 0.8)
    surface, filled = tmp_path / "two.stl", tmp_path / "filled.vtu"
    trimesh.util.concatenate([large, small]).export(surface)
    done = run("insertion/fill_surface.py", surface, filled)
    assert done.returncode == 0, done.stderr
    told = done.stdout.splitlines()
    assert told[:2] == ["the surface has 2 parts; the largest is taken", "open ends capped: 1"]
    mesh = meshio.read(filled)
    assert told[2:] == [f"filled two.stl with {len(mesh.cells_dict['tetra'])} tetrahedra"]
    assert mesh.points[:, 0].max() <= 1 and np.isclose(mesh.points[:, 2].max(), large.vertices[np.unique(large.faces)][:, 2].max())

    done = run("demo/read_mesh.py", filled, tmp_path / "mesh.bin")
    assert done.returncode == 0 and (tmp_path / "mesh.bin").read_bytes().startswith(b"DSWMESH1"), done.stderr


def test_bad_surfaces(tmp_path: pathlib.Path) -> None:
    out = tmp_path / "filled.vtu"
    flat = tmp_path / "flat.obj"
    flat.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    done = run("insertion/fill_surface.py", flat, out)
    assert done.returncode == 2 and done.stderr.startswith(f"demo: cannot use surface '{flat}': it is flat")
    done = run("insertion/fill_surface.py", tmp_path / "none.stl", out)
    assert done.returncode == 2 and done.stderr == f"demo: cannot use surface '{tmp_path / 'none.stl'}': No such file or directory\n"
    done = run("insertion/fill_surface.py", flat)
    assert done.returncode == 2 and "usage:" in done.stderr
    assert not out.exists()
