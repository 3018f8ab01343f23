from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.control.trajectory_messages import point, trajectory

from gazelle.control.trajectory.waypoints import (
    ErrorCode,
    TrajectoryError,
    check_joints,
    read_waypoints,
)

JOINTS = ("a", "b", "c")


def test_columns_come_in_the_controllers_order() -> None:
    message = trajectory(["c", "a"], point(1.0, [3, 1], [30, 10], [300, 100], [3000, 1000]))
    places = check_joints(message.joint_names, JOINTS, allow_partial=True)
    read = read_waypoints(message, places)
    assert read.indices.tolist() == [0, 2]
    assert read.times_ns == (1_000_000_000,)
    state = read.states[0]
    for values, expected in zip(
        (state.position, state.velocity, state.acceleration, state.effort),
        ([1, 3], [10, 30], [100, 300], [1000, 3000]),
        strict=True,
    ):
        assert values is not None
        assert values.tolist() == expected


def test_empty_fields_are_none() -> None:
    state = read_waypoints(trajectory(["a"], point(1.0, [1])), np.array([0])).states[0]
    assert (state.velocity, state.acceleration, state.effort) == (None, None, None)


def test_the_stamp_is_kept() -> None:
    read = read_waypoints(trajectory(["a"], point(1.0, [1]), stamp_s=12.5), np.array([0]))
    assert read.stamp_ns == 12_500_000_000


@pytest.mark.parametrize(
    ("names", "partial", "text"),
    [
        (["a", "b", "d"], False, "'d' is none of a, b, c"),
        (["a", "b"], False, "'c' is missing (allow_partial_joints_goal is false)"),
        ([], True, "there are no joint names"),
        (["a", "a", "b"], True, "a joint is there twice"),
    ],
)
def test_wrong_joints_are_named(names: list[str], partial: bool, text: str) -> None:
    with pytest.raises(TrajectoryError) as caught:
        check_joints(names, JOINTS, allow_partial=partial)
    assert caught.value.code is ErrorCode.INVALID_JOINTS
    assert str(caught.value).startswith("Joints on incoming goal don't match the controller joints")
    assert text in str(caught.value)


@pytest.mark.parametrize(
    ("points", "text"),
    [
        ([point(1, [1, 2])], "Mismatch between joint_names size (1) and positions (2) at point #0"),
        ([point(1, [1], [1, 2])], "velocities (2) at point #0"),
        ([point(1, [1]), point(2, [1], [], [1, 2])], "accelerations (2) at point #1"),
        ([point(1, [1]), point(1, [2])], "points 0 and 1 is not strictly increasing"),
        ([point(2, [1]), point(1, [2])], "it is 2.000000 and 1.000000 respectively"),
        ([point(1, [math.nan])], "positions of point #0 are not finite numbers: [nan]"),
    ],
)
def test_bad_points_are_named(points: list[Any], text: str) -> None:
    with pytest.raises(TrajectoryError) as caught:
        read_waypoints(trajectory(["a"], *points), np.array([0]))
    assert caught.value.code is ErrorCode.INVALID_GOAL
    assert text in str(caught.value)
