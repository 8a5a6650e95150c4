"""The mechanics of a chain of vertices, for rod.py: bending and stretching as a band matrix, and contacts."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BAND = 9
"""Diagonals of the lower half of a matrix: a vertex is coupled with the next two. Entry [i - j, j] is A(i, j)."""

_FOLD = 0.06  # least 1 + cos of the angle between two edges: sharper folds, of more than about 160 degrees, count as such a fold
_TOGETHER = 5  # sweeps from one direct solution of the pressing rows to the next
_LEAST_PIVOT = 1e-10  # share of the diagonal: two rows at one place are the same to rounding


def add_stretching(force: Array, matrix: Array, tangent: Array, length: Array, rest: float, stiffness: Array) -> None:
    """Adds what edges do: forces, and their negative derivatives but for those of pressed edges that would make them turn aside."""
    pull = stiffness * (length / rest - 1)
    force[:-1] += pull[:, None] * tangent
    force[1:] -= pull[:, None] * tangent
    sideways = np.maximum(pull, 0) / length
    block = (stiffness / rest - sideways)[:, None, None] * tangent[:, :, None] * tangent[:, None, :]
    block += sideways[:, None, None] * np.eye(3)
    _add(matrix, np.block([[block, -block], [-block, block]]))


def add_bending(force: Array, matrix: Array, tangent: Array, length: Array, first: Array, stiffness: Array, rest: Array) -> None:
    """Adds what vertices between two edges do: forces, and the Gauss-Newton part of the derivatives, which is exact at rest.
    first: directors of edges."""
    second = np.cross(tangent, first)
    e, f = tangent[:-1], tangent[1:]
    chi = np.maximum(1 + (e * f).sum(axis=1), _FOLD)[:, None]
    binormal = 2 / chi * np.cross(e, f)
    middle, m1, m2 = (e + f) / chi, (first[:-1] + first[1:]) / chi, (second[:-1] + second[1:]) / chi
    k1, k2 = 0.5 * chi * (binormal * m2).sum(axis=1)[:, None], -0.5 * chi * (binormal * m1).sum(axis=1)[:, None]
    by_e = np.stack([np.cross(f, m2) - k1 * middle, -np.cross(f, m1) - k2 * middle], axis=2) / length[:-1, None, None]
    by_f = np.stack([-np.cross(e, m2) - k1 * middle, np.cross(e, m1) - k2 * middle], axis=2) / length[1:, None, None]
    gradient = np.concatenate([-by_e, by_e - by_f, by_f], axis=1)  # (vertices, 9, 2)
    stress = stiffness[:, None] * (np.hstack([k1, k2]) - rest)
    pull = np.einsum("vik,vk->vi", gradient, stress).reshape(-1, 3, 3)
    for k in range(3):
        force[k : k + len(e)] -= pull[:, k]
    _add(matrix, stiffness[:, None, None] * (gradient @ gradient.transpose(0, 2, 1)))


def carried(across: Array, tangent: Array) -> Array:
    """Directors: by edge a unit vector across it. `across` is that of the last edge, and goes to the first one without twist."""
    turned = _turns(tangent[1:], tangent[:-1])[::-1]
    reach = 1
    while reach < len(turned):  # products of neighbours: of 2, 4, 8 ...
        turned[reach:] = turned[reach:] @ turned[:-reach]
        reach *= 2
    first: Array = np.vstack([(turned @ across)[::-1], across])
    first -= tangent * (tangent * first).sum(axis=1)[:, None]
    first /= np.linalg.norm(first, axis=1)[:, None]
    return first


def _turns(start: Array, end: Array) -> Array:
    """Matrices of the smallest rotations of unit vectors to unit vectors; opposite ones are not turned."""
    axis = np.cross(start, end)
    scale = 1 + (start * end).sum(axis=1)
    skew = np.zeros((len(axis), 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        skew[:, k, j], skew[:, j, k] = axis[:, i], -axis[:, i]
    turned: Array = np.eye(3) + skew + skew @ skew / np.maximum(scale, 1e-9)[:, None, None]
    turned[scale < 1e-9] = np.eye(3)
    return turned


def _add(matrix: Array, blocks: Array) -> None:
    """Adds a block of each vertex and the next ones to a band matrix."""
    count, size = blocks.shape[:2]
    for j in range(size):
        for i in range(j, size):
            matrix[i - j, j : j + 3 * count : 3] += blocks[:, i, j]


def frames(normal: Array) -> Array:
    """By normal: itself and two unit vectors across."""
    any_vector = np.eye(3)[np.abs(normal).argmin(axis=1)]
    u = np.cross(normal, any_vector)
    u /= np.linalg.norm(u, axis=1)[:, None]
    return np.stack([normal, u, np.cross(normal, u)], axis=1)


def gauss_seidel(compliance: Array, slip: Array, impulses: Array, friction: float, tolerance: float, most: int) -> tuple[int, float]:
    """Impulses, in place, with which no normal slip is negative, and friction stays in its cone and brakes as much as it can. Returns the
    number of sweeps, and by how much a slip is off or has changed in the last one at most.

    Plain sweeps are slow where many rows press on a stiff rod. So now and then the rows that press are solved at once, with friction as it
    is, as far as none of them pulls.
    """
    count = len(impulses)
    impulses[:, 0] = np.maximum(impulses[:, 0], 0)
    now = slip + compliance @ impulses.ravel()
    diagonal = compliance.diagonal().reshape(-1, 3)
    across = diagonal[:, 1:].max(axis=1).tolist()
    normal = diagonal[:, 0].tolist()
    columns = compliance.reshape(3 * count, count, 3).transpose(1, 0, 2).copy()
    taking = diagonal.min(axis=1) > 0  # not those of held vertices
    off, sweep = 0.0, 0
    for sweep in range(1, most + 1):
        off = 0.0
        pressing = np.flatnonzero(taking & ((impulses[:, 0] > 0) | (now[::3] < 0)))  # most rows do not press
        for i in pressing.tolist() if sweep % 2 else pressing[::-1].tolist():
            n, u, v = impulses[i].tolist()
            a, b, c = now[3 * i : 3 * i + 3].tolist()
            new = max(0.0, n - a / normal[i])
            p, q = u - b / across[i], v - c / across[i]
            size = math.hypot(p, q)
            if size > friction * new:
                p, q = p * friction * new / size, q * friction * new / size
            if new == n and p == u and q == v:
                continue
            step = np.array((new - n, p - u, q - v))
            impulses[i] = new, p, q
            moved = columns[i] @ step
            now += moved
            off = max(off, *np.abs(moved[3 * i : 3 * i + 3]).tolist())
        gaps = np.where(impulses[:, 0] > 0, np.abs(now[::3]), -now[::3])[taking]
        off = float(max(off, gaps.max(initial=0)))
        if off <= tolerance:
            break
        if sweep % _TOGETHER == 0:
            pressing = np.flatnonzero(taking & (impulses[:, 0] > 0))
            block = compliance[np.ix_(3 * pressing, 3 * pressing)]
            block.flat[:: len(pressing) + 1] *= 1 + _LEAST_PIVOT
            change = np.linalg.solve(block, -now[3 * pressing])
            pulling = change < 0
            share = float((-impulses[pressing, 0][pulling] / change[pulling]).min(initial=1))
            impulses[pressing, 0] = np.maximum(impulses[pressing, 0] + share * change, 0)
            now = slip + compliance @ impulses.ravel()
    return sweep, off
