"""Environments of meshes."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from .. import errors
from ..environment import Environment
from . import collapsed, linear, orient
from .labels import regions_of
from .mesh import Mesh


def is_surface(mesh: Mesh) -> bool:
    """Whether a mesh is a surface in space, rather than volumes or a mesh of the plane."""
    return bool(linear.DIMENSION[mesh.types[0]] == 2 and np.any(mesh.points[:, 2:] != 0))


def environment_of(mesh: Mesh, regions: str | None, options: dict[str, Any]) -> Environment:
    """An environment of a mesh of volumes or of the plane. regions: name of the cell data that labels cells. options: as of Environment."""
    if linear.DIMENSION[mesh.types[0]] == 2:
        mesh = dataclasses.replace(mesh, points=np.ascontiguousarray(mesh.points[:, :2]))

    def create(right: Mesh) -> Environment:
        labels, names = regions_of(right, regions)
        made = Environment(right.points, right.connectivity, right.types, right.offsets, regions=labels, region_names=names, **options)
        made._notes = tuple(right.notes)
        return made

    try:
        return orient.created(mesh, create)
    except errors.BadCell:
        opened = collapsed.opened(mesh)
        if opened is None:
            raise
        return orient.created(opened, create)
