from __future__ import annotations

import numpy as np
import pytest

from gazelle.control.trajectory.ros2_trajectory import PointTrajectory, decelerating, holding
from gazelle.control.trajectory.splines import JointState

MS = 1_000_000


def test_joints_slow_down_as_they_may() -> None:
    velocity, slow = np.array([1.0, -0.5, 0.0]), np.array([2.0, 4.0, 1.0])
    way = decelerating(np.array([0.5, 0.0, -1.0]), velocity, slow, 10 * MS)
    follow = PointTrajectory(way)
    follow.begin(0, JointState(way.states[0].position), np.zeros(3, dtype=bool))
    for time_ms in range(0, 700, 7):
        follow.sample(time_ms * MS)
        time_s = np.minimum(time_ms / 1000, np.abs(velocity) / slow)
        place = np.array([0.5, 0.0, -1.0]) + velocity * time_s
        place -= np.sign(velocity) * slow * time_s**2 / 2
        # The last piece, in which a joint comes to rest, is rounded off.
        np.testing.assert_allclose(follow.state[0], place, atol=slow.max() * 0.01**2)
    np.testing.assert_allclose(follow.state[0], [0.75, -0.03125, -1.0])
    assert not follow.state[1].any()


def test_joints_at_rest_stop_at_once() -> None:
    way = decelerating(np.ones(2), np.zeros(2), np.ones(2), 10 * MS)
    assert way.times_ns == (0,)
    assert way.states[0].position.tolist() == [1.0, 1.0]


def test_holding_begins_and_ends_at_once() -> None:
    follow = PointTrajectory(holding(JointState(np.array([2.0]))))
    follow.begin(5 * MS, JointState(np.array([9.0])), np.array([False]))
    assert follow.sample(5 * MS)
    assert follow.state[:, 0].tolist() == pytest.approx([2.0, 0.0, 0.0])
    assert not follow.sample(6 * MS)
