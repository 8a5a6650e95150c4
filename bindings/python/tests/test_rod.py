"""A rod keeps still, bends as beams do, stays before walls by its radius, and comes in through an introducer."""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import pyvista
from numpy.typing import NDArray

import dartsweep as ds
from dartsweep import rod

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
CUBE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)


@pytest.fixture
def box() -> Iterator[ds.Scene]:
    """A cube of 300 mm round the origin."""
    with ds.Environment(300 * (CUBE - 0.5), [range(8)]) as environment, ds.Scene(environment) as scene:
        yield scene


def lying(scene: ds.Scene, height: float, radius: float = 0.5, **values: Any) -> rod.Rod:
    """A free rod along x, so high above the floor of the box."""
    return rod.Rod(scene, (-20, 0, height - 150), (1, 0, 0), length=40, segment=2, radius=radius, introducer=False, **values)


def test_without_forces_it_keeps_still(box: ds.Scene) -> None:
    wire = lying(box, 100)
    before = wire.positions.copy()
    for _ in range(20):
        wire.step(0.01)
    assert np.array_equal(wire.positions, before) and not wire.velocity.any() and wire.report.rows == 0


@pytest.mark.parametrize("stiffer", [1, 1e6])
def test_a_cantilever_sags_as_a_beam(box: ds.Scene, stiffer: float) -> None:
    length, weight, bending = 100.0, 5.0 * stiffer, 1e7 * stiffer
    beam = rod.Rod(
        box, (-50, 0, 0), (1, 0, 0), length=length, segment=1, radius=0.5, bending=bending, stretching=2e9 * stiffer, introducer=False
    )
    beam.held[-2:] = True  # the other end is free
    beam.load[:, 2] = -weight * beam.mass / beam.mass[1]
    for _ in range(200):
        beam.step(1.0)
    assert -beam.tip[2] == pytest.approx(weight * length**4 / (8 * bending), rel=0.03)
    assert beam.largest_stretch() < 1e-6


def test_a_bent_tip_is_a_circle_and_turns_with_the_hand(box: ds.Scene) -> None:
    wire = rod.Rod(
        box, (0, 0, 0), (1, 0, 0), length=20, segment=1, radius=0.5, tip_curvature=0.1, tip_length=10, introducer=False
    )
    wire.held[-2:] = True
    for _ in range(200):
        wire.step(0.05)
    edges = np.diff(wire.positions, axis=0)
    angles = np.arccos((edges[1:] * edges[:-1]).sum(axis=1).clip(-1, 1))
    assert angles[:10] == pytest.approx(0.1, rel=1e-2) and angles[10:].max() < 2e-3
    aside = wire.tip[1:]
    wire.turned = np.pi / 2
    for _ in range(400):
        wire.step(0.05)
    assert np.linalg.norm(wire.tip[1:]) == pytest.approx(np.linalg.norm(aside), rel=0.02)
    assert wire.tip[1:] @ aside == pytest.approx(0, abs=0.05 * (aside @ aside))
    assert wire.largest_stretch() < 1e-2


@pytest.mark.parametrize("stiffer", [1, 1e6])
def test_a_wall_keeps_it_off_by_its_radius(box: ds.Scene, stiffer: float) -> None:
    wire = lying(box, 3, bending=1e7 * stiffer, stretching=2e9 * stiffer)
    wire.load[:, 2] = -2e4 * np.linspace(0.5, 1, len(wire.load))
    stretch = 0.0
    for _ in range(120):
        report = wire.step(0.01)
        stretch = max(stretch, wire.largest_stretch())
        assert np.isfinite(wire.positions).all() and report.contacts == 0  # the rows alone keep it
    assert report.pressing > 0 and wire.is_free() and stretch <= 0.01
    assert -1e-6 * wire.radius <= wire.smallest_gap() < 1e-3 * wire.radius
    assert wire.positions[:, 2].min() >= -150 + wire.radius * (1 - 1e-6)


def test_friction_holds_it_up_to_its_cone(box: ds.Scene) -> None:
    way = {}
    for share in (0.9, 1.5):
        wire = lying(box, 0.5, friction=0.3)
        wire.load[:, 2] = -1e4
        for _ in range(50):
            wire.step(0.01)
        before = wire.positions.copy()
        wire.load[:, 1] = share * 0.3 * 1e4
        for _ in range(50):
            wire.step(0.01)
        way[share] = float(np.abs(wire.positions - before)[:, 1].max())
        wire.body.destroy()
    assert way[0.9] < 1e-3 and way[1.5] > 1


