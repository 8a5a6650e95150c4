"""Names of regions and of surfaces: what a mesh calls its cells and faces."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, Union, cast

import numpy as np
from numpy.typing import NDArray

from . import dtypes
from .enums import CellKind, Mark
from .errors import NotFound

if TYPE_CHECKING:
    from ._shapes import Ids, Records
    from .environment import Environment

Labels = Union[int, Sequence[int]]
Method = TypeVar("Method", bound=Callable[..., Any])


MOST_CHANGES = 256
"""Changes of the topology that wait until somebody asks for faces."""


class PlaneFrame(NamedTuple):
    """Where a mesh of the plane lay in space: a point (x, y) is at origin + x * axes[0] + y * axes[1]."""

    origin: NDArray[np.float64]
    axes: NDArray[np.float64]


class Names:
    """What an environment calls its cells and faces, and what was said of the mesh that it was made of."""

    def __init__(self, regions: Mapping[str, Labels] | None = None) -> None:
        self.regions = {name: tuple(np.atleast_1d(labels).tolist()) for name, labels in (regions or {}).items()}
        self.surfaces = Surfaces()
        self.notes: tuple[str, ...] = ()
        self.plane: PlaneFrame | None = None

    def copy(self) -> Names:
        """Names for an environment that has the vertices of this one."""
        made = Names(self.regions)
        made.surfaces, made.notes, made.plane = self.surfaces.copy(), self.notes, self.plane
        return made


class Surfaces:
    """Named sets of faces, in the plane of sides. A face is kept by its vertices, so it is found again when cells around it change. Parts of
    a face that was cut are found by the vertices from which new ones come."""

    def __init__(self) -> None:
        self.tags: dict[str, int] = {}
        self.members: dict[str, NDArray[np.int64]] = {}  # of each name: which faces
        self.offsets: NDArray[np.int64] = np.zeros(1, np.int64)
        self.vertices: NDArray[np.int64] = np.empty(0, np.int64)
        self.changes: list[Any] = []  # of the topology, since ids were found
        self._ids: Records | None = None
        self._owners: tuple[NDArray[np.uint64], NDArray[np.uint32], NDArray[np.int64]] | None = None

    def copy(self) -> Surfaces:
        """Copies names and faces, whose ids are to be found again."""
        made = Surfaces()
        made.tags, made.members = dict(self.tags), dict(self.members)
        made.offsets, made.vertices, made.changes = self.offsets, self.vertices, list(self.changes)
        return made

    def add(self, offsets: NDArray[np.int64], vertices: NDArray[np.int64], groups: Mapping[str, NDArray[np.int64]], tags: Mapping[str, int]) -> None:
        """Adds faces by their vertices, and names of some of them. Names without a tag get the next free one."""
        count = len(self.offsets) - 1
        self.offsets = np.concatenate([self.offsets, offsets[1:] - offsets[0] + self.offsets[-1]])
        self.vertices = np.concatenate([self.vertices, vertices])
        for name, members in groups.items():
            self.members[name] = np.concatenate([self.members.get(name, np.empty(0, np.int64)), np.asarray(members, np.int64) + count])
        self.tags.update(tags)
        for name in groups:
            self.tags.setdefault(name, max(self.tags.values(), default=0) + 1)
        self._ids = self._owners = None

    def ids(self, environment: Environment) -> Records:
        """The id of each face; null for one that is no more."""
        if self.changes:
            self._follow(environment)
        if self._ids is None:
            self._ids = environment.find_faces(self.offsets, self.vertices)
        return self._ids

    def of(self, environment: Environment, faces: Records) -> NDArray[np.int64]:
        """For each face the number of its surface, in the order of names; -1 for none. If several have the face: the one of fewest faces."""
        ids = self.ids(environment)
        if self._owners is None:
            owner = np.full(len(ids), -1, np.int64)
            order = sorted(range(len(self.members)), key=lambda i: -len(list(self.members.values())[i]))
            for number in order:
                owner[list(self.members.values())[number]] = number
            keys = keys_of(ids)
            there = np.flatnonzero((ids["generation"] != 0) & (owner >= 0))
            # A face that several surfaces list gets the surface of fewest faces: that is last, and a stable sort keeps it there.
            rank = np.empty(len(self.members) + 1, np.int64)
            rank[order] = np.arange(len(order))
            kept = there[np.lexsort((rank[owner[there]], keys[there]))]
            self._owners = keys[kept], ids["generation"][kept].astype(np.uint32), owner[kept]
        keys, generations, surface = self._owners
        if len(keys) == 0:
            return np.full(len(faces), -1, np.int64)
        place = np.searchsorted(keys, keys_of(faces), side="right") - 1
        found = (place >= 0) & (keys[place] == keys_of(faces)) & (generations[place] == faces["generation"])
        return np.where(found, surface[place], -1)

    def _follow(self, environment: Environment) -> None:
        """Adds the parts of faces that were cut since ids were found: faces of changed cells whose vertices all come from one face."""
        sources: dict[int, frozenset[int]] = {}
        for change in self.changes:
            for origin in change.vertices:
                ends = (int(end["index"]) for end in origin["from"])
                sources[int(origin["vertex"]["index"])] = frozenset().union(*(sources.get(end, frozenset([end])) for end in ends))
        at: dict[int, set[int]] = {}
        for face in range(len(self.offsets) - 1):
            for vertex in self.vertices[self.offsets[face] : self.offsets[face + 1]].tolist():
                at.setdefault(vertex, set()).add(face)
        parts = [(corners, whole) for corners, whole in _faces_of_changes(environment, self.changes, sources, at)]
        self.changes, self._ids, self._owners = [], None, None
        if not parts:
            return
        sizes = np.array([len(corners) for corners, _ in parts])
        groups: dict[str, NDArray[np.int64]] = {}
        for name, members in self.members.items():
            named = set(members.tolist())
            groups[name] = np.array([i for i, (_, whole) in enumerate(parts) if whole & named], np.int64)
        self.add(np.concatenate([[0], np.cumsum(sizes)]), np.concatenate([corners for corners, _ in parts]), groups, {})


def _faces_of_changes(
    environment: Environment, changes: list[Any], sources: dict[int, frozenset[int]], at: dict[int, set[int]]
) -> Iterable[tuple[NDArray[np.int64], set[int]]]:
    """Faces with new vertices of cells that have changed: their vertices, and the named faces that they are parts of."""
    least = 2 if environment.dimension == 2 else 3
    seen: set[tuple[int, ...]] = set()
    for index in sorted({int(volume["index"]) for change in changes for volume in change.volumes["after"] if volume["generation"] != 0}):
        try:
            volume = environment.volume_id(index)
        except NotFound:
            continue
        for local in range(environment.volume_counts(volume).faces):
            corners = environment.vertices(environment.face_id(volume, local))["index"].astype(np.int64)
            key = tuple(sorted(corners.tolist()))
            if key in seen or sources.keys().isdisjoint(key):
                continue
            seen.add(key)
            origin = frozenset().union(*(sources.get(vertex, frozenset([vertex])) for vertex in key))
            whole = set.intersection(*(at.get(vertex, set()) for vertex in origin))
            if len(origin) >= least and whole:
                yield corners, whole


def keys_of(faces: Records) -> NDArray[np.uint64]:
    return (faces["volume"].astype(np.uint64) << np.uint64(32)) | faces["local"].astype(np.uint64)


def changes_topology(method: Method) -> Method:
    """A method after which named faces may have other ids."""

    @functools.wraps(method)
    def wrapped(self: Any, *arguments: Any, **options: Any) -> Any:
        result = method(self, *arguments, **options)
        surfaces = self._names.surfaces
        if surfaces.members:
            surfaces.changes.append(self.change())
            if len(surfaces.changes) > MOST_CHANGES:
                surfaces.ids(self)
        return result

    return cast(Method, wrapped)


class Named:
    """The methods of an environment that take or give names."""

    __slots__ = ()
    _core: Any
    _names: Names

    # --- regions

    def mark_region(self, region: int | str, mark: int = Mark.IMPASSABLE, flags: int = 0) -> tuple[int, int]:
        """Sets the mark of all volumes of a region, by label or name; returns how many have the mark now, and how many were
        skipped. Raises ValueError where no volume has the label."""
        labels = self._labels(region)
        if len(labels) > 1 and self._core.info().scene_count != 0:  # all or none: a scene can refuse
            volumes = [volume for volume in _all_volumes(self._core) if self._core.get_region(volume) in labels]
            skipped = self._core.mark_volumes(volumes, mark, flags)
            marked = len(volumes) - skipped
        else:
            each = [self._core.mark_region(label, mark, flags) for label in labels]
            marked, skipped = sum(both.marked for both in each), sum(both.skipped for both in each)
        if marked == skipped == 0:
            raise ValueError(f"no volume has region {region!r}; {self._known_regions()}")
        return marked, skipped

    def mark_between(self, a: int | str, b: int | str, mark: int = Mark.IMPASSABLE) -> int:
        """Sets the mark of all faces between two regions, by label or name; returns their number."""
        pairs = {frozenset((i, j)) for i in self._labels(a) for j in self._labels(b)}
        return sum(self._core.mark_between(min(pair), max(pair), mark) for pair in pairs)

    def regions(self) -> list[int]:
        """The labels of all regions that have volumes."""
        return self._core.get_region_labels().tolist()  # type: ignore[no-any-return]

    @property
    def region_names(self) -> dict[str, int]:
        """The label of each name that has one label."""
        return {name: labels[0] for name, labels in self._names.regions.items() if len(labels) == 1}

    @property
    def region_groups(self) -> dict[str, tuple[int, ...]]:
        """The labels of each name. Groups of cells may overlap: a cell can be in "lumen" and in "all", which has the labels of both."""
        return dict(self._names.regions)

    def _labels(self, region: int | str) -> tuple[int, ...]:
        if not isinstance(region, str):
            return (region,)
        if region not in self._names.regions:
            raise ValueError(f"no region is called {region!r}; {self._known_regions()}")
        return self._names.regions[region]

    def _known_regions(self) -> str:
        names = {label: [name for name, labels in self._names.regions.items() if label in labels] for label in self.regions()}
        return _known("regions", names)

    # --- surfaces

    @property
    def surface_names(self) -> dict[str, int]:
        """The tag of each surface: a named set of faces, such as an inlet, a patch or a side set of a mesh."""
        return dict(self._names.surfaces.tags)

    def faces(self, surface: int | str) -> Records:
        """Ids of the faces of a surface, by its name or tag, where they are now. Parts of a face that was cut belong to its surface."""
        me = cast("Environment", self)
        surfaces = self._names.surfaces
        ids = surfaces.ids(me)
        found = ids[np.unique(np.concatenate([surfaces.members[name] for name in self._surfaces(surface)]))]
        there: Records = found[found["generation"] != 0]
        return there

    def mark_surface(self, surface: int | str, mark: int = Mark.IMPASSABLE) -> int:
        """Sets the mark of all faces of a surface, by its name or tag; returns their number."""
        faces = self.faces(surface)
        self._core.mark_faces(faces, mark)
        return len(faces)

    def mark_exit(self, surface: int | str, patch: int | None = None) -> int:
        """Makes a surface of the outer boundary an exit, by its name or tag; returns the number of faces. What leaves there is told by `patch`, by
        default the surface's tag."""
        names = self._surfaces(surface)
        number = self._names.surfaces.tags[names[0]] if patch is None else patch
        if number < 1:
            raise ValueError(f"an exit needs a number above 0, {surface!r} has the tag {number}: give a `patch`")
        faces = self.faces(surface)
        self._core.mark_exits(faces, number)
        return len(faces)

    def name_surface(self, name: str, faces: Ids, tag: int | None = None) -> None:
        """Gives a name and a tag, by default the next free one, to faces. A name that there is gets these faces as well."""
        me = cast("Environment", self)
        corners = [me.vertices(face)["index"].astype(np.int64) for face in faces]
        offsets = np.concatenate([[0], np.cumsum([len(each) for each in corners])]).astype(np.int64)
        vertices = np.concatenate([np.empty(0, np.int64), *corners])
        self._names.surfaces.ids(me)  # follows changes from before
        self._names.surfaces.add(offsets, vertices, {name: np.arange(len(corners))}, {} if tag is None else {name: tag})

    def surfaces_of(self, contacts: Any) -> Records:
        """The surface of what was met: for each a `tag` and a `name` (dtypes.surface), 0 and "" where it is no named face. If several have the
        face, the one of fewest faces. contacts: flights, sweeps, crossings, contacts, what is nearest, near rows, or ids of faces, as an array or
        a single object."""
        names = list(self._names.surfaces.members)
        made = dtypes.surface(max((len(name) for name in names), default=1))
        tags = np.array([*(self._names.surfaces.tags[name] for name in names), 0], np.int64)
        owners = self._names.surfaces.of(cast("Environment", self), np.atleast_1d(_walls(contacts)))
        told = np.empty(len(owners), made)
        told["tag"], told["name"] = tags[owners], np.array([*names, ""], made["name"])[owners]
        return told if np.ndim(contacts) == 1 else told[0]

    def _surfaces(self, surface: int | str) -> list[str]:
        tags = self._names.surfaces.tags
        found = [name for name, tag in tags.items() if (name == surface if isinstance(surface, str) else tag == surface)]
        if not found:
            known = _known("surfaces", {tag: [name for name in tags if tags[name] == tag] for tag in sorted(set(tags.values()))})
            raise ValueError(f"no surface is called {surface!r}; {known}" if isinstance(surface, str) else f"no surface has tag {surface!r}; {known}")
        return found

    # --- where it comes from

    @property
    def notes(self) -> tuple[str, ...]:
        """What was changed or left out when the environment was made of a mesh, a sentence each."""
        return self._names.notes

    @property
    def plane(self) -> PlaneFrame | None:
        """Where a mesh of the plane lay in space, if it was read from three coordinates."""
        return self._names.plane


