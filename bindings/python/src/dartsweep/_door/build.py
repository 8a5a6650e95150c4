"""Environments of meshes that were read: labels and groups of cells become regions, groups of faces become surfaces."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .. import errors
from ..environment import Environment
from .error import MeshError
from . import collapsed, orient, own, repeated
from .labels import FACE_LABELS, regions_of
from .mesh import Indices, Mesh
from .plane import flatten


_SAYS_WHAT_TOUCHES = ("merge_points", "conform", "inner_walls")


def environment_of(mesh: Mesh, regions: str | None, options: dict[str, Any]) -> Environment:
    """An environment of a mesh of volumes or of the plane. regions: name of the array, or group, that labels cells. options: as of
    Environment."""
    given = options
    mesh, plane = flatten(own.restored(mesh))
    labels, names = regions_of(mesh, regions)
    options = {"tags": mesh.cell_data.get(own.TAGS), **options}
    options["region_names"] = {**names, **(options.get("region_names") or {})}
    if mesh.hangs and not any(name in options for name in _SAYS_WHAT_TOUCHES):
        options["conform"] = True

    def create(right: Mesh) -> Environment:
        made = Environment(right.points, right.connectivity, right.types, right.offsets, regions=labels, **options)
        _name_surfaces(made, right)
        made._names.notes, made._names.plane = tuple(right.notes), plane
        own.mark(made, right)
        return made

    try:
        return _created(mesh, create)
    except errors.OutOfMemory:
        raise
    except errors.DuplicateCell as error:
        different = repeated.left_out(mesh)
        if different is None:
            raise MeshError(mesh.source, str(error), _way_on(error)) from error
    except (errors.Error, TypeError, OverflowError) as error:
        found = error.found if isinstance(error, errors.TouchingParts) else str(error)
        raise MeshError(mesh.source, found, _way_on(error)) from error
    return environment_of(different, regions, given)


def _created(mesh: Mesh, create: Callable[[Mesh], Environment]) -> Environment:
    try:
        return orient.created(mesh, create)
    except (errors.BadCell, errors.InvalidCell):
        opened = collapsed.opened(mesh)
        if opened is None:
            raise
        return orient.created(opened, create)


def _way_on(error: Exception) -> str:
    if isinstance(error, errors.TouchingParts):
        return error.way_on
    if isinstance(error, errors.NotConforming):
        return "merge_points= says how far points may be apart, and inner_walls=True leaves such faces as walls"
    if isinstance(error, errors.InvertedCell):
        return "flags=EnvironmentFlag.REORIENT turns each cell that is inside out"
    if isinstance(error, (TypeError, OverflowError)):
        return "regions= names another array, and Environment takes labels that you have converted"
    return "the program that made the mesh may mend it, and `dartsweep.Environment` takes arrays that you have changed"


# --- surfaces


def _name_surfaces(made: Environment, mesh: Mesh) -> None:
    groups, tags = dict(mesh.face_groups), dict(mesh.face_numbers)
    if not groups:
        groups, tags = _groups_of_labels(mesh)
    groups = {name: faces for name, faces in groups.items() if len(faces)}
    if not groups:
        return
    surfaces = made._names.surfaces
    surfaces.add(mesh.face_offsets, mesh.face_vertices, groups, {name: tags[name] for name in groups if name in tags})
    missing = surfaces.ids(made)["generation"] == 0
    for name, faces in groups.items():
        lost = int(missing[faces].sum())
        if lost:
            mesh.notes.append(f"{lost} of {len(faces)} faces of the surface {name!r} are faces of no cell")


def _groups_of_labels(mesh: Mesh) -> tuple[dict[str, Indices], dict[str, int]]:
    """Faces that carry labels without names: each label is a surface, and its name is the number."""
    for usual in FACE_LABELS:
        array = np.asarray(mesh.face_data.get(usual, ()))
        if array.dtype.kind not in "iu" or array.shape != (len(mesh.face_offsets) - 1,):
            continue
        numbers = [int(number) for number in np.unique(array)]
        return {str(number): np.flatnonzero(array == number) for number in numbers}, {str(number): number for number in numbers}
    return {}, {}
