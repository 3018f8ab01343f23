"""PRM and PRM*: a road map of the free space, searched for the shortest way."""

from __future__ import annotations

import heapq
import itertools
import math

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning.problem import Problem, Waypoints
from gazelle.motion.planning.search_tree import Tree

__all__ = ["prm", "prm_star"]

_DRAWS_PER_LOOK = 20


def prm(problem: Problem) -> Waypoints | None:
    """Return a path over a road map that grows until it holds one (Kavraki et al., 1996)."""
    roads = _RoadMap(problem)
    while not problem.is_over():
        for _ in range(_DRAWS_PER_LOOK):
            roads.draw(problem.settings.max_nearest_neighbors)
        if roads.is_connected():
            return roads.shortest()
    return None


def prm_star(problem: Problem) -> Waypoints | None:
    """Return the shortest path after `max_iterations` draws or when the time is over.

    Every configuration is connected with its k nearest, k = e (1 + 1/n) log m.
    """
    roads = _RoadMap(problem)
    factor = math.e * (1.0 + 1.0 / problem.space.size)
    draws = 0
    while not problem.is_over():
        roads.draw(math.ceil(factor * math.log(len(roads) + 1)))
        draws += 1
        if draws >= problem.settings.max_iterations and roads.is_connected():
            break
    return roads.shortest() if roads.is_connected() else None


class _RoadMap:
    """Nodes, roads with the waypoints along them, and which parts hang together."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._nodes = Tree(problem.space, [])
        self._roads: list[dict[int, Waypoints]] = []
        self._parts: list[int] = []
        self._goals: list[int] = []
        self._add(problem.start, problem.settings.max_nearest_neighbors)
        for goal in problem.goals:
            self._goals.append(self._add(goal, problem.settings.max_nearest_neighbors))

    def __len__(self) -> int:
        return len(self._nodes)

    def draw(self, count: int) -> None:
        """Add one configuration, connected with its `count` nearest; now and then a goal."""
        if len(self) % _DRAWS_PER_LOOK == 0:
            goal = self._problem.another_goal()
            if goal is not None:
                self._goals.append(self._add(goal, count))
        q = self._problem.sample()
        if self._problem.validity.is_valid(q):
            self._add(q, count)

    def is_connected(self) -> bool:
        """Return whether roads lead from the start to a goal."""
        return any(self._part(goal) == self._part(0) for goal in self._goals)

    def shortest(self) -> Waypoints:
        """Return the shortest way from the start to a goal (Dijkstra)."""
        costs, before = {0: 0.0}, {0: -1}
        queue = [(0.0, 0)]
        while queue:
            cost, node = heapq.heappop(queue)
            if node in self._goals:
                return self._way(node, before)
            if cost > costs[node]:
                continue
            for other in self._roads[node]:
                reached = cost + self._problem.space.distance(self._nodes[node], self._nodes[other])
                if reached < costs.get(other, math.inf):
                    costs[other], before[other] = reached, node
                    heapq.heappush(queue, (reached, other))
        raise AssertionError("the road map is not connected")

    def _add(self, q: FloatArray, count: int) -> int:
        index = self._nodes.add(q, -1)
        self._roads.append({})
        self._parts.append(index)
        distances = self._nodes.squared_distances(q)
        for other in (int(i) for i in np.argsort(distances)[: count + 1]):
            if other == index:
                continue
            waypoints = self._problem.connect(self._nodes[other], q)
            if waypoints is None:
                continue
            back = [self._nodes[other], *waypoints[:-1]][::-1]
            self._roads[other][index] = waypoints
            self._roads[index][other] = back
            self._parts[self._part(index)] = self._part(other)
        return index

    def _part(self, node: int) -> int:
        while self._parts[node] != node:
            self._parts[node] = self._parts[self._parts[node]]
            node = self._parts[node]
        return node

    def _way(self, goal: int, before: dict[int, int]) -> Waypoints:
        nodes = [goal]
        while before[nodes[-1]] >= 0:
            nodes.append(before[nodes[-1]])
        nodes.reverse()
        way = [self._nodes[0].copy()]
        for node, following in itertools.pairwise(nodes):
            here = way[-1]
            for q in self._roads[node][following]:
                here = here + self._problem.space.between(here, q)
                way.append(here)
        return way
