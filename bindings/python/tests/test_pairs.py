"""Pairs of moving features: known times, exact ranks, and arguments that are refused."""

from __future__ import annotations

import numpy as np
import pytest

import dartsweep as ds
from dartsweep import dtypes

TRIANGLE = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
STARTS = np.array(
    [
        [(0.25, 0.25, 1), *TRIANGLE],
        [(-1, 0.25, 1), (1, 0.25, 1), (0, -1, 0), (0, 1, 0)],
        [(0.5, 0.25, 1), *TRIANGLE],
        [(0.5, 0.75, 1), *TRIANGLE],
    ]
)
KINDS = [ds.PairKind.VERTEX_FACE, ds.PairKind.EDGE_EDGE, ds.PairKind.VERTEX_FACE, ds.PairKind.VERTEX_FACE]
ENDS = STARTS.copy()
ENDS[0, 0, 2] = ENDS[1, :2, 2] = -2
ENDS[2, 0, 2] = -1


def test_times_and_ranks_are_exact() -> None:
    touches = ds.sweep_pairs(STARTS, ENDS, KINDS, ranks=True)
    assert touches.dtype == dtypes.PAIR_TOUCH
    assert touches["time"].tolist() == [1 / 3, 1 / 3, 0.5, 0]
    assert touches["touches"].tolist() == [1, 1, 1, 0]
    assert touches["rank"].tolist() == [0, 0, 2, 3]
    later = ENDS.copy()
    later[0, 0, 2] += 2**-52  # by so little that the rounded time is the same
    again = ds.sweep_pairs(STARTS, later, KINDS, ranks=True, threads=2)
    assert again["time"].tolist() == touches["time"].tolist() and again["rank"].tolist() == [1, 0, 2, 3]
    tenth = ENDS[:1].copy()
    tenth[0, 0, 2] = -9
    assert ds.sweep_pairs(STARTS[:1], tenth, KINDS[0])["time"] == np.nextafter(0.1, 0)


def test_arrays_are_filled_and_kinds_may_be_one() -> None:
    falls = [0, 2, 3]
    out = np.empty(3, dtypes.PAIR_TOUCH)
    assert ds.sweep_pairs(STARTS[falls], ENDS[falls], ds.PairKind.VERTEX_FACE, out=out) is out
    assert out["time"].tolist() == [1 / 3, 0.5, 0] and not out["rank"].any()
    assert ds.sweep_pairs(STARTS.tolist(), ENDS.tolist(), np.array(KINDS, np.uint8))["touches"].sum() == 3
    assert len(ds.sweep_pairs(np.empty((0, 4, 3)), np.empty((0, 4, 3)), ds.PairKind.EDGE_EDGE, ranks=True)) == 0


def test_pairs_of_the_plane() -> None:
    starts = np.array([[(x, 1), (0, 0), (1, 0)] for x in (0.5, 1, 1.5)])
    ends = starts.copy()
    ends[:, 0, 1] = -1, -2, -1
    touches = ds.sweep_pairs(starts, ends, ranks=True)
    assert touches["time"].tolist() == [0.5, 1 / 3, 0] and touches["rank"].tolist() == [1, 0, 2]


def test_what_is_wrong_is_refused() -> None:
    with pytest.raises(TypeError, match="kinds are needed"):
        ds.sweep_pairs(STARTS, ENDS)
    with pytest.raises(ds.errors.Unsupported, match=r"kinds\[3\] is 2"):
        ds.sweep_pairs(STARTS, ENDS, [0, 1, 0, 2])
    with pytest.raises(OverflowError):
        ds.sweep_pairs(STARTS, ENDS, 300)
    with pytest.raises(ds.errors.WrongSize, match="from has 16 entries, not 12"):
        ds.sweep_pairs(STARTS, ENDS, KINDS[:3])
    with pytest.raises(ds.errors.WrongSize, match="to has 12 entries, not 16"):
        ds.sweep_pairs(STARTS, ENDS[:3], KINDS)
    with pytest.raises(ds.errors.WrongSize, match="touches has 2 entries, not 4"):
        ds.sweep_pairs(STARTS, ENDS, KINDS, out=np.empty(2, dtypes.PAIR_TOUCH))
    with pytest.raises(ds.errors.WrongSize):
        ds.sweep_pairs(STARTS, np.zeros((4, 3, 2)), KINDS)
    for shape in ((4, 3), (4, 3, 3), (4, 4, 2)):
        with pytest.raises(ValueError, match=r"\(n, 4, 3\)"):
            ds.sweep_pairs(np.zeros(shape), np.zeros(shape), 0)
    wrong = ENDS.copy()
    wrong[2, 1, 0] = np.nan
    with pytest.raises(ds.errors.NonFinite, match=r"to\[9\]\[0\] is nan"):
        ds.sweep_pairs(STARTS, wrong, KINDS)


HALF_TURN = [0, 0, 0, 1, 0, 0, 1, 0, *[0] * 9]  # about z, from -y over x to y


def test_features_turn() -> None:
    starts = np.array([[(0, -5), (far, -9), (far, 9)] for far in (3, 5, 5.5)])
    touches = ds.sweep_rigid_pairs(starts, None, [HALF_TURN], [(0, -1)] * 3, ranks=True)
    assert touches["time"].tolist() == [0.25, 0.5, 0] and touches["touches"].tolist() == [1, 1, 0]
    assert touches["rank"].tolist() == [0, 1, 2]
    ends = starts.copy()
    ends[:, 1:, 0] = 0
    assert ds.sweep_rigid_pairs(starts, ends, [HALF_TURN], [(0, -1)] * 3, threads=2)["touches"].all()
    assert not ds.sweep_rigid_pairs(starts, None, [HALF_TURN], np.zeros((3, 2)))["touches"].any()
    straight = ds.sweep_rigid_pairs(STARTS, ENDS, np.empty((0, 17)), np.full((4, 2), -1), KINDS)
    assert straight["time"].tolist() == [1 / 3, 1 / 3, 0.5, 0]
    for motions, indices in (([HALF_TURN[:16]], [(0, -1)] * 3), ([HALF_TURN], [(1, -1)] * 3), ([HALF_TURN], [(0, -1)])):
        with pytest.raises(ValueError):
            ds.sweep_rigid_pairs(starts, None, motions, indices)
    with pytest.raises(ds.errors.OutOfRange, match="quaternion that is 0"):
        ds.sweep_rigid_pairs(starts, None, [[0, 0, 0, 1, 0, 0, 0, -1, *[0] * 9]], [(0, -1)] * 3)