def test_what_does_not_press_does_not_rub(box: ds.Scene) -> None:
    wire = lying(box, 0.5, friction=0.3)
    wire.load[:, 2], wire.load[:, 1] = -1e4, 2e3
    for _ in range(20):
        wire.step(0.01)
    assert wire.report.pressing == 21
    wire.load[:, 2] = 1e4
    wire.step(0.01)
    assert wire.report.rows == 21 and wire.report.pressing == 0 and wire.velocity[:, 1].min() > 0


@pytest.mark.parametrize("side, friction", [(0.0, 0.1), (1000.0, 0.3)])
def test_a_hundred_edges_on_a_floor_are_solved(box: ds.Scene, side: float, friction: float) -> None:
    """All press and stick: sweeps alone would not come to the end."""
    line = np.arange(101)[:, None] * [0.5, 0, 0] + [-25, 0, 0.52 - 150]
    wire = rod.Rod(box, points=line, radius=0.5, friction=friction)
    wire.load[:, 1:] = side, -2e4
    for _ in range(50):
        report = wire.step(0.01)
        assert report.off <= wire.tolerance and report.contacts == 0
    assert report.pressing == 101 and np.abs(wire.velocity).max() < 1e-3 and wire.smallest_gap() > -1e-5


def test_what_no_row_can_keep_the_library_does(box: ds.Scene) -> None:
    """Without rows the solver knows nothing of the floor, and the middle line stays in the box."""
    wire = lying(box, 3)
    wire.load[:, 2] = -1e9
    wire.recovery, wire.most_sweeps = 0.0, 1
    contacts = 0
    for _ in range(30):
        contacts += wire.step(0.1).contacts
        assert wire.is_free() and wire.positions[:, 2].min() >= -150


@pytest.fixture
def tube() -> Iterator[ds.Environment]:
    """A channel, 6 mm wide: 10 cubes along x, 5 more along y."""
    place = [(i, 0) for i in range(10)] + [(9, j) for j in range(1, 6)]
    corners = 6.0 * np.concatenate([CUBE + (i, j, 0) for i, j in place])
    points, index = np.unique(corners, axis=0, return_inverse=True)
    with ds.Environment(points, index.reshape(-1, 8)) as environment:
        yield environment


def test_a_centreline_goes_from_end_to_end(tube: ds.Environment) -> None:
    way = rod.centreline(tube, start=(0, 3, 3), end=(57, 36, 3))
    assert way[0].tolist() == [3, 3, 3] and way[-1].tolist() == [57, 33, 3]
    assert 70 < rod.length_of(way) < 84
    assert rod.place_on(way, 10) == pytest.approx([13, 3, 3], abs=0.05) and rod.place_on(way, 1e3).tolist() == way[-1].tolist()
    either = rod.centreline(tube)
    assert {tuple(either[0]), tuple(either[-1])} <= {(3, 3, 3), (57, 33, 3), (9, 3, 3), (57, 27, 3)}
    with pytest.raises(ValueError, match="two passable volumes"):
        tube.mark_volumes([tube.volume_id(i) for i in range(1, 15)])
        rod.centreline(tube)


def test_the_introducer_feeds_it(tube: ds.Environment) -> None:
    with ds.Scene(tube) as scene:
        wire = rod.Rod(scene, (2, 3, 3), (2, 0, 0), length=80, segment=2, radius=0.45, bending=1e6)
        assert wire.entered == 2 and wire.tip.tolist() == [4, 3, 3] and wire.positions[-1].tolist() == [4 - 80, 3, 3]
        assert wire.push(20) == pytest.approx(20) and wire.entered == 12
        assert wire.tip == pytest.approx([24, 3, 3], abs=1e-3) and wire.largest_stretch() < 1e-3
        wire.push(34)  # round the corner
        stretch, gap = 0.0, wire.radius
        for _ in range(10):
            wire.push(1)
            stretch, gap = max(stretch, wire.largest_stretch()), min(gap, wire.smallest_gap())
            assert wire.is_free() and wire.positions[wire.entered :, 1:].tolist() == [[3, 3]] * (41 - wire.entered)
        assert wire.body.counts.vertex_count == wire.entered == 1 + wire.pushed // 2
        assert stretch < 0.01 and gap > -0.05 * wire.radius
        assert np.array_equal(wire.body.positions(), wire.positions[: wire.entered])


