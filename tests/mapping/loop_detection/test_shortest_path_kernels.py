"""Shortest ways through the graph of poses, against scipy's."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from gazelle.mapping.loop_detection.shortest_path_kernels import shortest_ways


def test_ways_are_those_of_scipy() -> None:
    rng = np.random.default_rng(5)
    count = 60
    chain = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    far = np.stack([np.arange(0, count - 10, 7), np.arange(10, count, 7)], axis=1)
    tails, heads = np.concatenate([chain, far]).T.astype(np.int64)
    lengths = rng.uniform(0.1, 1.0, len(tails))
    graph = csr_matrix((lengths, (tails, heads)), shape=(count, count))
    expected = dijkstra(graph, directed=False, indices=count - 1)
    np.testing.assert_array_equal(shortest_ways(tails, heads, lengths, count, count - 1), expected)


def test_what_is_not_connected_is_infinitely_far() -> None:
    tails, heads = np.array([0, 2]), np.array([1, 3])
    ways = shortest_ways(tails, heads, np.ones(2), 4, 3)
    assert ways.tolist() == [np.inf, np.inf, 1.0, 0.0]
