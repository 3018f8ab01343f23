# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202, PLR0917
"""The compiled loop of RRT-Connect, for robots whose motions a kernel can check."""

from __future__ import annotations

import math

import numpy as np

from gazelle.compiling import njit
from gazelle.motion.collision.sweep_kernels import COLLIDES, FREE, sweep
from gazelle.motion.planning.tree_kernels import drawn, nearest

__all__ = ["ARRIVED", "BLOCKED", "DOUBTFUL", "connect_trees"]

BLOCKED, ARRIVED, DOUBTFUL = 0, 1, 2

_TURN = 2.0 * math.pi


@njit(cache=True, nogil=True)
def _step_to(q, target, turning, reach, end):
    """Write where a motion towards a target ends, `reach` far at most; return its distance."""
    square = 0.0
    for k in range(len(q)):
        end[k] = target[k] - q[k]
        if turning[k]:
            end[k] = (end[k] + math.pi) % _TURN - math.pi
        square += end[k] * end[k]
    distance = math.sqrt(square)
    part = 1.0 if distance <= reach else reach / distance
    for k in range(len(q)):
        end[k] = q[k] + end[k] * part
    return distance


@njit(cache=True, nogil=True)
def _verdict(q, end, lower, upper, step, bounds):
    """Return what is known of the motion between two configurations."""
    for k in range(len(q)):
        if not lower[k] <= end[k] <= upper[k]:
            return COLLIDES
    return sweep(q, end - q, step, *bounds)[0]


@njit(cache=True, nogil=True)
def _twice(nodes, parents, domains):
    """Return arrays of a tree with room for twice as many nodes."""
    count = len(nodes)
    more, above = np.empty((2 * count, nodes.shape[1])), np.empty(2 * count, np.int64)
    reaches = np.full(2 * count, np.inf)
    more[:count], above[:count], reaches[:count] = nodes, parents, domains
    return more, above, reaches


@njit(cache=True, nogil=True)
def _grow(
    nodes, parents, domains, count, here, target, most, turning, reach, lower, upper, step, bounds
):
    """Grow a tree from a node towards a target, in motions of the planner's range.

    Returns:
        the tree; the last node added, -1 where none was; and how it ended.
    """
    last, gone, end = -1, 0.0, np.empty(len(target))
    while gone < most:
        distance = _step_to(nodes[here], target, turning, reach, end)
        if distance > 0.0:
            found = _verdict(nodes[here], end, lower, upper, step, bounds)
            if found != FREE:
                state = BLOCKED if found == COLLIDES else DOUBTFUL
                return nodes, parents, domains, count, last, state
        if count == len(nodes):
            nodes, parents, domains = _twice(nodes, parents, domains)
        nodes[count], parents[count] = end, here
        here = last = count
        count += 1
        if distance <= reach:
            return nodes, parents, domains, count, last, ARRIVED
        gone += reach
    return nodes, parents, domains, count, last, BLOCKED


@njit(cache=True, nogil=True)
def connect_trees(
    nodes, parents, domains, count, nodes_b, parents_b, domains_b, count_b,
    turning, low, width, chances, reach, domain, lower, upper, step, bounds,
):  # fmt: skip
    """Let two trees grow towards each other until they meet or the draws are used up.

    Args:
        nodes: (m, n), of the first tree.
        parents: (m,) likewise.
        domains: (m,) likewise, how far a node grows.
        count: how many nodes it has.
        nodes_b: this and what follows up to `count_b` are the second tree.
        parents_b: see there.
        domains_b: see there.
        count_b: see there.
        turning: (n,) joints that turn without end.
        low: (n,) where draws begin.
        width: (n,) how wide their range is.
        chances: (draws, d, n), see `tree_kernels.drawn`.
        reach: longest motion added at once.
        domain: how far a node grows that an obstacle was next to.
        lower: (n,) least allowed.
        upper: (n,) most allowed.
        step: see `sweep_kernels.sweep`.
        bounds: its arguments from the fourth on.

    Returns:
        how it ended, `BLOCKED` where the draws are used up; the number of the last draw, which is
        to be done by other means where it was `DOUBTFUL`; the nodes of both trees that met; and
        both trees.
    """
    state, draw, node, meeting, is_swapped = BLOCKED, 0, -1, -1, False
    for draw in range(len(chances)):
        # The smaller tree grows, so that a tree in a narrow place is not left behind.
        if count > count_b or (count == count_b and is_swapped):
            nodes, nodes_b, parents, parents_b = nodes_b, nodes, parents_b, parents
            domains, domains_b, count, count_b = domains_b, domains, count_b, count
            is_swapped = not is_swapped
        target, here = drawn(nodes, count, turning, domains, low, width, chances[draw])
        nodes, parents, domains, count, node, state = _grow(
            nodes, parents, domains, count, here, target, reach,
            turning, reach, lower, upper, step, bounds,
        )  # fmt: skip
        if state == DOUBTFUL:
            break
        if node < 0:
            domains[here] = domain
            continue
        target = nodes[node].copy()
        here = nearest(nodes_b, count_b, turning, target)[0]
        nodes_b, parents_b, domains_b, count_b, meeting, state = _grow(
            nodes_b, parents_b, domains_b, count_b, here, target, np.inf,
            turning, reach, lower, upper, step, bounds,
        )  # fmt: skip
        if state != BLOCKED:
            break
    if is_swapped:
        nodes, nodes_b, parents, parents_b = nodes_b, nodes, parents_b, parents
        domains, domains_b, count, count_b = domains_b, domains, count_b, count
        node, meeting = meeting, node
    return (
        state, draw, node, meeting,
        (nodes, parents, domains, count), (nodes_b, parents_b, domains_b, count_b),
    )  # fmt: skip
