"""Thin elastic rods that are pushed through a vessel, tied and twisted: guide wires, catheters and threads.

A rod is a chain of vertices. Vertex 0 is the tip. Edges resist stretching, and vertices between two edges resist bending and, if they are told
to, twisting: the discrete elastic rod of Bergou et al. 2008 and 2010. Without `twisting` the rod does not twist: its tip is free, so a turn of
the hand reaches the tip at once. A step is one step of implicit Euler, linearised once. Units have to fit each other, such as mm, s, mg and uN,
which the defaults have.

A rod has a radius. The library keeps the middle line free of everything, exactly. The thickness is a matter of the solver here: near rows
say where the rod is close to a wall, to another rod or to itself, and the solver wants that no gap (distance less radii) becomes negative.
These constraints, with Coulomb's friction, are solved on the compliance of the rod, J A^-1 J^T (Lenoir, Cotin, Duriez and Neumann 2006), by
projected Gauss-Seidel. So gaps hold as well as a solver holds them, and the middle line always.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, errors
from ._centreline import centreline, length_of, nearest_on, place_on
from ._core import MoveOptions
from .body import Body
from .enums import BodyFlag, MoveFlag, Outcome, Response
from ._shapes import Records
from .options import options
from .scene import Scene

__all__ = ["Rod", "StepReport", "centreline", "length_of", "place_on", "step"]

Array = NDArray[np.float64]

_REACTION = 0.02  # s, in which the hand changes its speed
_MOST_TURN = 0.1  # of an edge in a step, rad: a turn by an angle a makes the edge longer by a^2 / 2. What turns faster gets more drag
_ATTEMPTS = 4  # with more and more drag
_NEIGHBOURS = 4  # radii along the rod: parts that are closer do not meet
_WALL, _IGNORED = 0xFFFFFFFF, 0xFFFFFFFE  # in place of the number of a rod

_known: WeakValueDictionary[tuple[int, int, int], Rod] = WeakValueDictionary()  # by scene and body


class StepReport(NamedTuple):
    """What a step did."""

    rows: int
    """Places where the rod was near something."""
    pressing: int
    """Rows with an impulse."""
    sweeps: int
    """Sweeps of Gauss-Seidel."""
    off: float
    """By how much a row has moved in the last sweep, at most: a length."""
    contacts: int
    """Contacts of the middle line, which the library met. Without them the rows alone have kept the rod free."""


class Rod:
    """A rod of a scene, and its introducer.

    The introducer is a straight tube that ends at `at`, within the vessel, and points into `direction`. What has not entered yet waits in it.
    At first two vertices are in the vessel; `push` feeds the others. The hand keeps the last edge. introducer=False: the whole rod
    begins in the vessel, as a straight line from `at`, and nothing holds it.

    points: in place of `at`, `direction`, `length` and `segment`: the rod begins in the vessel, on this line of shape (n, 3), without an
    introducer. Its edges have their lengths at rest. It is straight at rest, so it springs open; `keep_shape` makes the line its shape at rest.
    length, segment: of the rod and of its edges. radius: of the rod.
    bending: force times area, E I; a number or one for each edge, the tip first. stretching: force, E A; a number or one for each edge.
    twisting: force times area, G J; a number or one for each edge. None: the rod does not twist.
    density: mass of a length.
    tip_curvature, tip_length: how much the tip is bent at rest, 1 / radius of the bend, and how much of it.
    friction: Coulomb's coefficient. drag: of the velocity, 1/s.
    most_force: the hand goes slower from half of this force on, and stops at it. It gives way, but by less than a segment.
    meets_itself: the rod is an obstacle for itself; the scene needs Feature.BODY_CONTACTS. Then rods of the scene meet each other, too: those
    of one call of `step` push each other, any other rod stands still.
    Raises an Error if the line is not free, as Scene.create_body.
    """

    def __init__(
        self,
        scene: Scene,
        at: ArrayLike | None = None,
        direction: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
        length: float | None = None,
        segment: float | None = None,
        radius: float,
        bending: ArrayLike = 1e7,
        stretching: ArrayLike = 2e9,
        twisting: ArrayLike | None = None,
        density: float = 1.6,
        tip_curvature: float = 0.0,
        tip_length: float = 0.0,
        friction: float = 0.04,
        drag: float = 20.0,
        most_force: float = 1e6,
        introducer: bool = True,
        meets_itself: bool = False,
    ) -> None:
        if points is None:
            if at is None or direction is None or length is None or segment is None:
                raise ValueError("a rod begins on `points`, or has `at`, `direction`, `length` and `segment`")
            rest = np.full(round(length / segment), float(segment))
            self._at = np.asarray(at, np.float64)
            self._axis = np.asarray(direction, np.float64) / np.linalg.norm(direction)
        else:
            if not (at is None and direction is None and length is None and segment is None):
                raise ValueError("`points` are in place of `at`, `direction`, `length` and `segment`")
            line = np.array(points, np.float64)
            if line.ndim != 2 or line.shape[1] != 3 or len(line) < 2 or not np.isfinite(line).all():
                raise ValueError(f"`points` are finite and have the shape (n, 3), not {line.shape}")
            rest = np.linalg.norm(np.diff(line, axis=0), axis=1)
            if not rest.all():
                raise ValueError(f"`points` {int(rest.argmin())} and the next one are in one place")
            self._at, self._axis, introducer = line[0], (line[-2] - line[-1]) / rest[-1], False
        count = len(rest) + 1
        if not (count >= 4 and radius > 0 and density > 0):
            raise ValueError(f"a rod has 3 segments at least, a radius and a density: {count - 1}, {radius}, {density}")
        if self._at.shape != (3,) or self._axis.shape != (3,):
            raise ValueError("a rod is in space: `at` and `direction` have 3 coordinates")
        self.segment, self.radius, self.friction, self.drag, self.most_force = float(rest.mean()), radius, friction, drag, most_force
        self.rest_length: Array = rest
        """By edge, the tip first: its length without tension."""
        self.bending: Array = np.broadcast_to(np.asarray(bending, np.float64), count - 1).copy()
        """By edge."""
        self.stretching: Array = np.broadcast_to(np.asarray(stretching, np.float64), count - 1).copy()
        """By edge."""
        self.twists = twisting is not None
        """Whether the rod can twist."""
        self.twisting: Array = np.broadcast_to(np.asarray(0.0 if twisting is None else twisting, np.float64), count - 1).copy()
        """By edge."""
        self.mass: Array = np.zeros(count)
        """By vertex."""
        self.mass[:-1] = self.mass[1:] = density * rest / 2
        self.mass[1:-1] = density * (rest[:-1] + rest[1:]) / 2
        self.rest_curvature: Array = np.zeros((count, 2))
        """By vertex: bending at rest about two axes across the rod, 2 tan(angle / 2). The ends have 0."""
        bent = slice(1, 1 + min(math.ceil(tip_length / self.segment), count - 2))
        self.rest_curvature[bent, 0] = 2 * math.tan(tip_curvature * self.segment / 2)
        self.load: Array = np.zeros((count, 3))
        """By vertex: forces from outside, such as weight."""
        self.held: NDArray[np.bool_] = np.zeros(count, np.bool_)
        """By vertex: it moves as `velocity` says, whatever the forces are."""
        self.velocity: Array = np.zeros((count, 3))
        """By vertex."""
        self.held_turn: NDArray[np.bool_] = np.zeros(count - 1, np.bool_)
        """By edge: it turns about itself as `spin` says, the last one as `turned` says. The introducer holds the last one. Only for a rod that
        twists."""
        self.spin: Array = np.zeros(count - 1)
        """By edge: how fast it turns about itself, rad/s."""
        self.turned = 0.0
        """By how much the hand has turned the rod about its axis, rad. A rod that twists is turned at its last edge, where `held_turn` says so."""
        self.recovery = 0.2
        """Share of a negative gap that a step takes back."""
        self.most_sweeps = 60
        """Most sweeps of Gauss-Seidel in a step."""
        self.tolerance = 1e-7 * radius
        """Sweeps end when no row moves in a sweep by more."""
        self.report = StepReport(0, 0, 0, 0.0, 0)
        """What the last step did."""
        self.way: Array | None = None
        """A line, such as a centreline: the tip is pulled towards its point that is `look_ahead` ahead, with the force `steering`."""
        self.steering, self.look_ahead = 1e5, 4.0
        self.pushed = self.segment if introducer else float(rest.sum())
        """How much of the rod the hand has pushed in."""
        self._speed = 0.0
        self._across: Array = np.cross(self._axis, np.eye(3)[np.abs(self._axis).argmin()])  # it, at the last edge
        self._turned = 0.0  # of the twisting rod: what the last edge has been turned by
        self._environment = scene.environment
        self._has_introducer = introducer
        self._entered = self._used = 2 if introducer else count
        self.positions: Array = self._on_axis(np.arange(count)) if points is None else line
        """By vertex, also of those in the introducer. To begin elsewhere, make a rod on other `points`."""
        edges = [(i, i + 1) for i in range(self._entered - 1)]
        flags = int(BodyFlag.SELF_CONTACTS) if meets_itself else 0
        self.body: Body = scene.create_body(self.positions[: self._entered], edges, flags=flags)
        """What is in the vessel: vertices 0 to entered - 1."""
        self._scene = id(scene._core)
        _known[self._key] = self
        self._impulses: Array = np.zeros((0, 3))
        self._solver: Any = _core.RodSolver(1)
        self._twist: Array = np.zeros(count)
        self.directors: Array = np.zeros((count - 1, 3))
        """By edge: a unit vector across it, which turns with the rod."""
        self._load_solver(self._solver, 0)
        self._carry(self._solver, 0)
        self._slide = options(
            MoveOptions, vertex_response=Response.SLIDE, edge_response=Response.SLIDE, flags=int(MoveFlag.KEEP_WALLS)
        )

    @property
    def entered(self) -> int:
        """How many vertices are in the vessel."""
        return self._entered

    @property
    def tip(self) -> Array:
        """Where the tip is."""
        return np.array(self.positions[0])

    @property
    def twist(self) -> Array:
        """By vertex: by what angle the rod is twisted there, rad, all turns counted. The ends have 0."""
        return self._twist.copy()

    def keep_shape(self) -> None:
        """Makes the shape of now that at rest: lengths of edges, and bends. A twist stays a twist."""
        self._load_solver(self._solver, 0)
        if not self.twists:
            self._carry(self._solver, 0)
        used = self._used
        self.rest_length[: used - 1] = np.linalg.norm(np.diff(self.positions[:used], axis=0), axis=1)
        self.rest_curvature[:used] = self._solver.curvatures(0).reshape(-1, 2)

    def largest_stretch(self) -> float:
        """The largest | length / rest - 1 | of an edge in the vessel."""
        edges = np.diff(self.positions[: self._entered], axis=0)
        return float(np.abs(np.linalg.norm(edges, axis=1) / self.rest_length[: self._entered - 1] - 1).max())

    def smallest_gap(self, margin: float | None = None) -> float:
        """The smallest gap of the rod that is not larger than `margin`, by default its radius; the margin where there is none. The vertex
        that the introducer holds does not count."""
        margin = self.radius if margin is None else margin
        rows = self._rows(margin)
        held = np.append(self.held, True)[np.minimum(rows["vertices"], len(self.held))].all(axis=1)
        return float(rows["gap"][~held].min(initial=margin))

    def is_free(self) -> bool:
        """Whether the middle line in the vessel meets nothing: the library casts every edge, exactly."""
        line = self.positions[: self._entered]
        flights = self._environment.cast_segments(line[:-1], line[1:])
        return bool((flights["outcome"] == Outcome.REACHED).all())

    def reached(self, way: ArrayLike) -> float:
        """How far along a way the tip is: the length of the way up to the place that is nearest to the tip."""
        return nearest_on(np.asarray(way, np.float64), self.positions[0])

    def push(self, distance: float, speed: float = 30.0, dt: float = 0.01, most_steps: int | None = None) -> float:
        """Steps until the hand has pushed so far, the rod is in but for its last edge, or there were most_steps: by default four times as
        many as without resistance. Returns how far the hand has pushed."""
        start, end = self.pushed, min(self.pushed + distance, self._most_pushed())
        steps = math.ceil(4 * distance / (speed * dt)) if most_steps is None else most_steps
        for _ in range(steps):
            if self.pushed >= end - 1e-9 * self.segment:
                break
            self.step(dt, min(speed, (end - self.pushed) / dt))
        return self.pushed - start

    def step(self, dt: float, speed: float = 0.0) -> StepReport:
        """One time step, in which the hand pushes with a speed."""
        return step([self], dt, speed)[0]

    # --- the introducer

    def _on_axis(self, vertices: NDArray[Any]) -> Array:
        depth: Array = self.pushed - self.segment * vertices  # an introducer has a rod of equal segments
        return self._at + depth[:, None] * self._axis

    def _most_pushed(self) -> float:
        return (len(self.positions) - 1.5) * self.segment

    def _feed(self, dt: float, speed: float) -> None:
        """The hand feels how hard it pushes and goes on. What is in the introducer, and the first vertex that has left it, is held."""
        last = self._entered - 1
        edge = float(np.linalg.norm(self.positions[last] - self.positions[last - 1]))
        push = self.stretching[last - 1] * (1 - edge / self.segment)
        wanted = speed * min(max(2 - 2 * push / self.most_force, 0), 1)
        self._speed = min(self._speed + min(1, dt / _REACTION) * (wanted - self._speed), speed)
        if push > self.most_force:  # the hand gives way: so far a straight rod would relax
            self._speed = 0.0
            relaxed = self.pushed * (1 - (push - self.most_force) / self.stretching[last - 1])
            self.pushed = max(float(relaxed), self.segment * last)
        self.pushed = min(self.pushed + dt * self._speed, self._most_pushed())
        self._used = self._entered + 1
        self.held[:] = np.arange(len(self.held)) >= self._entered - 1
        self.held_turn[:] = np.arange(len(self.held_turn)) >= self._used - 2
        hand = np.arange(self._entered - 1, self._used)
        self.velocity[hand] = (self._on_axis(hand) - self.positions[hand]) / dt

    def _enter(self) -> None:
        """The edge to the next vertex lies within the introducer's line. Where it is not free, the hand waits."""
        added = None
        try:
            added = self.body.add_vertex(self.positions[self._entered])
            self.body.add_edge(added, self.body.vertex_id(self._entered - 1))
        except errors.Occupied:
            if added is not None:
                self.body.remove_vertex(added)
            self.pushed, self._speed = self.segment * self._entered, 0.0
            self.positions[self._entered :] = self._on_axis(np.arange(self._entered, len(self.positions)))
            return
        self.directors[self._entered] = self.directors[self._entered - 1]  # the introducer is straight
        self.spin[self._entered] = self.spin[self._entered - 1]
        self._entered += 1

    def _steer(self, way: Array) -> None:
        to = place_on(way, self.reached(way) + self.look_ahead) - self.positions[0]
        self.load[0] = self.steering * to / max(float(np.linalg.norm(to)), self.look_ahead)

    # --- a step, in parts

    @property
    def _key(self) -> tuple[int, int, int]:
        return self._scene, self.body.id.index, self.body.id.generation

    def _begin(self, dt: float, speed: float) -> None:
        if self._has_introducer:
            self._feed(dt, speed)
        else:
            self._used = len(self.positions)
        if self.way is not None:
            self._steer(self.way)
        last = self._used - 2
        if self.twists and self.held_turn[last]:
            self.spin[last] = (self.turned - self._turned) / dt
        self._turned = self.turned

    def _load_solver(self, solver: Any, number: int) -> None:
        used = self._used
        vertices, edges = np.empty((used, 13)), np.empty((used - 1, 11))
        vertices[:, 0:3], vertices[:, 3:6], vertices[:, 6:9] = self.positions[:used], self.velocity[:used], self.load[:used]
        vertices[:, 9], vertices[:, 10:12], vertices[:, 12] = self.mass[:used], self.rest_curvature[:used], self.held[:used]
        used -= 1
        edges[:, 0:3], edges[:, 3], edges[:, 4] = self.directors[:used], self.spin[:used], self._twist[1 : used + 1]
        edges[:, 5], edges[:, 6], edges[:, 7] = self.rest_length[:used], self.stretching[:used], self.bending[:used]
        edges[:, 8], edges[:, 9], edges[:, 10] = self.twisting[:used], self.held_turn[:used], self.radius
        if not self.twists:
            edges[:, 3], edges[:, 4], edges[:, 9] = 0, 0, 1
        solver.set_rod(number, vertices.ravel(), edges.ravel())

    def _carry(self, solver: Any, number: int) -> None:
        """Directors without twist, from the last edge on."""
        carried = solver.carry_director(number, self._across, self.turned)
        self._across, self.directors[: self._used - 1] = carried[:3].copy(), carried[3:].reshape(-1, 3)

    def _predict(self, solver: Any, number: int, dt: float, drag: float) -> float:
        """Velocities without contacts: the largest one."""
        self._load_solver(solver, number)
        if not self.twists:
            self._carry(solver, number)
        return float(solver.predict(number, dt, drag, self._entered))

    def _finish(self, solver: Any, number: int, most: float, dt: float) -> int:
        """Moves the body. No row has told what is farther away than `most`. Returns how many contacts the library met."""
        used, entered = self._used, self._entered
        targets = solver.targets(number, dt, entered, most).reshape(-1, 3)
        before = self.positions[:used].copy()
        contacts = int(self.body.move(targets, self._slide).contact_count)
        self.positions[:entered] = self.body.positions(targets)
        self.positions[entered:] = self._on_axis(np.arange(entered, len(self.positions)))
        np.divide(self.positions[:used] - before, dt, out=self.velocity[:used], where=~self.held[:used, None])
        if self.twists:
            self.spin[: used - 1] = solver.spins(number)
            turned = solver.advance(number, dt, self.positions[:used].ravel())
            self.directors[: used - 1] = turned[: 3 * (used - 1)].reshape(-1, 3)
            self._twist[:used] = turned[3 * (used - 1) :]
        if self._has_introducer and self.pushed >= self.segment * self._entered:  # the next vertex has left the introducer
            self._enter()
        return contacts

    # --- contacts

    def _rows(self, margin: float) -> Records:
        """The near rows. Impulses are carried over from the rows of before; each is an impulse in space."""
        if len(_known) > 1:
            margin += max((rod.radius for key, rod in _known.items() if key[0] == self._scene and rod is not self), default=0.0)
        rows = self.body.near_rows(margin, radius=self.radius)
        before, self._impulses = self._impulses, np.zeros((len(rows), 3))
        known = rows["previous"] < len(before)
        self._impulses[known] = before[rows["previous"][known]]
        return rows

    def _others(self, rows: Records, numbers: dict[tuple[int, int, int], int]) -> NDArray[np.uint32]:
        """By row: the number of the rod that it is at. Gaps of rows at rods become what they are with both radii."""
        others = np.full(len(rows), _WALL, np.uint32)
        for i in rows["body"]["generation"].nonzero()[0].tolist():
            key = (self._scene, int(rows["body"]["index"][i]), int(rows["body"]["generation"][i]))
            other = _known.get(key)
            if other is None:
                continue  # a body that stands still
            rows["gap"][i] = rows["distance"][i] - self.radius - other.radius
            if key not in numbers:
                continue
            others[i] = numbers[key]
            if other is self:
                own, met = (self._along(rows[name][i], rows[f"{weights}weights"][i]) for name, weights in _ENDS)
                if abs(own - met) <= _NEIGHBOURS * self.radius:
                    others[i] = _IGNORED
            elif numbers[key] < numbers[self._key]:
                others[i] = _IGNORED  # the other rod has this row
        return others

    def _along(self, vertices: NDArray[np.uint32], weights: Array) -> float:
        """How far along the rod a place is."""
        lengths = np.concatenate([[0.0], np.cumsum(self.rest_length)])
        return float(sum(weight * lengths[vertex] for vertex, weight in zip(vertices, weights) if vertex < len(lengths)))


