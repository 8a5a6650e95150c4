"""Environments of meshes that were read: labels and groups of cells become regions, groups of faces become surfaces."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .. import errors
from ..environment import Environment
from .error import MeshError
from . import collapsed, faces, orient, own, repeated
from .labels import regions_of
from .mesh import Mesh
from .plane import flatten


_SAYS_WHAT_TOUCHES = ("merge_points", "conform", "inner_walls")


def environment_of(mesh: Mesh, regions: str | None, options: dict[str, Any]) -> Environment:
    """An environment of a mesh of volumes or of the plane. regions: name of the array, or group, that labels cells. options: as of
    Environment."""
    given = options
    mesh, plane = flatten(own.restored(mesh))
    labels, names = regions_of(mesh, regions)
    options = {"tags": mesh.cell_data.get(own.TAGS, mesh.cell_data.get(own.INPUT)), **options}
    options["region_names"] = {**names, **(options.get("region_names") or {})}
    if mesh.hangs and not any(name in options for name in _SAYS_WHAT_TOUCHES):
        options["conform"] = True

    def create(right: Mesh, **more: Any) -> Environment:
        made = Environment(right.points, right.connectivity, right.types, right.offsets, regions=labels, **{**options, **more})
        if more:
            right.notes.append(_split_note(made, len(right.types)))
        faces.name(made, right)
        made._names.notes, made._names.plane = tuple(right.notes), plane
        own.mark(made, right)
        return made

    try:
        return _created(mesh, create, "split" not in options and own.TAGS not in mesh.cell_data)
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


def _created(mesh: Mesh, create: Callable[..., Environment], may_split: bool) -> Environment:
    try:
        return orient.created(mesh, create)
    except (errors.BadCell, errors.InvalidCell) as error:
        opened = collapsed.opened(mesh)
        if opened is None and not (may_split and isinstance(error, errors.InvalidCell)):
            raise
    if opened is not None:
        return _created(opened, create, may_split)
    return orient.created(mesh, lambda right: create(right, split=True))


def _split_note(made: Environment, count: int) -> str:
    split = made._core.build_report().split_count
    return f"{split} of {count} cells were split into parts: the mean of their points does not see all of their faces; parent() of a part gives its cell"


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
