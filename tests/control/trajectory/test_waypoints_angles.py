from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.control.angles import shortest_angular_distance
from gazelle.control.trajectory.waypoints import shortest_way, turns_to_nearest, wrap_in_place


def test_ways_equal_those_of_one_joint() -> None:
    rng = np.random.default_rng(1)
    start, end = rng.uniform(-20, 20, (2, 500))
    expected = [shortest_angular_distance(a, b) for a, b in zip(start, end, strict=True)]
    np.testing.assert_allclose(shortest_way(start, end), expected, atol=1e-12)


def test_half_a_turn_is_positive() -> None:
    way = np.array([-math.pi, math.pi, 3 * math.pi])
    wrap_in_place(way, np.array([True, True, True]))
    np.testing.assert_allclose(way, [-math.pi, math.pi, math.pi])


def test_only_angles_are_wrapped() -> None:
    way = np.array([4.0, 4.0])
    wrap_in_place(way, np.array([True, False]))
    np.testing.assert_allclose(way, [4.0 - 2 * math.pi, 4.0])


def test_offsets_are_whole_turns_and_bring_the_goal_near() -> None:
    rng = np.random.default_rng(2)
    start, end = rng.uniform(-20, 20, (2, 500))
    offsets = turns_to_nearest(start, end, np.ones(500, dtype=bool))
    turns = offsets / (2 * math.pi)
    np.testing.assert_allclose(turns, np.round(turns), atol=1e-9)
    assert np.abs(end + offsets - start).max() <= math.pi + 1e-9


@pytest.mark.parametrize(("start", "end"), [(0.0, math.pi), (math.pi, 0.0), (0.0, -math.pi)])
def test_half_a_turn_goes_the_way_it_was_given(start: float, end: float) -> None:
    offset = turns_to_nearest(np.array([start]), np.array([end]), np.array([True]))
    assert offset == pytest.approx(0.0)


def test_joints_that_do_not_wrap_go_all_the_way() -> None:
    assert turns_to_nearest(np.zeros(1), np.array([6.0]), np.array([False])) == 0.0
