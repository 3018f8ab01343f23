from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.trajectory_messages import goal, trajectory

from gazelle.control.trajectory.tolerances import (
    ToleranceError,
    Tolerances,
    goal_tolerances,
    violated,
)

JOINTS = ("a", "b")
DEFAULTS = Tolerances.of([0.1, 0.0], [0.2, 0.3], 0.01, 2.0)
EMPTY = trajectory(JOINTS)


def test_zero_and_negative_constraints_enforce_nothing() -> None:
    made = Tolerances.of([0.0, -1.0], [0.0, 0.0], 0.0, 0.0)
    assert not made.has_path
    assert not violated(np.full((3, 2), 1e9), made.path).any()
    assert not violated(np.full((3, 2), 1e9), made.goal).any()


def test_signs_of_errors_do_not_matter_and_the_limit_itself_is_fine() -> None:
    error = np.zeros((3, 2))
    for value, expected in ((0.1, False), (-0.1, False), (0.1001, True), (-0.1001, True)):
        error[0, 0] = value
        assert violated(error, DEFAULTS.path).tolist() == [expected, False]


def test_velocity_counts_at_the_goal() -> None:
    error = np.zeros((3, 2))
    error[1, 1] = 0.02
    assert violated(error, DEFAULTS.goal).tolist() == [False, True]


def test_what_is_not_a_number_violates_nothing() -> None:
    assert not violated(np.full((3, 2), math.nan), DEFAULTS.goal).any()


@pytest.mark.parametrize("strict", [False, True])
def test_a_goals_tolerances_go_over_the_defaults(strict: bool) -> None:
    request = goal(EMPTY, path={"a": (-1.0, 0.5)}, end={"b": (0.0, -1.0, 3.0)}, goal_time_s=4.0)
    made = goal_tolerances(DEFAULTS, request, JOINTS, strict=strict)
    assert made.path[:, 0].tolist() == [math.inf, 0.5, math.inf]
    assert made.goal[:, 1].tolist() == [0.3, math.inf, 3.0]
    assert made.goal[:, 0].tolist() == [0.2, 0.01, math.inf]
    assert made.goal_time_s == 4.0


@pytest.mark.parametrize(("seconds", "expected"), [(0.0, 2.0), (-1.0, 0.0), (0.5, 0.5)])
def test_goal_time_zero_is_the_default_and_minus_one_none(seconds: float, expected: float) -> None:
    request = goal(EMPTY, goal_time_s=seconds)
    for strict in (False, True):
        assert goal_tolerances(DEFAULTS, request, JOINTS, strict=strict).goal_time_s == expected


def test_ros1_takes_any_negative_value_and_skips_unknown_joints() -> None:
    request = goal(EMPTY, path={"a": (-0.5,), "c": (1.0,)})
    assert math.isinf(goal_tolerances(DEFAULTS, request, JOINTS, strict=False).path[0, 0])


@pytest.mark.parametrize(
    ("request_", "text"),
    [
        (goal(EMPTY, path={"a": (-0.5,)}), "illegal value -0.5 in goal.path_tolerance (position"),
        (goal(EMPTY, end={"a": (0.0, -3.0)}), "goal.goal_tolerance (velocity of joint 'a')"),
        (goal(EMPTY, path={"c": (1.0,)}), "'c' specified in goal.path_tolerance does not exist"),
        (goal(EMPTY, goal_time_s=-2.0), "goal_time_tolerance. Using default tolerances"),
    ],
)
def test_ros2_refuses_illegal_tolerances(request_: object, text: str) -> None:
    with pytest.raises(ToleranceError) as caught:
        goal_tolerances(DEFAULTS, request_, JOINTS, strict=True)
    assert text in str(caught.value)


def test_tolerances_of_some_joints() -> None:
    some = DEFAULTS.of_joints(np.array([1]))
    assert (some.path.shape, some.goal[0, 0], some.has_path) == ((3, 1), 0.3, False)
