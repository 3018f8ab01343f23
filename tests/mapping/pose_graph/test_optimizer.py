"""Least squares over poses."""

from __future__ import annotations

import numpy as np

from gazelle.mapping.pose_graph.constraints import Edges
from gazelle.mapping.pose_graph.optimizer import optimise, residuals
from gazelle.mapping.relative_pose_error import absolute_error_m
from gazelle.mapping.se2 import between, compose

INFORMATION = np.diag([400.0, 400.0, 2500.0])


def _circle(count: int) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.stack([10 * np.sin(angle), 10 * (1 - np.cos(angle)), angle], axis=-1)


def _edges(truth: np.ndarray, pairs: list[tuple[int, int]], noise: float, loops: int) -> Edges:
    rng = np.random.default_rng(3)
    tail, head = (np.array(column) for column in zip(*pairs, strict=True))
    relative = between(truth[tail], truth[head]) + rng.normal(0, noise, (len(pairs), 3))
    is_loop = np.arange(len(pairs)) >= len(pairs) - loops
    return Edges(tail, head, relative, np.repeat(INFORMATION[None], len(pairs), axis=0), is_loop)


def _chained(edges: Edges, count: int) -> np.ndarray:
    poses = [np.zeros(3)]
    for relative in edges.relative[: count - 1]:
        poses.append(compose(poses[-1], relative))
    return np.array(poses)


def test_exact_relations_are_fulfilled_exactly() -> None:
    truth = _circle(40)
    edges = _edges(truth, [(i, (i + 1) % 40) for i in range(40)], 0.0, 1)
    disturbed = truth + np.random.default_rng(0).normal(0, 0.05, truth.shape)
    disturbed[0] = truth[0]
    found = optimise(disturbed, edges, iterations=20)
    assert residuals(found, edges).squared.max() < 1e-9


def test_a_loop_closure_shares_the_error_among_the_way() -> None:
    truth = _circle(60)
    edges = _edges(truth, [(i, (i + 1) % 60) for i in range(60)], 0.01, 1)
    start = _chained(edges, 60)
    found = optimise(start, edges)
    assert absolute_error_m(found, truth) < 0.5 * absolute_error_m(start, truth)


def test_one_false_loop_closure_does_not_tear_the_map() -> None:
    truth = _circle(60)
    pairs = [(i, i + 1) for i in range(59)] + [(0, 59), (1, 58), (2, 57), (5, 35)]
    edges = _edges(truth, pairs, 0.001, 4)
    edges.relative[-1] += (4.0, -3.0, 1.0)
    found = optimise(truth, edges, iterations=20)
    assert absolute_error_m(found, truth) < 0.1


def test_no_edges_leave_poses_alone() -> None:
    from gazelle.mapping.pose_graph.constraints import no_edges

    np.testing.assert_array_equal(optimise(_circle(5), no_edges()), _circle(5))