def _known(kind: str, names: Mapping[int, Sequence[str]]) -> str:
    if not names:
        return f"there are no {kind}"
    each = [f"{number} ({', '.join(names[number])})" if names[number] else str(number) for number in list(names)[:20]]
    return f"{kind} are {', '.join(each)}{', ...' if len(names) > 20 else ''}"


def _all_volumes(core: Any) -> Iterable[Any]:
    for index in range(core.info().volume_index_count):
        try:
            yield core.get_volume_id(index)
        except NotFound:  # removed
            continue


def _walls(contacts: Any) -> Any:
    """The faces that contacts name, as an array of ids or one of them."""
    if isinstance(contacts, (np.ndarray, np.void)):
        names = contacts.dtype.names or ()
        if "contact" in names:
            return contacts["contact"]["wall"]
        if "wall" in names or "face" in names:
            return contacts["wall" if "wall" in names else "face"]
        if "nearest" in names:
            contacts = contacts["nearest"]
        if "cell" in names or "nearest" in names:
            return _faces_of_cells(contacts["cell"])
        if {"volume", "generation", "local"} <= set(names):
            return contacts
    elif isinstance(contacts, (list, tuple)):
        return np.concatenate([np.atleast_1d(_walls(each)) for each in contacts]) if contacts else np.empty(0, dtypes.FACE_ID)
    else:
        thing = getattr(contacts, "contact", getattr(contacts, "nearest", contacts))
        wall = getattr(thing, "wall", thing)
        if hasattr(wall, "cell"):
            wall = wall.cell
            return np.array((wall.index, wall.generation * (wall.kind == CellKind.FACE), wall.local), dtypes.FACE_ID)
        if hasattr(wall, "volume") and hasattr(wall, "local"):
            return np.array((wall.volume, wall.generation, wall.local), dtypes.FACE_ID)
    raise TypeError(f"flights, contacts or ids of faces are needed, not {type(contacts).__name__}")


def _faces_of_cells(cells: Any) -> Records:
    cells = np.atleast_1d(cells)
    made = np.zeros(len(cells), dtypes.FACE_ID)
    made["volume"], made["local"] = cells["index"], cells["local"]
    made["generation"] = np.where(cells["kind"] == CellKind.FACE, cells["generation"], 0)
    return made
