# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled loop of RRT-Connect, for robots whose motions a kernel can check."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gazelle.kernels import kernel
from gazelle.motion.collision.sweep_kernels import COLLIDES, FREE, sweep
from gazelle.motion.joint_space import BoolArray, FloatArray
from gazelle.motion.planning.search_tree import TreeArrays
from gazelle.motion.planning.search_tree_kernels import drawn, nearest

__all__ = ["ARRIVED", "BLOCKED", "DOUBTFUL", "Draws", "connect_trees"]

BLOCKED, ARRIVED, DOUBTFUL = 0, 1, 2

_TURN = 2.0 * math.pi


class Draws(NamedTuple):
    """What is drawn of a space.

    Attributes:
        turning: (n,) joints that turn without end.
        low: (n,) where draws begin.
        width: (n,) how wide their range is.
        chances: (draws, d, n), see `tree_kernels.drawn`.
    """

    turning: BoolArray
    low: FloatArray
    width: FloatArray
    chances: FloatArray


@kernel
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


@kernel
def _verdict(q, end, motions, step):
    """Return what is known of the motion between two configurations."""
    way = np.empty(len(q))
    for k in range(len(q)):
        if not motions.lower[k] <= end[k] <= motions.upper[k]:
            return COLLIDES
        way[k] = end[k] - q[k]
    return sweep(q, way, step, motions.surroundings)[0]


@kernel
def _twice(nodes, parents, domains):
    """Return arrays of a tree with room for twice as many nodes."""
    count = len(nodes)
    more, above = np.empty((2 * count, nodes.shape[1])), np.empty(2 * count, np.int64)
    reaches = np.empty(2 * count)
    for i in range(count):
        for k in range(nodes.shape[1]):
            more[i, k] = nodes[i, k]
        above[i], reaches[i], reaches[count + i] = parents[i], domains[i], np.inf
    return more, above, reaches


@kernel
def _grow(tree, here, target, most, turning, reach, motions, step):
    """Grow a tree from a node towards a target, in motions of the planner's range.

    Returns:
        the tree; the last node added, -1 where none was; and how it ended.
    """
    nodes, parents, domains, count = tree.nodes, tree.parents, tree.domains, tree.size
    last, gone, end, state = -1, 0.0, np.empty(len(target)), BLOCKED
    while gone < most:
        distance = _step_to(nodes[here], target, turning, reach, end)
        if distance > 0.0:
            found = _verdict(nodes[here], end, motions, step)
            if found != FREE:
                state = BLOCKED if found == COLLIDES else DOUBTFUL
                break
        if count == len(nodes):
            nodes, parents, domains = _twice(nodes, parents, domains)
        for k in range(len(end)):
            nodes[count, k] = end[k]
        parents[count] = here
        here = last = count
        count += 1
        if distance <= reach:
            state = ARRIVED
            break
        gone += reach
    return TreeArrays(nodes, parents, domains, count), last, state


@kernel
def connect_trees(near, far, draws, reach, domain, motions, step):
    """Let two trees grow towards each other until they meet or the draws are used up.

    Args:
        near: the first tree, `TreeArrays`.
        far: the second one.
        draws: a `Draws`.
        reach: longest motion added at once.
        domain: how far a node grows that an obstacle was next to.
        motions: what is needed to check them, a `SweptMotions`.
        step: see `sweep_kernels.sweep`.

    Returns:
        how it ended, `BLOCKED` where the draws are used up; the number of the last draw, which is
        to be done by other means where it was `DOUBTFUL`; the nodes of both trees that met; and
        both trees.
    """
    turning, low, width = draws.turning, draws.low, draws.width
    state, draw, node, meeting, is_swapped = BLOCKED, 0, -1, -1, False
    grown, other = near, far
    for draw in range(len(draws.chances)):
        # The smaller tree grows, so that a tree in a narrow place is not left behind.
        if grown.size > other.size or (grown.size == other.size and is_swapped):
            grown, other = other, grown
            is_swapped = not is_swapped
        target, here = drawn(
            grown.nodes, grown.size, turning, grown.domains, low, width, draws.chances[draw]
        )
        grown, node, state = _grow(grown, here, target, reach, turning, reach, motions, step)
        if state == DOUBTFUL:
            break
        if node < 0:
            grown.domains[here] = domain
            continue
        target = grown.nodes[node].copy()
        here = nearest(other.nodes, other.size, turning, target)[0]
        other, meeting, state = _grow(other, here, target, np.inf, turning, reach, motions, step)
        if state != BLOCKED:
            break
    if is_swapped:
        grown, other = other, grown
        node, meeting = meeting, node
    return state, draw, node, meeting, grown, other
