# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled inner loop of finding shortest ways through the graph of poses."""

from __future__ import annotations

import heapq

import numpy as np
from numba import njit

__all__ = ["shortest_ways"]


@njit(cache=True, nogil=True)
def shortest_ways(tails, heads, lengths, count, source):
    """Return the lengths of the shortest ways from one node to all, infinite where there is none.

    Dijkstra (1959); edges lead both ways.

    Args:
        tails: int64 (m,).
        heads: the same.
        lengths: (m,), not negative.
        count: of nodes.
        source: the node.
    """
    starts = np.zeros(count + 1, np.int64)
    for e in range(tails.shape[0]):
        starts[tails[e] + 1] += 1
        starts[heads[e] + 1] += 1
    starts = np.cumsum(starts)
    fill = starts[:-1].copy()
    edges = np.empty(2 * tails.shape[0], np.int64)
    for e in range(tails.shape[0]):
        edges[fill[tails[e]]] = e
        fill[tails[e]] += 1
        edges[fill[heads[e]]] = e
        fill[heads[e]] += 1
    ways = np.full(count, np.inf)
    ways[source] = 0.0
    heap = [(0.0, source)]
    while heap:
        way, node = heapq.heappop(heap)
        if way > ways[node]:
            continue
        for k in range(starts[node], starts[node + 1]):
            e = edges[k]
            other = heads[e] if tails[e] == node else tails[e]
            if way + lengths[e] < ways[other]:
                ways[other] = way + lengths[e]
                heapq.heappush(heap, (ways[other], other))
    return ways
