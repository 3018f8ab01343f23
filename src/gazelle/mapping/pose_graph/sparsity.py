"""Which blocks of the matrix of a graph of poses are filled, found once for all iterations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import SuperLU, splu

from gazelle.mapping.pose_graph.constraints import Edges

__all__ = ["Pattern", "pattern_of"]

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