def test_the_hand_stops_where_it_gets_too_hard(tube: ds.Environment) -> None:
    with ds.Scene(tube) as scene:
        wire = rod.Rod(scene, (57, 3, 3), (0, 1, 0), length=80, segment=2, radius=0.45, bending=1e8)
        pushed = wire.push(60, most_steps=200)
        assert 29 < pushed < 33 and wire.is_free() and wire.largest_stretch() < 0.01


def test_what_a_rod_is_not(box: ds.Scene) -> None:
    with pytest.raises(ValueError, match="3 segments"):
        rod.Rod(box, (0, 0, 0), (1, 0, 0), length=4, segment=2, radius=0.5)
    with pytest.raises(ds.Error):
        rod.Rod(box, (149, 0, 0), (1, 0, 0), length=40, segment=2, radius=0.5)
    with pytest.raises(ValueError, match="in space"):
        rod.Rod(box, (0, 0), (1, 0), length=40, segment=2, radius=0.5)


def test_the_extra_is_named() -> None:
    """A rod needs NumPy alone, and a centreline SciPy."""
    program = "import sys; sys.modules['scipy'] = None; from dartsweep import rod; rod.centreline(None)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert "pip install dartsweep[rod]" in done.stderr


def test_the_example(tmp_path: pathlib.Path) -> None:
    assert len((EXAMPLES / "guidewire.py").read_text().splitlines()) <= 30
    done = subprocess.run([sys.executable, EXAMPLES / "guidewire.py"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert not pyvista.system_supports_plotting() or (tmp_path / "guidewire.png").stat().st_size > 1000
    told = re.search(r"came to ([\d.]+) of ([\d.]+) mm; the middle line is free\nlargest stretch ([\d.]+)%, smallest gap (\S+) mm", done.stdout)
    assert told is not None
    reached, length, stretch, gap = map(float, told.groups())
    assert reached >= length - 1.05 and stretch <= 1 and gap > -0.02


def helix(turns: float, radius: float, pitch: float, count: int) -> NDArray[np.float64]:
    angle = np.linspace(0, 2 * np.pi * turns, count)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), pitch * angle / (2 * np.pi)], axis=1)


def test_it_begins_on_any_curve_and_springs_open(box: ds.Scene) -> None:
    line = helix(1.5, 10, 8, 80)
    kept = rod.Rod(box, points=line, radius=0.5)
    assert np.array_equal(kept.positions, line) and kept.entered == 80 and kept.largest_stretch() == 0
    kept.keep_shape()
    for _ in range(20):
        kept.step(0.01)
    assert np.abs(kept.positions - line).max() < 1e-9
    kept.body.destroy()
    opens = rod.Rod(box, points=line, radius=0.5)
    for _ in range(600):
        opens.step(0.02)
    ends = float(np.linalg.norm(opens.positions[0] - opens.positions[-1]))
    assert ends == pytest.approx(rod.length_of(line), rel=1e-2) and opens.largest_stretch() < 1e-2


def test_edges_of_a_curve_may_differ(box: ds.Scene) -> None:
    """The sag of a cantilever does not depend on how the line is cut into edges."""
    length, weight, bending = 100.0, 5.0, 1e7
    along = length * np.sort(np.random.default_rng(3).uniform(0, 1, 120))
    along = np.concatenate([[0.0], along[np.diff(along, prepend=0) > 0.2], [length, length + 1]])
    beam = rod.Rod(box, points=along[:, None] * [1.0, 0, 0] - [50, 0, 0], radius=0.5, bending=bending, density=1.0)
    beam.held[-2:] = True
    beam.load[:, 2] = -weight * beam.mass
    for _ in range(200):
        beam.step(1.0)
    assert -beam.tip[2] == pytest.approx(weight * length**4 / (8 * bending), rel=0.03)


def test_a_direction_across_the_last_edge_is_found_again(box: ds.Scene) -> None:
    """The rod turns by a quarter about the axis that its last edge began across."""
    wire = lying(box, 100)
    across = wire._across.copy()
    wire._across = np.array([1.0, 0, 0])  # along the edge
    wire.step(0.01)
    assert np.isfinite(wire.positions).all() and abs(wire._across[0]) < 1e-12 and np.linalg.norm(across) == pytest.approx(1)


