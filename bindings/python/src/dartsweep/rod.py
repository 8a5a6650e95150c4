"""A thin elastic rod that is pushed through a vessel: guide wires and catheters (the extra `rod`: SciPy).

A rod is a chain of vertices. Vertex 0 is the tip. Edges resist stretching, and vertices between two edges resist bending: the discrete
elastic rod of Bergou et al. 2008. The rod does not twist: its tip is free, so a turn of the hand reaches the tip at once. A step is one step
of implicit Euler, linearised once. Units have to fit each other, such as mm, s, mg and uN, which the defaults have.

A rod has a radius. The library keeps the middle line free of everything, exactly. The thickness is a matter of the solver here: near rows
say where the rod is close to a wall, and the solver wants that no gap (distance less radius) becomes negative. These constraints, with
Coulomb's friction, are solved on the compliance of the rod, J A^-1 J^T (Lenoir, Cotin, Duriez and Neumann 2006), by projected Gauss-Seidel.
So gaps hold as well as a solver holds them, and the middle line always.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

try:
    from scipy.linalg import cho_solve_banded, cholesky_banded
except ImportError as error:
    raise ImportError("dartsweep.rod needs SciPy, which is in the extra `rod`: pip install dartsweep[rod]", name="scipy") from error

from . import errors
from ._centreline import centreline, length_of, nearest_on, place_on
from ._chain import BAND, Array, add_bending, add_stretching, carried, frames, gauss_seidel
from ._core import MoveOptions
from .body import Body
from .enums import MoveFlag, Outcome, Response
from ._shapes import Records
from .options import options
from .scene import Scene

__all__ = ["Rod", "StepReport", "centreline", "length_of", "place_on"]

_LEAST_MASS = 1e-13  # share of the stiffness times dt^2; smaller masses would drown in rounding, and count as so much
_REACTION = 0.02  # s, in which the hand changes its speed
_MOST_TURN = 0.1  # of an edge in a step, rad: a turn by an angle a makes the edge longer by a^2 / 2. What turns faster gets more drag
_ATTEMPTS = 4  # with more and more drag


class StepReport(NamedTuple):
    """What a step did."""

    rows: int
    """Places where the rod was near something."""
    pressing: int
    """Rows with an impulse."""
    sweeps: int
    """Sweeps of Gauss-Seidel."""
    off: float
    """By how much a row is off, or has moved in the last sweep, at most: a length."""
    contacts: int
    """Contacts of the middle line, which the library met. Without them the rows alone have kept the rod free."""


class Rod:
    """A rod of a scene, and its introducer.

    The introducer is a straight tube that ends at `at`, within the vessel, and points into `direction`. What has not entered yet waits in it.
    At first two vertices are in the vessel; `push` feeds the others. The hand keeps the last edge. introducer=False: the whole rod
    begins in the vessel, as a straight line from `at`, and nothing holds it.

    length, segment: of the rod and of its edges. radius: of the rod.
    bending: force times area, E I; a number or one for each edge, the tip first. stretching: force, E A; a number or one for each edge.
    density: mass of a length.
    tip_curvature, tip_length: how much the tip is bent at rest, 1 / radius of the bend, and how much of it.
    friction: Coulomb's coefficient. drag: of the velocity, 1/s.
    most_force: the hand goes slower from half of this force on, and stops at it. It gives way, but by less than a segment.
    Raises an Error if the line is not free, as Scene.create_body.
    """

    def __init__(
        self,
        scene: Scene,
        at: ArrayLike,
        direction: ArrayLike,
        *,
        length: float,
        segment: float,
        radius: float,
        bending: ArrayLike = 1e7,
        stretching: ArrayLike = 2e9,
        density: float = 1.6,
        tip_curvature: float = 0.0,
        tip_length: float = 0.0,
        friction: float = 0.04,
        drag: float = 20.0,
        most_force: float = 1e6,
        introducer: bool = True,
    ) -> None:
        count = round(length / segment) + 1
        if not (count >= 4 and radius > 0 and density > 0):
            raise ValueError(f"a rod has 3 segments at least, a radius and a density: {length}, {segment}, {radius}, {density}")
        self._at = np.asarray(at, np.float64)
        self._axis = np.asarray(direction, np.float64) / np.linalg.norm(direction)
        if self._at.shape != (3,) or self._axis.shape != (3,):
            raise ValueError("a rod is in space: `at` and `direction` have 3 coordinates")
        self.segment, self.radius, self.friction, self.drag, self.most_force = segment, radius, friction, drag, most_force
        self.bending: Array = np.broadcast_to(np.asarray(bending, np.float64), count - 1).copy()
        """By edge, the tip first."""
        self.stretching: Array = np.broadcast_to(np.asarray(stretching, np.float64), count - 1).copy()
        """By edge."""
        self.mass: Array = np.full(count, density * segment)
        """By vertex."""
        self.mass[[0, -1]] /= 2
        self.rest_curvature: Array = np.zeros((count, 2))
        """By vertex: bending at rest about two axes across the rod, 2 tan(angle / 2). The ends have 0."""
        bent = slice(1, 1 + min(math.ceil(tip_length / segment), count - 2))
        self.rest_curvature[bent, 0] = 2 * math.tan(tip_curvature * segment / 2)
        self.load: Array = np.zeros((count, 3))
        """By vertex: forces from outside, such as weight."""
        self.held: NDArray[np.bool_] = np.zeros(count, np.bool_)
        """By vertex: it moves as `velocity` says, whatever the forces are."""
        self.velocity: Array = np.zeros((count, 3))
        """By vertex."""
        self.turned = 0.0
        """By how much the hand has turned the rod about its axis, rad."""
        self.recovery = 0.2
        """Share of a negative gap that a step takes back."""
        self.most_sweeps = 60
        """Most sweeps of Gauss-Seidel in a step."""
        self.tolerance = 1e-7 * radius
        """Sweeps end when no row is off, or moves in a sweep, by more."""
        self.report = StepReport(0, 0, 0, 0.0, 0)
        """What the last step did."""
        self.way: Array | None = None
        """A line, such as a centreline: the tip is pulled towards its point that is `look_ahead` ahead, with the force `steering`."""
        self.steering, self.look_ahead = 1e5, 4.0
        self.pushed = segment if introducer else length
        """How much of the rod the hand has pushed in."""
        self._speed = 0.0
        self._across: Array = np.cross(self._axis, np.eye(3)[np.abs(self._axis).argmin()])  # it, at the last edge
        self._environment = scene.environment
        self._has_introducer = introducer
        self._entered = 2 if introducer else count
        self.positions: Array = self._on_axis(np.arange(count))
        """By vertex, also of those in the introducer."""
        edges = [(i, i + 1) for i in range(self._entered - 1)]
        self.body: Body = scene.create_body(self.positions[: self._entered], edges)
        """What is in the vessel: vertices 0 to entered - 1."""
        self._impulses: Array = np.zeros((0, 3))
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

    def largest_stretch(self) -> float:
        """The largest | length / rest - 1 | of an edge in the vessel."""
        edges = np.diff(self.positions[: self._entered], axis=0)
        return float(np.abs(np.linalg.norm(edges, axis=1) / self.segment - 1).max())

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
        if self._has_introducer:
            self._feed(dt, speed)
        else:
            self._used = len(self.positions)
        if self.way is not None:
            self._steer(self.way)
        used, entered = self._used, self._entered
        drag = self.drag
        tangent, length = self._edges()
        factor, free = self._predict(dt, drag)
        most = 2 * dt * float(np.linalg.norm(free[:entered], axis=1).max()) + 0.5 * self.radius
        rows = self._rows(most)
        for attempt in range(_ATTEMPTS):
            velocity, sweeps, off = self._keep_gaps(rows, factor, free, dt)
            spin = np.diff(velocity, axis=0)
            spin -= tangent * (tangent * spin).sum(axis=1)[:, None]
            turn = dt * float((np.linalg.norm(spin, axis=1) / length).max())
            if turn <= _MOST_TURN or attempt == _ATTEMPTS - 1:
                break
            drag = 2 * (drag + 1 / dt) * turn / _MOST_TURN
            factor, free = self._predict(dt, drag)
        way = dt * velocity[:entered]
        way /= max(1.0, float(np.linalg.norm(way, axis=1).max()) / most)  # no row has told what is farther away
        before = self.positions[:used].copy()
        contacts = int(self.body.move(before[:entered] + way, self._slide).contact_count)
        self.positions[:entered] = self.body.positions()[:entered]
        self.positions[entered:] = self._on_axis(np.arange(entered, len(self.positions)))
        moving = ~self.held[:used]
        self.velocity[:used][moving] = (self.positions[:used] - before)[moving] / dt
        if self._has_introducer and self.pushed >= self.segment * self._entered:  # the next vertex has left the introducer
            self._enter()
        self.report = StepReport(len(rows), int((self._impulses[:, 0] > 0).sum()), sweeps, off, contacts)
        return self.report

    # --- the introducer

    def _on_axis(self, vertices: NDArray[Any]) -> Array:
        depth: Array = self.pushed - self.segment * vertices
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
        self._entered += 1

    def _steer(self, way: Array) -> None:
        to = place_on(way, self.reached(way) + self.look_ahead) - self.positions[0]
        self.load[0] = self.steering * to / max(float(np.linalg.norm(to)), self.look_ahead)

    # --- elasticity

    def _edges(self) -> tuple[Array, Array]:
        edge = np.diff(self.positions[: self._used], axis=0)
        length = np.maximum(np.linalg.norm(edge, axis=1), 1e-100)
        tangent: Array = edge / length[:, None]
        return tangent, length

    def _predict(self, dt: float, drag: float) -> tuple[Any, Array]:
        """The factor of A = M (1 + dt drag) + dt^2 K, and the velocities without contacts: A v' = M v + dt (forces)."""
        used = self._used
        force = self.load[:used].copy()
        matrix = np.zeros((BAND, 3 * used))  # [i - j, j] is A(i, j)
        tangent, length = self._edges()
        self._across -= tangent[-1] * (tangent[-1] @ self._across)
        self._across /= np.linalg.norm(self._across)
        across = math.cos(self.turned) * self._across + math.sin(self.turned) * np.cross(tangent[-1], self._across)
        add_stretching(force, matrix, tangent, length, self.segment, self.stretching[: used - 1])
        bending = 0.5 * (self.bending[: used - 2] + self.bending[1 : used - 1]) / self.segment
        add_bending(force, matrix, tangent, length, carried(across, tangent), bending, self.rest_curvature[1 : used - 1])
        matrix *= dt * dt
        mass = np.maximum(np.repeat(self.mass[:used], 3), _LEAST_MASS * matrix[0].max())
        matrix[0] += (1 + dt * drag) * mass
        now = self.velocity[:used].ravel()
        right = mass * now + dt * force.ravel()
        held = np.repeat(self.held[:used], 3)
        if held.any():  # their columns go to the right side
            given = np.where(held, now, 0)
            right -= matrix[0] * given
            for d in range(1, BAND):
                right[d:] -= matrix[d, :-d] * given[:-d]
                right[:-d] -= matrix[d, :-d] * given[d:]
                matrix[d, :-d][held[:-d] | held[d:]] = 0
            matrix[0, held], right[held] = 1, now[held]
        factor = cholesky_banded(matrix, overwrite_ab=True, lower=True, check_finite=False), True
        return factor, cho_solve_banded(factor, right, check_finite=False).reshape(-1, 3)

    # --- contacts

    def _rows(self, margin: float) -> Records:
        """The near rows. Impulses are carried over from the rows of before; each is (normal, across, across)."""
        rows = self.body.near_rows(margin, radius=self.radius)
        before, self._impulses = self._impulses, np.zeros((len(rows), 3))
        known = rows["previous"] < len(before)
        self._impulses[known] = before[rows["previous"][known]]
        return rows

    def _keep_gaps(self, rows: Records, factor: Any, free: Array, dt: float) -> tuple[Array, int, float]:
        """Velocities that keep every gap. Impulses begin with those of the step before."""
        if len(rows) == 0:
            return free, 0, 0.0
        count, used = len(rows), self._used
        frame = frames(rows["normal"])
        jacobian = np.zeros((count, 3, used, 3))
        for k in range(2):
            vertex = rows["vertices"][:, k].astype(np.int64)
            has = np.flatnonzero(vertex < used)
            jacobian[has, :, vertex[has]] += rows["weights"][has, k, None, None] * frame[has]
        wanted = np.zeros((count, 3))
        wanted[:, 0] = -np.where(rows["gap"] > 0, rows["gap"], self.recovery * rows["gap"]) / dt
        slip = np.einsum("rkvc,vc->rk", jacobian, free) - wanted
        jacobian[:, :, self.held[:used]] = 0  # they take no impulse
        flat = jacobian.reshape(3 * count, -1)
        response = cho_solve_banded(factor, flat.T, check_finite=False)
        compliance = flat @ response
        sweeps, off = gauss_seidel(
            compliance, slip.ravel(), self._impulses, self.friction, self.tolerance / dt, self.most_sweeps
        )
        velocity = free + (response @ self._impulses.ravel()).reshape(-1, 3)
        return velocity, sweeps, dt * off
