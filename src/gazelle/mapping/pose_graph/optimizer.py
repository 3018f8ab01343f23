"""Least squares over a graph of poses in the plane.

Gauss-Newton with a sparse factorisation (Grisetti et al., "A tutorial on graph-based SLAM", 2010);
loop closures count by Huber's loss, so that a wrong one pulls and does not tear; once the others
agree, those that still contradict fade by dynamic covariance scaling (Agarwal et al., 2013).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import SuperLU, splu

from gazelle.mapping.pose_graph.constraints import Edges, doubtful
from gazelle.mapping.se2 import Poses, wrap_angle

__all__ = ["GraphSettings", "Pattern", "Residuals", "optimise", "pattern_of", "residuals"]


_SYMMETRIC = {"SymmetricMode": True}


@dataclass(frozen=True, slots=True, eq=False)
class Pattern:
    """The filled 3 × 3 blocks of a sparse matrix, a row and a column of them per pose.

    Attributes:
        rank: where each pose stands in the matrix, int64 (n,), such that little more is filled
            when it is factorised.
        order: of blocks as they come: those of one place in the matrix follow each other, (b,).
        starts: where each place begins among them, (p,).
        targets: where the numbers of each place stand in the data, (p, 3, 3).
        indices: rows of the data.
        ends: where columns begin and end in them.
    """

    rank: NDArray[np.int64]
    order: NDArray[np.int64]
    starts: NDArray[np.int64]
    targets: NDArray[np.int64]
    indices: NDArray[np.int32]
    ends: NDArray[np.int32]

    def factorised(self, blocks: NDArray[np.float64]) -> SuperLU:
        """Return the factors of a symmetric matrix.

        Args:
            blocks: (4m + n, 3, 3), of all edges those of (tail, tail), of all those of
                (tail, head), of (head, tail), of (head, head), and of the diagonal.
        """
        data = np.empty(self.targets.size)
        data[self.targets] = np.add.reduceat(blocks[self.order], self.starts, axis=0)
        size = 3 * len(self.rank)
        matrix = csc_matrix((data, self.indices, self.ends), shape=(size, size))
        return splu(matrix, permc_spec="NATURAL", diag_pivot_thresh=0.0, options=_SYMMETRIC)


def pattern_of(edges: Edges, count: int) -> Pattern:
    """Return the pattern of a graph of so many poses."""
    rank = _ranks(edges, count)
    tail, head, diagonal = rank[edges.tail], rank[edges.head], rank
    rows = np.concatenate([tail, tail, head, head, diagonal])
    columns = np.concatenate([tail, head, tail, head, diagonal])
    key = columns * count + rows
    order = np.argsort(key, kind="stable")
    starts = np.flatnonzero(np.diff(key[order], prepend=-1))
    row, column = rows[order][starts], columns[order][starts]
    in_column = np.bincount(column, minlength=count)
    first = np.cumsum(in_column) - in_column
    three, place = np.arange(3), np.arange(len(starts)) - first[column]
    begin = 9 * first[:, None] + 3 * in_column[:, None] * three
    targets = begin[column][:, None, :] + 3 * place[:, None, None] + three[:, None]
    indices = np.empty(9 * len(starts), np.int32)
    indices[targets] = (3 * row[:, None] + three)[:, :, None]
    ends = np.append(begin.ravel(), 9 * len(starts)).astype(np.int32)
    return Pattern(rank, order, starts, targets, indices, ends)


def _ranks(edges: Edges, count: int) -> NDArray[np.int64]:
    """Return the places of poses by minimum degree, which are those of their blocks."""
    degree = np.bincount(edges.tail, minlength=count) + np.bincount(edges.head, minlength=count)
    values = np.concatenate([-np.ones(2 * len(edges.tail)), degree + 1.0])
    itself = np.arange(count)
    rows = np.concatenate([edges.tail, edges.head, itself])
    columns = np.concatenate([edges.head, edges.tail, itself])
    matrix = csc_matrix((values, (rows, columns)), shape=(count, count))
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=_SYMMETRIC)
    return np.asarray(factors.perm_c, dtype=np.int64)


@dataclass(frozen=True, slots=True)
class GraphSettings:
    """How poses are fitted to what is known of them.

    Attributes:
        anchor: weight that holds the first pose where it is.
        damping: added to all diagonals, so that a pose that nothing holds can be solved for.
        converged: steps smaller than this, m and rad, end the iterations.
        settled: from the second half of at least so many iterations on, loop closures that are
            still far off lose their influence.
        torn_squared: far off, in squared standard deviations: Φ of dynamic covariance scaling
            (Agarwal et al., 2013).
        doubt_squared: the same of relations of the drive that are doubtful.
    """

    anchor: float = 1e6
    damping: float = 1e-6
    converged: float = 1e-4
    settled: int = 10
    torn_squared: float = 30.0
    doubt_squared: float = 2.0


_USUAL = GraphSettings()


class Residuals(NamedTuple):
    """How far poses are from what edges say.

    Attributes:
        error: (m, 3), metres and radians, in the frame of the tail.
        squared: ``eᵀ Λ e``, (m,).
    """

    error: NDArray[np.float64]
    squared: NDArray[np.float64]


def residuals(poses: Poses, edges: Edges) -> Residuals:
    """Return how far poses, shape (n, 3), are from what edges say."""
    error = _errors(poses, edges)
    return Residuals(error, np.einsum("mi,mij,mj->m", error, edges.information, error))


def optimise(
    poses: Poses,
    edges: Edges,
    *,
    iterations: int = 10,
    huber: float = 3.0,
    settings: GraphSettings = _USUAL,
) -> Poses:
    """Return the poses, shape (n, 3), that fit the edges best; the first one stays.

    Args:
        poses: where they are now.
        edges: what is known of them; every pose should be reached by some.
        iterations: at most so many.
        huber: from how many standard deviations on a loop closure counts linearly.
        settings: the other numbers.
    """
    poses = poses.copy()
    if not len(edges.tail):
        return poses
    pattern = pattern_of(edges, len(poses))
    for iteration in range(iterations):
        tears = 2 * iteration >= max(iterations, settings.settled)
        step = _step(poses, edges, pattern, huber, settings, tears=tears)
        poses += step
        poses[:, 2] = wrap_angle(poses[:, 2])
        if np.abs(step).max() < settings.converged and (tears or iterations < settings.settled):
            break
    return poses


def _step(
    poses: Poses,
    edges: Edges,
    pattern: Pattern,
    huber: float,
    settings: GraphSettings,
    *,
    tears: bool,
) -> Poses:
    found = residuals(poses, edges)
    far = edges.is_loop & (found.squared > huber**2)
    weight = np.where(far, huber / np.sqrt(np.maximum(found.squared, 1e-12)), 1.0)
    # What may be wrong anyway gives way before what is sure is bent.
    doubts = ~edges.is_loop & doubtful(edges.information)
    yields = 2 * settings.doubt_squared / (settings.doubt_squared + found.squared)
    weight = np.where(doubts, np.minimum(1.0, yields) ** 2, weight)
    if tears:
        scaled = 2 * settings.torn_squared / (settings.torn_squared + found.squared)
        weight = np.where(edges.is_loop, weight * np.minimum(1.0, scaled) ** 2, weight)
    of_tail, of_head = _jacobians(poses, edges)
    weighted = edges.information * weight[:, None, None]
    tail_part = of_tail.transpose(0, 2, 1) @ weighted
    head_part = of_head.transpose(0, 2, 1) @ weighted
    diagonal = np.tile(settings.damping * np.eye(3), (len(poses), 1, 1))
    diagonal[0] = settings.anchor * np.eye(3)
    factors = pattern.factorised(
        np.concatenate([
            tail_part @ of_tail, tail_part @ of_head, head_part @ of_tail, head_part @ of_head,
            diagonal,
        ])
    )  # fmt: skip
    slope, rank = np.zeros_like(poses), pattern.rank
    np.add.at(slope, rank[edges.tail], np.einsum("mij,mj->mi", tail_part, found.error))
    np.add.at(slope, rank[edges.head], np.einsum("mij,mj->mi", head_part, found.error))
    return np.asarray(factors.solve(-slope.ravel())).reshape(-1, 3)[rank]


def _errors(poses: Poses, edges: Edges) -> NDArray[np.float64]:
    a, b = poses[edges.tail], poses[edges.head]
    cos, sin = np.cos(a[:, 2]), np.sin(a[:, 2])
    dx, dy = b[:, 0] - a[:, 0], b[:, 1] - a[:, 1]
    error = np.empty((len(a), 3))
    error[:, 0] = cos * dx + sin * dy - edges.relative[:, 0]
    error[:, 1] = cos * dy - sin * dx - edges.relative[:, 1]
    error[:, 2] = wrap_angle(b[:, 2] - a[:, 2] - edges.relative[:, 2])
    return error


def _jacobians(poses: Poses, edges: Edges) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    a, b = poses[edges.tail], poses[edges.head]
    cos, sin = np.cos(a[:, 2]), np.sin(a[:, 2])
    dx, dy = b[:, 0] - a[:, 0], b[:, 1] - a[:, 1]
    of_tail, of_head = np.zeros((len(a), 3, 3)), np.zeros((len(a), 3, 3))
    of_tail[:, 0, 0], of_tail[:, 0, 1], of_tail[:, 0, 2] = -cos, -sin, cos * dy - sin * dx
    of_tail[:, 1, 0], of_tail[:, 1, 1], of_tail[:, 1, 2] = sin, -cos, -cos * dx - sin * dy
    of_tail[:, 2, 2] = -1.0
    of_head[:, 0, 0], of_head[:, 0, 1] = cos, sin
    of_head[:, 1, 0], of_head[:, 1, 1] = -sin, cos
    of_head[:, 2, 2] = 1.0
    return of_tail, of_head
