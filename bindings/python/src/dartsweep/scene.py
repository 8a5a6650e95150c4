"""Scenes: particles and bodies in one environment."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, dtypes
from ._core import (
    CastOptions,
    Cell,
    DeformReport,
    Flight,
    MoveOptions,
    ParticleId,
    SceneDeformOptions,
    Statistics,
    TogetherOptions,
    Validation,
    VolumeId,
)
from .body import Body
from .enums import Level, RecordingFlag
from ._shapes import Ids, Records, contiguous, rows_of
from .environment import Environment
from .options import options as described


class StepFraction(NamedTuple):
    """How much of steps is free, and where they lead then."""

    fraction: float  # common to all bodies
    fractions: NDArray[np.float64]  # of each body's island
    places: NDArray[np.float64]
    environment_places: NDArray[np.float64] | None


class Scene:
    """Particles and bodies of one environment, which it keeps alive. Close it, or use it in a `with` statement.

    features: Feature, what the scene can do beyond particles and bodies.
    """

    __slots__ = ("_core", "_environment", "__weakref__")

    def __init__(self, environment: Environment, features: int = 0) -> None:
        self._environment = environment
        self._core: Any = _core.Scene(environment._core, described(_core.SceneDesc, features=int(features)))

    @classmethod
    def load(cls, environment: Environment, block: bytes) -> Scene:
        """Loads a snapshot that `save` made, into the same environment or one loaded from its snapshot."""
        made = cls.__new__(cls)
        made._environment, made._core = environment, _core.Scene.load(environment._core, block)
        return made

    def save(self) -> bytes:
        """A snapshot without the environment. Pickling takes both."""
        return self._core.save()  # type: ignore[no-any-return]

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene.load, (self._environment, self.save())

    @property
    def environment(self) -> Environment:
        """The environment of the scene."""
        return self._environment

    def close(self) -> None:
        """Closes the scene and its bodies. A second close is allowed; any other call then raises Closed."""
        self._core.close()

    @property
    def closed(self) -> bool:
        """Whether close() has been called."""
        return self._core.is_closed()  # type: ignore[no-any-return]

    def __enter__(self) -> Scene:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        if self.closed:
            return "<dartsweep.Scene, closed>"
        return f"<dartsweep.Scene: {self.particle_count} particles, {self.body_count} bodies>"

    @property
    def particle_count(self) -> int:
        """The number of particles."""
        return self._core.get_particle_count()  # type: ignore[no-any-return]

    @property
    def body_count(self) -> int:
        """The number of bodies."""
        return self._core.get_body_count()  # type: ignore[no-any-return]

    def particle_ids(self) -> Records:
        """Ids of all particles, by index."""
        return self._core.get_particle_ids()  # type: ignore[no-any-return]

    def body_ids(self) -> Records:
        """Ids of all bodies, by index."""
        return self._core.get_body_ids()  # type: ignore[no-any-return]

    def start_recording(self, path: str | None = None, flags: int = 0) -> None:
        """Writes every call that changes the scene into a file before the call is made: see record.h of the C interface. Without a path the latest
        calls are kept in memory, for write_bug_report. flags: RecordingFlag."""
        self._core.start_recording(path, int(flags) | (RecordingFlag.LATEST if path is None else 0))

    def stop_recording(self) -> None:
        """Ends the recording, if any."""
        self._core.stop_recording()

    @contextmanager
    def recording(self, path: str | None = None, flags: int = 0) -> Iterator[None]:
        """Records the calls in a `with` statement. Raises WriteFailed at its end if the recording is incomplete."""
        self.start_recording(path, flags)
        try:
            yield
        finally:
            self.stop_recording()

    def write_bug_report(self, path: str, note: str = "") -> Validation:
        """A bug report in one call: the scene before its last recorded call, that call, and the exact validation of its answer.
        examples/replay of the C library prints and draws the report."""
        return self._core.write_bug_report(path, note)  # type: ignore[no-any-return]

    @property
    def memory_bytes(self) -> int:
        """Memory that the scene holds, without the environment."""
        return self._core.get_memory_bytes()  # type: ignore[no-any-return]

    @property
    def statistics(self) -> Statistics:
        """Counters, with Feature.STATISTICS."""
        return self._core.get_statistics()  # type: ignore[no-any-return]

    def reset_statistics(self) -> None:
        """Sets the counters to zero."""
        self._core.reset_statistics()

    # --- particles

    def create_particle(self, position: ArrayLike, hint: Any = None) -> ParticleId:
        """A particle at a position; `hint` is a volume near the position."""
        return self._core.create_particle(position, hint)  # type: ignore[no-any-return]

    def create_particles(self, positions: ArrayLike, hints: Ids | None = None) -> Records:
        """Ids (dtypes.PARTICLE_ID) of new particles, all or none."""
        positions = np.asarray(positions, np.float64)
        particles = np.empty(len(positions), dtypes.PARTICLE_ID)
        self._core.create_particles(positions, hints, particles)
        return particles

    def destroy_particle(self, particle: Any) -> None:
        """Removes a particle; its id becomes stale."""
        self._core.destroy_particle(particle)

    def particle_position(self, particle: Any) -> tuple[NDArray[np.float64], VolumeId]:
        """Position and volume of a particle."""
        both = self._core.get_particle_position(particle)
        return both.position[: self._core.dimension()], both.volume

    def particle_state(self, particle: Any) -> tuple[Cell, Cell]:
        """The cell in which a particle lies, a volume, and the cell at which it aims: the face of the volume that stopped it last, or the
        null cell."""
        return self._core.get_particle_cell(particle), self._core.get_particle_aim(particle)

    def particle_positions(self, particles: Ids, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Positions of particles."""
        positions = np.empty((len(particles), self._core.dimension())) if out is None else out
        self._core.get_particle_positions(particles, positions, None)
        return positions

    def particle_volumes(self, particles: Ids) -> Records:
        """Volumes of particles."""
        volumes = np.empty(len(particles), dtypes.VOLUME_ID)
        self._core.get_particle_positions(particles, None, volumes)
        return volumes

    def move_particle(self, particle: Any, target: ArrayLike, options: CastOptions | None = None) -> Flight:
        """Moves a particle to its target or to the first wall."""
        return self._core.move_particle(particle, target, options)  # type: ignore[no-any-return]

    def move_particles(
        self, particles: Ids, targets: ArrayLike, options: CastOptions | None = None, out: Records | None = None
    ) -> Records:
        """Moves many particles; returns their flights (dtypes.FLIGHT), in `out` if given."""
        flights = np.empty(len(particles), dtypes.FLIGHT) if out is None else out
        self._core.move_particles(particles, targets, options, flights)
        return flights

    def exits(self) -> Records:
        """What came to an exit in the last move of particles (dtypes.EXIT): where, when, and which particle. With CastFlag.LEAVE it is removed, else
        it waits there."""
        return self._core.get_exits()  # type: ignore[no-any-return]

    def cast_from_particles(
        self, particles: Ids, targets: ArrayLike, options: CastOptions | None = None, out: Records | None = None
    ) -> Records:
        """Flights as move_particles would make them; nothing moves."""
        flights = np.empty(len(particles), dtypes.FLIGHT) if out is None else out
        self._core.cast_from_particles(particles, targets, options, flights)
        return flights

    def cut_bodies(self, blade: ArrayLike, bodies: Iterable[Body] | None = None) -> Records:
        """Cuts edges of bodies along the surface that a blade sweeps (dtypes.BODY_CUT), of all bodies unless some are given.

        blade: points of shape (rows, columns, 3), in the plane of shape (n, 2). Both sides of each cut get an end of their own."""
        points = np.ascontiguousarray(blade, np.float64)
        if self._core.dimension() == 2 and points.ndim == 2:
            points = points[:, np.newaxis]
        if points.ndim != 3:
            raise ValueError("a blade has shape (rows, columns, 3), or (n, 2) in the plane")
        some = None if bodies is None else [body.id for body in bodies]
        if some is not None and not some:
            return np.empty(0, dtypes.BODY_CUT)
        self._core.cut_bodies(points.reshape(-1, points.shape[2]), points.shape[0], points.shape[1], some)
        return self._core.get_body_cuts()  # type: ignore[no-any-return]

    def cast(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        volumes: Ids | None = None,
        options: CastOptions | None = None,
    ) -> tuple[Records, Records]:
        """What many segments meet first, of walls and bodies: flights (dtypes.FLIGHT), and the body and part that each met
        (dtypes.CONTACT_PARTNER), null at walls. CastFlag.OPEN_ENDS does not count what touches an end alone."""
        starts, ends = contiguous(starts), contiguous(ends)
        flights, partners = np.empty(len(starts), dtypes.FLIGHT), np.empty(len(starts), dtypes.CONTACT_PARTNER)
        self._core.cast(starts, ends, volumes, options, flights, partners)
        return flights, partners

    def find_nearest(self, points: ArrayLike, radius: float = float("inf"), hints: Ids | None = None) -> tuple[Records, Records]:
        """What is nearest to each point (dtypes.NEAREST), of walls and bodies, and which body and part that is (dtypes.CONTACT_PARTNER)."""
        points = np.asarray(points, np.float64)
        nearest, partners = np.empty(len(points), dtypes.NEAREST), np.empty(len(points), dtypes.CONTACT_PARTNER)
        self._core.find_nearest(points, radius, hints, nearest, partners)
        return nearest, partners

    def crossings(self) -> tuple[Records, NDArray[np.uintp]]:
        """Volumes that the last move entered (dtypes.CROSSING), and the index where those of each flight begin; with Feature.CROSSINGS."""
        return self._core.get_crossings(), self._core.get_crossing_offsets()

    def occupants(self) -> Records:
        """Particles that were in the way of the last mark or change of the topology."""
        return self._core.get_occupants()  # type: ignore[no-any-return]

    def occupant_bodies(self) -> Records:
        """Bodies that were in the way of the last mark or change of the topology."""
        return self._core.get_occupant_bodies()  # type: ignore[no-any-return]

    # --- bodies

    def create_body(
        self,
        positions: ArrayLike,
        edges: ArrayLike | None = None,
        triangles: ArrayLike | None = None,
        *,
        level: int = Level.EDGES_SWEPT,
        flags: int = 0,
        hints: Ids | None = None,
        motion_share: float = 0.0,
        category: int = 0,
        mask: int = 0,
        radius: float = 0.0,
    ) -> Body:
        """A body: edges of shape (n, 2), triangles of shape (n, 3), indices of positions. flags: BodyFlag. With a radius it keeps
        this distance from everything."""
        desc = described(
            _core.BodyDesc,
            level=int(level),
            flags=int(flags),
            motion_share=motion_share,
            category=category,
            mask=mask,
            radius=radius,
        )
        offsets = None
        if edges is not None:
            edges = rows_of(edges, 2, "edges")
        if triangles is not None:
            triangles = rows_of(triangles, 3, "triangles")
            offsets = np.arange(0, triangles.size + 1, 3)
        return Body(self._core, self._core.create_body(positions, edges, offsets, triangles, hints, desc))

    def body(self, body: Any) -> Body:
        """The body with an id."""
        return Body(self._core, body)

    def move_bodies(self, bodies: Ids, targets: ArrayLike, options: MoveOptions | None = None) -> Records:
        """Moves many bodies (ids, dtypes.BODY_ID): with targets body after body; returns a report for each body."""
        reports = np.empty(len(bodies), dtypes.MOVE_REPORT)
        self._core.move_bodies(bodies, targets, options, reports)
        return reports

    def move_together(self, bodies: Ids, targets: ArrayLike, options: TogetherOptions | None = None) -> Records:
        """Moves all vertices of many bodies at once (ids, dtypes.BODY_ID), with targets body after body; returns a report for each body."""
        reports = np.empty(len(bodies), dtypes.MOVE_REPORT)
        self._core.move_together(bodies, targets, options, reports)
        return reports

    def step_fraction(
        self, bodies: Ids, steps: ArrayLike, environment_steps: ArrayLike | None = None, options: TogetherOptions | None = None
    ) -> StepFraction:
        """The largest part of steps that is free when all vertices go at once, for a solver's line search. Nothing moves.

        steps: of all vertices of the bodies (ids, dtypes.BODY_ID), body after body, of shape (n, 3), in the plane (n, 2). environment_steps: those of
        the environment's vertices; without them it stands still. options: `stop` is ALL or ISLAND, whether `places` are those of `fraction` or
        of `fractions`. The places are x + fraction * step, as numpy rounds them, and the ways there are verified.
        """
        rows = np.ascontiguousarray(steps, np.float64)
        places, fractions = np.empty(rows.shape), np.empty(len(bodies))
        if environment_steps is None:
            return StepFraction(self._core.step_fraction(bodies, rows, options, places, fractions), fractions, places, None)
        walls = np.ascontiguousarray(environment_steps, np.float64)
        moved = np.empty(walls.shape)
        fraction = self._core.step_fraction(bodies, rows, options, places, fractions, walls.reshape(-1), moved.reshape(-1))
        return StepFraction(fraction, fractions, places, moved)

    def move_rigid(self, bodies: Ids, motions: ArrayLike, options: TogetherOptions | None = None) -> Records:
        """Moves bodies (ids, dtypes.BODY_ID) at once, each on a rigid motion of its own, up to the first touch; returns a report for each body.

        motions: of shape (n, 10): a quaternion x, y, z, w, a centre and a translation, both with three coordinates (0 in the plane).
        """
        given = self._motions(motions)
        reports = np.empty(len(bodies), dtypes.MOVE_REPORT)
        self._core.move_rigid(bodies, given, options, reports)
        return reports

    def deform(
        self,
        positions: NDArray[np.float64],
        bodies: Ids | None = None,
        targets: ArrayLike | None = None,
        options: SceneDeformOptions | None = None,
    ) -> tuple[DeformReport, Records]:
        """Takes bodies to their targets while the environment goes to new positions of its vertices, all at once; with
        Feature.DEFORMING. Everything stops at the first contact, or with
        options(SceneDeformOptions, stop=TogetherStop.FEATURE) the parts that touch; `response` lets
        these slide, or go with walls. Returns the report of the environment and one for each body.

        positions: an array that is lent, as Environment.deform describes.
        """
        reports = np.empty(0 if bodies is None else len(bodies), dtypes.MOVE_REPORT)
        return self._core.deform(positions, bodies, targets, options, reports), reports

    def deform_rigid(
        self,
        positions: NDArray[np.float64],
        bodies: Ids,
        motions: ArrayLike,
        options: SceneDeformOptions | None = None,
    ) -> tuple[DeformReport, Records]:
        """Moves bodies as move_rigid while the environment goes to new positions of its vertices as in deform, all at once, up to the
        first touch of anything; with Feature.DEFORMING. With options(SceneDeformOptions, stop=TogetherStop.FEATURE,
        response=TogetherResponse.SLIDE) walls push the bodies as a whole. Returns the report of the environment and one for each body.

        positions: an array that is lent, as Environment.deform describes.
        """
        given = self._motions(motions)
        reports = np.empty(len(bodies), dtypes.MOVE_REPORT)
        return self._core.deform_rigid(positions, bodies, given, options, reports), reports

    @staticmethod
    def _motions(motions: ArrayLike) -> NDArray[np.float64]:
        given = np.ascontiguousarray(motions, np.float64)
        if given.size and (given.ndim != 2 or given.shape[1] != 10):
            raise ValueError("motions are an array of shape (n, 10)")
        return given.reshape(-1)

    def offending_edges(self) -> NDArray[np.uint32]:
        """Pairs of vertices of the edges that were not free when a body was created, or changed its level, filter or radius."""
        return self._core.get_offending_edges().reshape(-1, 2)  # type: ignore[no-any-return]
