# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled search of a tree's nearest node."""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel

__all__ = ["drawn", "nearest"]

_TURN = 2.0 * math.pi


@kernel
def nearest(nodes, count, turning, q):
    """Return the node nearest to `q` and its squared distance, turning joints the short way."""
    best, least = -1, 1e300
    for i in range(count):
        square = 0.0
        for k in range(len(q)):
            way = nodes[i, k] - q[k]
            if turning[k]:
                way = (way + math.pi) % _TURN - math.pi
            square += way * way
        if square < least:
            best, least = i, square
    return best, least


@kernel
def drawn(nodes, count, turning, domains, low, width, chances):
    """Return the first of several draws that lies in the domain of the node nearest to it.

    Args:
        nodes: (m, n).
        count: how many of them there are.
        turning: (n,) joints that turn without end.
        domains: (m,) how far a node grows.
        low: (n,) where draws begin.
        width: (n,) how wide their range is.
        chances: (d, n) 0 to 1; the last row counts wherever it lies.

    Returns:
        the draw, and the node.
    """
    q = np.empty(len(low))
    for row in range(len(chances)):
        for k in range(len(low)):
            q[k] = low[k] + width[k] * chances[row, k]
        node, square = nearest(nodes, count, turning, q)
        if square <= domains[node] * domains[node]:
            break
    return q, node
