from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.control.trajectory_messages import point, trajectory

from gazelle.control.trajectory.ros1_trajectory import SegmentTrajectory, Splice, hold, splice
from gazelle.control.trajectory.tolerances import Tolerances
from gazelle.control.trajectory.waypoints import TrajectoryError, check_joints, read_waypoints

MS = 1_000_000
JOINTS = ("a", "b", "c")
NO_WRAP = np.zeros(3, dtype=bool)


def put(
    message: Any,
    current: SegmentTrajectory,
    next_ms: int,
    *,
    wraps: np.ndarray = NO_WRAP,
    tolerances: Tolerances | None = None,
) -> tuple[SegmentTrajectory, str]:
    places = check_joints(message.joint_names, JOINTS, allow_partial=True)
    how = Splice(current, (next_ms - 1) * MS, next_ms * MS, wraps, tolerances)
    return splice(read_waypoints(message, places), how)


def moving(next_ms: int = 1) -> SegmentTrajectory:
    """All joints move to 1 within a second, then to 3 within the next."""
    return put(
        trajectory(JOINTS, point(1, [1, 1, 1]), point(2, [3, 3, 3])), hold(np.zeros(3), 0), next_ms
    )[0]


def test_a_bridge_leads_from_the_present_state_to_the_first_waypoint() -> None:
    follow = moving()
    for time_ms, position in ((1, 0.0), (501, 0.5), (1001, 1.0), (1501, 2.0), (2001, 3.0)):
        follow.sample(time_ms * MS)
        assert follow.state[0].tolist() == pytest.approx([position] * 3)


def test_replacing_does_not_jump() -> None:
    old = moving()
    zero = [0.0] * 3
    new, _ = put(trajectory(JOINTS, point(0.5, [-1, 0, 1], zero, zero)), old, 700)
    old.sample(700 * MS)
    new.sample(700 * MS)
    np.testing.assert_allclose(new.state, old.state, atol=1e-12)
    new.sample(1200 * MS)
    assert new.state[0].tolist() == pytest.approx([-1, 0, 1])


def test_what_comes_before_a_future_start_is_kept() -> None:
    old = moving()
    new, remark = put(trajectory(JOINTS, point(0.5, [0, 0, 0]), stamp_s=1.5), old, 300)
    assert remark == ""
    for time_ms in (300, 900, 1200, 1500):
        old.sample(time_ms * MS)
        new.sample(time_ms * MS)
        np.testing.assert_allclose(new.state[0], old.state[0], atol=1e-12)
    new.sample(1750 * MS)
    assert new.state[0] == pytest.approx(np.full(3, (1.998 + 0.0) / 2), abs=1e-9)
    new.sample(2000 * MS)
    assert new.state[0] == pytest.approx(np.zeros(3))


def test_a_start_in_the_past_drops_what_is_over() -> None:
    message = trajectory(
        JOINTS, point(0.1, [9] * 3), point(1, [1] * 3), point(2, [2] * 3), stamp_s=1.0
    )
    new, remark = put(message, hold(np.zeros(3), 0), 1500)
    assert remark.startswith("Dropping first 1 trajectory point(s) out of 3")
    assert "First valid point will be reached in 0.500s" in remark
    new.sample(1750 * MS)
    assert new.state[0].tolist() == pytest.approx([0.5] * 3)
    new.sample(2500 * MS)
    assert new.state[0].tolist() == pytest.approx([1.5] * 3)


def test_a_first_point_at_zero_is_dropped_in_silence() -> None:
    message = trajectory(JOINTS, point(0, [5] * 3), point(1, [1] * 3))
    new, remark = put(message, hold(np.zeros(3), 0), 10)
    assert remark == ""
    new.sample(510 * MS)
    assert new.state[0].tolist() == pytest.approx([0.5] * 3)


def test_a_trajectory_of_the_past_is_refused() -> None:
    with pytest.raises(TrajectoryError, match=r"Dropping all 1 trajectory point\(s\)") as caught:
        put(trajectory(JOINTS, point(1, [1] * 3), stamp_s=0.5), hold(np.zeros(3), 0), 2000)
    assert "Last point is 0.500000s in the past." in str(caught.value)


def test_waypoints_need_positions() -> None:
    with pytest.raises(TrajectoryError, match="Endpoint positions can't be empty"):
        put(trajectory(JOINTS, point(1, [], [1] * 3)), hold(np.zeros(3), 0), 1)


def test_joints_that_are_not_spoken_of_go_on() -> None:
    old = moving()
    new, _ = put(trajectory(["b"], point(0.5, [0])), old, 500)
    assert len(new.tracks) == 2
    for time_ms in (500, 1000, 1700, 2500):
        old.sample(time_ms * MS)
        new.sample(time_ms * MS)
        np.testing.assert_allclose(new.state[:, [0, 2]], old.state[:, [0, 2]], atol=1e-12)
    assert new.state[0, 1] == pytest.approx(0.0)


def test_a_trajectory_of_all_joints_makes_them_one_again() -> None:
    new, _ = put(trajectory(["b"], point(0.5, [0])), moving(), 500)
    both, _ = put(trajectory(JOINTS, point(1, [2, 2, 2])), new, 600)
    assert len(both.tracks) == 1
    new.sample(600 * MS)
    both.sample(600 * MS)
    np.testing.assert_allclose(both.state[0], new.state[0], atol=1e-12)


def test_continuous_joints_take_the_shorter_way() -> None:
    start = hold(np.array([3.0, 3.0, 3.0]), 0)
    message = trajectory(JOINTS, point(1, [-3.0] * 3), point(2, [-2.0] * 3))
    new, _ = put(message, start, 1, wraps=np.array([True, False, True]))
    new.sample(1001 * MS)
    near = 2 * math.pi - 3.0
    assert new.state[0].tolist() == pytest.approx([near, -3.0, near])
    new.sample(2001 * MS)
    assert new.state[0].tolist() == pytest.approx([near + 1, -2.0, near + 1])


def test_a_goal_owns_all_segments_that_still_come() -> None:
    tolerances = Tolerances.of([0.1] * 3, [0.2] * 3, 0.01, 0.0)
    message = trajectory(["b"], point(1, [0]), stamp_s=0.9)
    new, _ = put(message, moving(), 500, tolerances=tolerances)
    by_joint = {int(track.indices[0]): track.segments for track in new.tracks}
    assert [segment.is_of_goal for segment in by_joint[1]] == [False, True]
    assert [segment.tolerances is None for segment in by_joint[1]] == [True, False]
    assert all(segment.is_of_goal for segment in by_joint[0])
    assert all(segment.tolerances is None for segment in by_joint[0])
