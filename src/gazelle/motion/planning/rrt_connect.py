"""RRT-Connect: two trees that grow towards each other (Kuffner and LaValle, 2000)."""

from __future__ import annotations

import numpy as np

from gazelle.motion.collision.sweep_kernels import MAX_STEPS
from gazelle.motion.joint_space import FloatArray, JointSpace, SweptMotions, SweptValidity, Validity
from gazelle.motion.planning.problem import Problem, Waypoints
from gazelle.motion.planning.rrt_connect_kernels import ARRIVED, DOUBTFUL, Draws, connect_trees
from gazelle.motion.planning.search_tree import Tree, warm_up_trees

__all__ = ["rrt_connect", "warm_up"]

_DRAWS_PER_GOAL = 20
_DOMAIN = 3.0
_DRAWS = 20

_Ends = tuple[int, int]


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
    motions = _swept_motions(problem)
    while not problem.is_over():
        if motions is None:
            ends = _draw_all(problem, near, far)
        else:
            ends = _draw_swept(problem, near, far, motions)
        if ends is not None:
            return _joined(near.branch(ends[0]), far.branch(ends[1]))
        if (goal := problem.another_goal()) is not None:
            far.add(goal, -1)
    return None


def warm_up(space: JointSpace, validity: Validity) -> None:
    """Compile or load the kernels, before the time that somebody has for planning."""
    warm_up_trees()
    motions = validity.swept_motions() if isinstance(validity, SweptValidity) else None
    if motions is not None:
        tree = Tree(space, [])
        no_draws = np.empty((0, _DRAWS, space.size))
        _connect(space, tree, tree, no_draws, 1.0, 1.0, motions)


def _straight(problem: Problem) -> Waypoints | None:
    """Return the way to the first goal that nothing bars."""
    for goal in sorted(problem.goals, key=lambda q: problem.space.distance(problem.start, q)):
        waypoints = problem.connect(problem.start, goal)
        if waypoints is not None:
            return [problem.start, *waypoints]
    return None


def _swept_motions(problem: Problem) -> SweptMotions | None:
    """Return what a kernel needs to check the motions of a problem, None where it cannot."""
    is_long = problem.range > MAX_STEPS * problem.step
    return None if is_long else problem.swept_motions


def _draw_swept(problem: Problem, near: Tree, far: Tree, motions: SweptMotions) -> _Ends | None:
    """Draw some times in a kernel; the nodes that met, None where none did."""
    left = problem.rng.random((_DRAWS_PER_GOAL, _DRAWS, problem.space.size))
    while len(left):
        state, draw, node, meeting = _connect(
            problem.space, near, far, left, problem.range, problem.step, motions
        )
        if state == ARRIVED:
            return node, meeting
        if state == DOUBTFUL and (ends := _draw(problem, near, far, left[draw])) is not None:
            return ends
        left = left[draw + 1 :]
    return None


def _connect(
    space: JointSpace,
    near: Tree,
    far: Tree,
    chances: FloatArray,
    reach: float,
    step: float,
    motions: SweptMotions,
) -> tuple[int, int, int, int]:
    draws = Draws(space.continuous, space.low, space.width, chances)
    state, draw, node, meeting, near.arrays, far.arrays = connect_trees(
        near.arrays, far.arrays, draws, float(reach), float(_DOMAIN * reach), motions, float(step)
    )
    return state, draw, node, meeting


def _draw_all(problem: Problem, near: Tree, far: Tree) -> _Ends | None:
    """Draw some times; the nodes that met, None where none did."""
    for _ in range(_DRAWS_PER_GOAL):
        chances = None
        if problem.project is None:
            chances = problem.rng.random((_DRAWS, problem.space.size))
        ends = _draw(problem, near, far, chances)
        if ends is not None or problem.is_over():
            return ends
    return None


def _draw(problem: Problem, near: Tree, far: Tree, chances: FloatArray | None) -> _Ends | None:
    """Draw once, by these chances or near the path constraints; the nodes that met, if they did."""
    # The smaller tree grows, so that a tree in a narrow place is not left behind.
    grown, other = (near, far) if len(near) <= len(far) else (far, near)
    if chances is None:
        target = problem.sample()
        here = grown.nearest(target)
    else:
        target, here = grown.drawn(chances)
    node, arrived = _grow(problem, grown, here, target, problem.range)
    if node < 0:
        grown.confine(here, _DOMAIN * problem.range)
        return None
    meeting, arrived = _grow(problem, other, other.nearest(grown[node]), grown[node], np.inf)
    if not arrived:
        return None
    return (node, meeting) if grown is near else (meeting, node)


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