def test_a_twist_spreads_evenly_and_untwists(box: ds.Scene) -> None:
    wire = rod.Rod(box, points=np.arange(21)[:, None] * [2.0, 0, 0] - [20, 0, 0], radius=0.5, twisting=8e6)
    wire.held[[0, 1, -2, -1]] = True
    wire.held_turn[[0, -1]] = True
    for _ in range(100):
        wire.turned += 0.01
        wire.step(0.01)
    for _ in range(300):
        wire.step(0.05)
    assert wire.twist[1:-1] == pytest.approx(1 / 19 * np.ones(19), rel=1e-3) and not wire.twist[[0, -1]].any()
    assert np.abs(wire.positions[:, 1:]).max() < 1e-6
    wire.held_turn[0] = False
    for _ in range(300):
        wire.step(0.05)
    assert np.abs(wire.twist).max() < 1e-3


def test_a_hand_that_turns_twists_the_wire_in_its_introducer(tube: ds.Environment) -> None:
    with ds.Scene(tube) as scene:
        wire = rod.Rod(scene, (2, 3, 3), (2, 0, 0), length=80, segment=2, radius=0.45, bending=1e6, twisting=8e5)
        wire.push(20)
        for _ in range(50):
            wire.turned += 0.02
            wire.step(0.01)
        assert wire.twist.sum() == pytest.approx(0, abs=0.05)  # nothing holds the tip
        assert wire.is_free() and np.isfinite(wire.positions).all()


def meeting_box() -> ds.Environment:
    return ds.Environment(300 * (CUBE - 0.5), [range(8)])


def test_rods_that_cross_push_each_other() -> None:
    """Momentum goes from one to the other, and their gap stays."""
    with meeting_box() as environment, ds.Scene(environment, ds.Feature.BODY_CONTACTS) as scene:
        along = np.arange(-20, 21, 2.0)
        first = rod.Rod(scene, points=along[:, None] * [1.0, 0, 0], radius=0.5, drag=0, friction=0)
        second = rod.Rod(scene, points=along[:, None] * [0, 1.0, 0] + [0.3, 0, 3], radius=0.8, drag=0, friction=0)
        second.velocity[:, 2] = -20
        momentum = float((second.mass * second.velocity[:, 2]).sum())
        least, pressed = np.inf, 0
        for _ in range(60):
            reports = rod.step([first, second], 0.005)
            pressed += reports[0].pressing
            assert sum(report.contacts for report in reports) == 0
            distance = min(row["distance"] for row in first.body.near_rows(5.0)) if len(first.body.near_rows(5.0)) else np.inf
            least = min(least, distance)
        assert pressed > 0 and least >= 1.3 * (1 - 1e-3)
        now = [float((wire.mass * wire.velocity[:, 2]).sum()) for wire in (first, second)]
        assert sum(now) == pytest.approx(momentum, rel=1e-6) and now[0] < 0.2 * momentum


def test_a_rod_that_steps_alone_meets_others_that_stand() -> None:
    with meeting_box() as environment, ds.Scene(environment, ds.Feature.BODY_CONTACTS) as scene:
        along = np.arange(-20, 21, 2.0)
        stands = rod.Rod(scene, points=along[:, None] * [1.0, 0, 0], radius=0.5)
        falls = rod.Rod(scene, points=along[:, None] * [0, 1.0, 0] + [0.3, 0, 3], radius=0.8)
        falls.load[:, 2] = -1e4
        for _ in range(100):
            falls.step(0.01)
        middle = falls.positions[10]
        assert middle[2] == pytest.approx(1.3, abs=1e-2) and not stands.velocity.any()
        assert falls.positions[[0, -1], 2].max() < 1  # its ends hang down


def test_it_meets_itself() -> None:
    """A loop whose ends are pulled through each other keeps two radii between its parts."""
    with meeting_box() as environment, ds.Scene(environment, ds.Feature.BODY_CONTACTS) as scene:
        angle = np.linspace(-1.5 * np.pi, 1.5 * np.pi, 61)
        loop = np.stack([15 * np.sin(angle), -15 * np.cos(angle), 0.4 * angle], axis=1)
        wire = rod.Rod(scene, points=loop, radius=0.5, bending=1e4, meets_itself=True)
        wire.load[0], wire.load[-1] = (0, 0, 1e4), (0, 0, -1e4)
        closest, pressed = np.inf, 0
        for _ in range(150):
            report = wire.step(0.01)
            pressed += report.pressing
            rows = wire.body.near_rows(3.0)
            far = [row for row in rows if abs(int(row["vertices"][0]) - int(row["obstacle_vertices"][0])) > 5]
            closest = min([closest, *(float(row["distance"]) for row in far)])
        assert pressed > 0 and closest > 2 * wire.radius * (1 - 0.02) and wire.is_free()
