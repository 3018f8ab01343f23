"""RRT with a bias to the goal, and RRT*, which goes on until paths stop getting shorter."""

from __future__ import annotations

import math

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning.problem import Problem, Waypoints
from gazelle.motion.planning.search_tree import Tree

__all__ = ["rrt", "rrt_star"]


def rrt(problem: Problem) -> Waypoints | None:
    """Return a path, None where the time ran out (LaValle, 1998)."""
    tree = Tree(problem.space, [problem.start])
    while not problem.is_over():
        target, is_goal = _target(problem)
        here = tree.nearest(target)
        waypoints, arrived = problem.towards(tree[here], target, problem.range)
        for q in waypoints:
            here = tree.add(q, here)
        if not waypoints:
            continue
        if arrived and is_goal:
            return tree.branch(here)
    return None


def rrt_star(problem: Problem) -> Waypoints | None:
    """Return the shortest path found after `max_iterations` draws or when the time is over.

    Neighbours are the k nearest, k = e (1 + 1/n) log m (Karaman and Frazzoli, 2011).
    """
    growth = _OptimalTree(problem)
    for _ in range(problem.settings.max_iterations):
        if problem.is_over():
            break
        growth.draw()
    while growth.best < 0 and not problem.is_over():
        growth.draw()
    return growth.path()


def _target(problem: Problem) -> tuple[FloatArray, bool]:
    if problem.rng.random() >= problem.settings.goal_bias:
        return problem.sample(), False
    problem.another_goal()
    return problem.goals[problem.rng.integers(len(problem.goals))], True


class _OptimalTree:
    """A tree whose nodes hang where the way to them is shortest."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._tree = Tree(problem.space, [problem.start])
        self._costs = [0.0]
        self._children: list[set[int]] = [set()]
        self._goals: list[int] = []

    @property
    def best(self) -> int:
        """The goal node that is cheapest to reach, -1 before there is one."""
        return min(self._goals, key=lambda index: self._costs[index], default=-1)

    def path(self) -> Waypoints | None:
        return self._tree.branch(self.best) if self._goals else None

    def draw(self) -> None:
        """Add one configuration and hang its neighbours under it where that is shorter."""
        target, is_goal = _target(self._problem)
        tree = self._tree
        nearest = tree.nearest(target)
        waypoints, arrived = self._problem.towards(tree[nearest], target, self._problem.range)
        if not waypoints or (self._problem.project is None and self._is_known(waypoints[-1])):
            return
        for place, q in enumerate(waypoints):
            neighbours = self._neighbours(q)
            # A chain along constraints hangs together; only its last node chooses its parent.
            ends = place == len(waypoints) - 1
            parent = self._cheapest(q, neighbours, nearest) if ends else nearest
            nearest = self._add(q, parent)
        self._rewire(nearest, neighbours)
        if is_goal and arrived:
            self._goals.append(nearest)

    def _is_known(self, q: FloatArray) -> bool:
        return bool(self._tree.squared_distances(q).min() < 1e-18)

    def _neighbours(self, q: FloatArray) -> list[int]:
        distances = self._tree.squared_distances(q)
        n = self._problem.space.size
        count = math.ceil(math.e * (1.0 + 1.0 / n) * math.log(len(distances) + 1))
        if count < len(distances):
            return [int(i) for i in np.argpartition(distances, count)[:count]]
        return list(range(len(distances)))

    def _cheapest(self, q: FloatArray, neighbours: list[int], nearest: int) -> int:
        tree, problem = self._tree, self._problem
        cost = {i: self._costs[i] + problem.space.distance(tree[i], q) for i in neighbours}
        limit = self._costs[nearest] + problem.space.distance(tree[nearest], q)
        for index in sorted(cost, key=lambda i: cost[i]):
            if cost[index] >= limit:
                break
            if self._is_straight(tree[index], q):
                return index
        return nearest

    def _rewire(self, node: int, neighbours: list[int]) -> None:
        tree, space = self._tree, self._problem.space
        for index in neighbours:
            cost = self._costs[node] + space.distance(tree[node], tree[index])
            if cost >= self._costs[index] - 1e-9 or not self._is_straight(tree[node], tree[index]):
                continue
            self._children[tree.parents[index]].discard(index)
            tree.parents[index] = node
            self._children[node].add(index)
            self._lower_costs(index, self._costs[index] - cost)

    def _lower_costs(self, index: int, gain: float) -> None:
        waiting = [index]
        while waiting:
            node = waiting.pop()
            self._costs[node] -= gain
            waiting.extend(self._children[node])

    def _is_straight(self, start: FloatArray, end: FloatArray) -> bool:
        """Return whether the numbers of both lead straight from one to the other."""
        problem = self._problem
        way = problem.space.between(start, end)
        same_turn = bool(np.allclose(start + way, end, atol=1e-9))
        return same_turn and problem.validity.motion_is_valid(start, end, problem.step)

    def _add(self, q: FloatArray, parent: int) -> int:
        index = self._tree.add(q, parent)
        distance = self._problem.space.distance(self._tree[parent], q)
        self._costs.append(self._costs[parent] + distance)
        self._children.append(set())
        self._children[parent].add(index)
        return index
