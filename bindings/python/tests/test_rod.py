"""A rod keeps still, bends as beams do, stays before walls by its radius, and comes in through an introducer."""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys
from collections.abc import Iterator

import numpy as np
import pytest
import pyvista

import dartsweep as ds
from dartsweep import rod

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
CUBE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)


@pytest.fixture
def box() -> Iterator[ds.Scene]:
    """A cube of 300 mm round the origin."""
    with ds.Environment(300 * (CUBE - 0.5), [range(8)]) as environment, ds.Scene(environment) as scene:
        yield scene


def lying(scene: ds.Scene, height: float, radius: float = 0.5, **values: float) -> rod.Rod:
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
    program = "import sys; sys.modules['scipy'] = None; import dartsweep.rod"
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
