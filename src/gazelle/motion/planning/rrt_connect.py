"""RRT-Connect: two trees that grow towards each other (Kuffner and LaValle, 2000)."""

from __future__ import annotations

import numpy as np

from gazelle.motion.planning.problem import Problem, Waypoints
from gazelle.motion.planning.tree import Tree
from gazelle.motion.space import FloatArray

__all__ = ["rrt_connect"]

_DRAWS_PER_GOAL = 20
_DOMAIN = 3.0
_DRAWS = 20


def rrt_connect(problem: Problem) -> Waypoints | None:
    """Return a path, None where the time ran out.

    A node that an obstacle was next to draws from its surroundings only, as in the dynamic domain
    of A. Yershova, L. Jaillet, T. Siméon and S. LaValle, "Dynamic-domain RRTs: efficient
    exploration by controlling the sampling domain" (ICRA 2005). Where nearly all draws are too far
    for that, as with very many joints, every twentieth one counts all the same.
    """
    direct = _straight(problem)
    if direct is not None:
        return direct
    near, far = Tree(problem.space, [problem.start]), Tree(problem.space, problem.goals)
    draws = 0
    while not problem.is_over():
        draws += 1
        if draws % _DRAWS_PER_GOAL == 0 and (goal := problem.another_goal()) is not None:
            far.add(goal, -1)
        # The smaller tree grows, so that a tree in a narrow place is not left behind.
        grown, other = (near, far) if len(near) <= len(far) else (far, near)
        target, here = _drawn(problem, grown)
        node, arrived = _grow(problem, grown, here, target, problem.range)
        if node < 0:
            grown.confine(here, _DOMAIN * problem.range)
            continue
        meeting, arrived = _grow(problem, other, other.nearest(grown[node]), grown[node], np.inf)
        if arrived:
            ends = (node, meeting) if grown is near else (meeting, node)
            return _joined(near.branch(ends[0]), far.branch(ends[1]))
    return None


def _straight(problem: Problem) -> Waypoints | None:
    """Return the way to the first goal that nothing bars."""
    for goal in sorted(problem.goals, key=lambda q: problem.space.distance(problem.start, q)):
        waypoints = problem.connect(problem.start, goal)
        if waypoints is not None:
            return [problem.start, *waypoints]
    return None


def _drawn(problem: Problem, tree: Tree) -> tuple[FloatArray, int]:
    """Return a configuration to grow towards, and the node to grow."""
    if problem.project is not None:
        q = problem.sample()
        return q, tree.nearest(q)
    return tree.drawn(problem.rng.random((_DRAWS, problem.space.size)))


def _grow(
    problem: Problem, tree: Tree, here: int, target: FloatArray, most: float
) -> tuple[int, bool]:
    """Grow from a node towards a target, in motions of the planner's range.

    Returns:
        the last node added or stood on, -1 where none was; whether it is the target.
    """
    last, gone = -1, 0.0
    while gone < most:
        waypoints, arrived = problem.towards(tree[here], target, problem.range)
        for q in waypoints:
            here = last = tree.add(q, here)
        if arrived or not waypoints:
            return last, arrived
        gone += problem.range
    return last, False


def _joined(near: Waypoints, far: Waypoints) -> Waypoints:
    """Put two branches together that end in one configuration, up to full turns."""
    turns: FloatArray = near[-1] - far[-1]
    return near + [q + turns for q in far[-2::-1]]