_ENDS = (("vertices", ""), ("obstacle_vertices", "obstacle_"))


def step(rods: Sequence[Rod], dt: float, speeds: ArrayLike = 0.0) -> list[StepReport]:
    """One time step of rods of one scene, which push each other where the scene has Feature.BODY_CONTACTS.

    speeds: with which the hands push; a number or one for each rod. Raises an Error if a rod is no finite numbers.
    """
    rods = list(rods)
    if not rods:
        return []
    pushing = np.broadcast_to(np.asarray(speeds, np.float64), len(rods))
    solver: Any = rods[0]._solver if len(rods) == 1 else _core.RodSolver(len(rods))
    numbers = {rod._key: number for number, rod in enumerate(rods)}
    drags, most, row_counts = [rod.drag for rod in rods], [0.0] * len(rods), [0] * len(rods)
    for number, rod in enumerate(rods):
        rod._begin(dt, float(pushing[number]))
        most[number] = 2 * dt * rod._predict(solver, number, dt, drags[number]) + 0.5 * rod.radius
    for number, rod in enumerate(rods):
        rows = rod._rows(most[number])
        row_counts[number] = len(rows)
        solver.set_options(number, rod.friction, rod.recovery, rod.tolerance, rod.most_sweeps)
        solver.set_rows(number, rows, rod._others(rows, numbers), rod._impulses.ravel())
    sweeps, off = 0.0, 0.0
    for attempt in range(_ATTEMPTS):
        sweeps, off = solver.finish(dt).tolist()
        turns = [solver.largest_turn(number, dt) for number in range(len(rods))]
        if max(turns) <= _MOST_TURN or attempt == _ATTEMPTS - 1:
            break
        for number, rod in enumerate(rods):
            if turns[number] > _MOST_TURN:
                drags[number] = 2 * (drags[number] + 1 / dt) * turns[number] / _MOST_TURN
            rod._predict(solver, number, dt, drags[number])
    for number, rod in enumerate(rods):
        rod._impulses = solver.impulses(number).reshape(-1, 3)
        contacts = rod._finish(solver, number, most[number], dt)
        pressing = int(np.count_nonzero(rod._impulses.any(axis=1)))
        rod.report = StepReport(row_counts[number], pressing, int(sweeps), off, contacts)
    return [rod.report for rod in rods]
