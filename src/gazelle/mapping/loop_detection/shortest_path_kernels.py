# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled inner loop of finding shortest ways through the graph of poses."""

from __future__ import annotations

import numpy as np

from gazelle.kernels import kernel
from gazelle.priority_queue_kernels import sift_down, sift_up

__all__ = ["shortest_ways"]


@kernel
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
    many = tails.shape[0]
    starts = np.zeros(count + 1, np.int64)
    for e in range(many):
        starts[tails[e] + 1] += 1
        starts[heads[e] + 1] += 1
    fill = np.empty(count, np.int64)
    for k in range(count):
        fill[k] = starts[k]
        starts[k + 1] += starts[k]
    edges = np.empty(2 * many, np.int64)
    for e in range(many):
        edges[fill[tails[e]]] = e
        fill[tails[e]] += 1
        edges[fill[heads[e]]] = e
        fill[heads[e]] += 1
    ways = np.empty(count)
    for k in range(count):
        ways[k] = np.inf
    # A heap of lengths and the nodes they lead to; each edge puts one there in each direction.
    keys, nodes = np.empty(2 * many + 1), np.empty(2 * many + 1, np.int64)
    keys[0], nodes[0], waiting = 0.0, source, 1
    ways[source] = 0.0
    while waiting > 0:
        way, node = keys[0], nodes[0]
        waiting -= 1
        sift_down(keys, nodes, waiting)
        if way > ways[node]:
            continue
        for k in range(starts[node], starts[node + 1]):
            e = edges[k]
            other = heads[e] if tails[e] == node else tails[e]
            longer = way + lengths[e]
            if longer < ways[other]:
                ways[other] = longer
                keys[waiting], nodes[waiting] = longer, other
                sift_up(keys, nodes, waiting)
                waiting += 1
    return ways
