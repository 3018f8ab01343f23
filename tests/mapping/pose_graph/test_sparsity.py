"""Sparse matrices of pose graphs, against the same ones written out."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.mapping.pose_graph.constraints import Edges, no_edges
from gazelle.mapping.pose_graph.optimizer import pattern_of

COUNT = 12
LOOPS = [(0, 6), (2, 9), (2, 9), (1, 11)]


@pytest.fixture
def edges() -> Edges:
    """A chain with loops, one of them twice."""
    found = no_edges()
    for tail, head in [(k, k + 1) for k in range(COUNT - 1)] + LOOPS:
        found = found.with_edge(tail, head, np.zeros(3), np.eye(3), is_loop=head > tail + 1)
    return found


def test_solution_is_that_of_the_dense_matrix(edges: Edges) -> None:
    rng = np.random.default_rng(2)
    count = len(edges.tail)
    of_tail, of_head = rng.normal(size=(2, count, 3, 3))
    dense = np.zeros((COUNT, 3, COUNT, 3))
    for k, (i, j) in enumerate(zip(edges.tail, edges.head, strict=True)):
        for a, left in ((i, of_tail[k]), (j, of_head[k])):
            for b, right in ((i, of_tail[k]), (j, of_head[k])):
                dense[a, :, b] += left.T @ right
    for k in range(COUNT):
        dense[k, :, k] += np.eye(3)
    blocks = np.concatenate(
        [np.swapaxes(a, 1, 2) @ b for a in (of_tail, of_head) for b in (of_tail, of_head)]
        + [np.tile(np.eye(3), (COUNT, 1, 1))]
    )
    right_side = rng.normal(size=(COUNT, 3))
    pattern = pattern_of(edges, COUNT)
    moved = np.empty_like(right_side)
    moved[pattern.rank] = right_side
    found = pattern.factorised(blocks).solve(moved.ravel()).reshape(-1, 3)[pattern.rank]
    size = 3 * COUNT
    expected = np.linalg.solve(dense.reshape(size, size), right_side.ravel()).reshape(-1, 3)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def test_every_pose_has_a_place_of_its_own(edges: Edges) -> None:
    assert sorted(pattern_of(edges, COUNT).rank.tolist()) == list(range(COUNT))
