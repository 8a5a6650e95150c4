"""Near rows: a wire in a room with a pillar, and a solver that keeps the wire away from them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

import dartsweep as ds
from dartsweep import dtypes

CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
POINTS = [(x, y, z) for z in range(2) for y in range(3) for x in range(3)]
CELLS = [[(z * 3 + j + y) * 3 + i + x for x, y, z in CORNERS] for j in range(2) for i in range(2)]
WIRE = np.array([(0.25, 1.5, 0.375), (1.5, 0.25, 0.375)])


@pytest.fixture
def room() -> Iterator[ds.Environment]:
    """Four unit cubes; the last one is a pillar, whose edge is at x = y = 1."""
    with ds.Environment(POINTS, CELLS) as environment:
        environment.mark_volumes(environment.volume_id(3))
        yield environment


@pytest.fixture
def wire(room: ds.Environment) -> Iterator[ds.Body]:
    with ds.Scene(room) as scene:
        yield scene.create_body(WIRE, edges=[(0, 1)])


def test_rows_of_a_wire(wire: ds.Body) -> None:
    rows = wire.near_rows(0.25, radius=0.0625)
    assert rows.dtype == dtypes.NEAR_ROW and rows["distance"].tolist() == pytest.approx([0.25, 0.25, 0.125 / np.sqrt(0.5)])
    assert rows["gap"] == pytest.approx(rows["distance"] - 0.0625)
    assert rows["normal"] == pytest.approx(np.array([(1, 0, 0), (0, 1, 0), (-np.sqrt(0.5), -np.sqrt(0.5), 0)]))
    assert rows["vertices"][:, :2].tolist() == [[0, 2**32 - 1], [1, 2**32 - 1], [0, 1]]
    assert rows["weights"].tolist() == [[1, 0, 0], [1, 0, 0], [0.5, 0.5, 0]]
    assert rows["obstacle"]["kind"].tolist() == [ds.CellKind.FACE, ds.CellKind.FACE, ds.CellKind.EDGE]
    assert rows["obstacle_point"].tolist() == [[0, 1.5, 0.375], [1.5, 0, 0.375], [1, 1, 0.375]]
    assert rows["wall"]["generation"].all() and not rows["body"]["generation"].any()
    weighted = np.einsum("rw,rwk->rk", rows["weights"], WIRE[np.minimum(rows["vertices"], 1)])
    assert weighted == pytest.approx(rows["point"])
    rows["gap"][:] = 0  # an array of its own
    assert wire.near_rows(0.25, radius=0.0625)["gap"].all()
    assert len(wire.near_rows(0)) == 0
    with pytest.raises(ds.errors.OutOfRange, match="margin is -1"):
        wire.near_rows(-1)


def test_keys_and_numbers_of_before(wire: ds.Body) -> None:
    first = wire.near_rows(0.3)
    assert first["previous"].tolist() == [2**32 - 1] * 3
    wire.move(WIRE + (0.015625, 0, 0))
    second = wire.near_rows(0.3)
    assert second["key"].tolist() == first["key"].tolist() == sorted(first["key"].tolist())
    assert second["previous"].tolist() == [0, 1, 2] and second["gap"][0] == 0.265625


def test_the_jacobian_is_what_scipy_takes(wire: ds.Body) -> None:
    rows = wire.near_rows(0.3, jacobian=True)
    jacobian = wire.near_jacobian()
    data, columns, offsets = jacobian
    assert jacobian.shape == (3, 6) and columns.dtype == offsets.dtype == np.int32
    assert offsets.tolist() == [0, 3, 6, 12] and columns.tolist() == [0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5]
    assert data[:6].tolist() == [1, 0, 0, 0, 1, 0]
    assert data[6:] == pytest.approx(np.tile(rows["normal"][2] / 2, 2))
    # A move along x by h changes the gaps by the sums of the columns of x, times h.
    dense = np.zeros(jacobian.shape)
    dense[np.repeat(np.arange(3), np.diff(offsets)), columns] = data
    wire.move(WIRE + (0.015625, 0, 0))
    assert wire.near_rows(0.3)["gap"] - rows["gap"] == pytest.approx(0.015625 * dense[:, ::3].sum(axis=1))
    assert wire.near_jacobian().shape == (0, 6) and len(wire.near_jacobian().data) == 0


def test_the_jacobian_foretells_gaps() -> None:
    """Wires and surfaces near walls, each other and themselves: a small move changes each gap by its row."""
    rng = np.random.default_rng(5)
    points = np.array([(x, y, z) for z in range(5) for y in range(5) for x in range(5)], float)
    inner = ((points > 0) & (points < 4)).all(axis=1)
    points[inner] += rng.uniform(-0.15, 0.15, (inner.sum(), 3))
    first = [(k * 5 + j) * 5 + i for k in range(4) for j in range(4) for i in range(4)]
    cells = np.add.outer(first, [(z * 5 + y) * 5 + x for x, y, z in CORNERS])
    seen = set()
    with ds.Environment(points, cells) as environment, ds.Scene(environment, features=ds.Feature.BODY_CONTACTS) as scene:
        environment.mark_volumes([environment.volume_id(int(i)) for i in rng.choice(64, 14, replace=False)])
        bodies: list[ds.Body] = []
        while len(bodies) < 10:
            at = rng.uniform(0.05, 3.95, 3) + np.cumsum(rng.normal(0, 0.25, (6, 3)), axis=0)
            try:
                if len(bodies) % 2:
                    bodies.append(scene.create_body(at, edges=[(i, i + 1) for i in range(5)], flags=ds.BodyFlag.SELF_CONTACTS))
                else:
                    surface = [(0, 1, 2), (1, 3, 2)]
                    bodies.append(scene.create_body(at[:4], triangles=surface, level=ds.Level.FACES, flags=ds.BodyFlag.SELF_CONTACTS))
            except ds.Error:  # not all inside, or not free
                continue
        for body in bodies:
            for _ in range(5):
                rows = body.near_rows(0.4, radius=0.05, jacobian=True)
                values, columns, offsets = body.near_jacobian()
                before = body.positions()
                body.move(before + rng.normal(0, 1e-6, before.shape))
                step = (body.positions() - before).ravel()
                after = body.near_rows(0.4, radius=0.05)
                for row in after[after["previous"] < len(rows)]:
                    i = row["previous"]
                    entries = slice(offsets[i], offsets[i + 1])
                    change = row["gap"] - rows["gap"][i]
                    assert change == pytest.approx(values[entries] @ step[columns[entries]], abs=1e-8)
                    where = "walls" if row["body"]["generation"] == 0 else "itself" if row["body"]["index"] == body.id.index else "bodies"
                    seen.add((where, int((row["vertices"] < 2**32 - 1).sum()), int((row["obstacle_vertices"] < 2**32 - 1).sum())))
                body.move(before + rng.normal(0, 0.03, before.shape))
    assert {where for where, _, _ in seen} == {"walls", "bodies", "itself"} and len(seen) >= 9


def test_rows_in_the_plane() -> None:
    with ds.Environment([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2, 3)]) as square, ds.Scene(square) as scene:
        rope = scene.create_body([(0.25, 0.5), (0.75, 0.25)], edges=[(0, 1)])
        rows = rope.near_rows(0.25, jacobian=True)
        assert rows["distance"].tolist() == [0.25] * 3
        assert rows["normal"].tolist() == [[1, 0, 0], [0, 1, 0], [-1, 0, 0]]
        assert rope.near_jacobian().indices.tolist() == [0, 1, 2, 3, 2, 3] and rope.near_jacobian().shape == (3, 4)


def settle(wire: ds.Body, force: NDArray[np.float64], radius: float, steps: int) -> NDArray[np.float64]:
    """Pushes a wire, step by step, by what its rows allow. Returns the impulses of the last step."""
    impulses = np.zeros(0)
    for _ in range(steps):
        step = np.tile(force, len(wire.positions()))
        rows = wire.near_rows(margin=2 * float(np.linalg.norm(force)), radius=radius, jacobian=True)
        values, columns, offsets = wire.near_jacobian()
        before, impulses = impulses, np.zeros(len(rows))
        old = rows["previous"] < len(before)
        impulses[old] = before[rows["previous"][old]]  # a warm start
        for row in range(len(rows)):
            entries = slice(offsets[row], offsets[row + 1])
            step[columns[entries]] += values[entries] * impulses[row]
        for _ in range(20):  # projected Gauss-Seidel: no gap gets negative, impulses only push
            for row in range(len(rows)):
                entries = slice(offsets[row], offsets[row + 1])
                j = values[entries]
                gap = rows["gap"][row] + j @ step[columns[entries]]
                change = max(impulses[row] - gap / (j @ j), 0) - impulses[row]
                impulses[row] += change
                step[columns[entries]] += j * change
        wire.move(wire.positions() + step.reshape(-1, 3))
    return impulses


def test_a_solver_keeps_the_wire_away(wire: ds.Body) -> None:
    radius = 0.03125
    impulses = settle(wire, np.array([0.02, 0.02, -0.01]), radius, 60)
    rows = wire.near_rows(0.01, radius)
    assert (rows["gap"] > -1e-3).all() and (impulses > 0).any()
    assert len(wire.contacts()) == 0  # the rows alone kept it away
    assert wire.positions()[:, 2] == pytest.approx(radius, abs=1e-3)  # on the floor
