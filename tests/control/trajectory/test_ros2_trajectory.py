from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.control.trajectory_messages import point, trajectory

from gazelle.control.trajectory.ros2_trajectory import Interpolation, PointTrajectory
from gazelle.control.trajectory.splines import JointState
from gazelle.control.trajectory.waypoints import read_waypoints

MS = 1_000_000
STILL = np.array([False])


def follow(
    *points: Any,
    before: JointState | None = None,
    stamp_s: float = 0.0,
    wraps: np.ndarray = STILL,
    interpolation: Interpolation = Interpolation.SPLINES,
    now_ms: int = 100,
) -> PointTrajectory:
    read = read_waypoints(trajectory(["a"], *points, stamp_s=stamp_s), np.array([0]))
    made = PointTrajectory(read, interpolation)
    made.begin(now_ms * MS, before or JointState(np.zeros(1)), wraps)
    return made


def at(made: PointTrajectory, time_ms: int) -> list[float]:
    made.sample(time_ms * MS)
    return [float(value) for value in made.state[:, 0]]


def test_it_begins_now_when_it_has_no_stamp() -> None:
    made = follow(point(1, [1]), point(2, [3]))
    assert at(made, 100) == pytest.approx([0, 1, 0])
    assert at(made, 600) == pytest.approx([0.5, 1, 0])
    assert at(made, 1600) == pytest.approx([2, 2, 0])
    assert at(made, 2100) == pytest.approx([3, 0, 0])
    assert made.end_ns == 2100 * MS


def test_it_leads_to_a_start_in_the_future_at_once() -> None:
    made = follow(point(1, [1]), stamp_s=1.1)
    assert at(made, 1100) == pytest.approx([0.5, 0.5, 0])
    assert at(made, 2100)[0] == 1.0


def test_a_start_in_the_past_begins_in_the_middle() -> None:
    made = follow(point(1, [1]), point(3, [3]), stamp_s=1.0, now_ms=3000)
    assert at(made, 3000) == pytest.approx([2, 1, 0])


def test_the_last_waypoint_is_repeated_with_its_velocity() -> None:
    made = follow(point(1, [1], [0.5]))
    assert at(made, 5000) == pytest.approx([1, 0.5, 0])
    assert not made.sample(5001 * MS)


def test_the_state_before_gets_the_orders_of_the_first_waypoint() -> None:
    made = follow(point(1, [1], [0], [0]))
    x = 0.25
    quintic = 10 * x**3 - 15 * x**4 + 6 * x**5
    assert at(made, 350)[0] == pytest.approx(quintic, abs=1e-12)


def test_measured_velocities_count() -> None:
    made = follow(point(1, [0], [0]), before=JointState(np.zeros(1), np.ones(1)))
    x = 0.5
    assert at(made, 600)[0] == pytest.approx(x - 2 * x**2 + x**3)


def test_positions_are_integrated_from_velocities() -> None:
    made = follow(point(1, [], [1]), point(3, [], [0]), before=JointState(np.array([1.0])))
    assert at(made, 1100)[:2] == pytest.approx([1.5, 1])
    assert at(made, 3100)[:2] == pytest.approx([2.5, 0])


def test_positions_are_integrated_from_accelerations() -> None:
    made = follow(point(2, [], [], [1.0]))
    # Velocity (0 + 1) / 2 * 2, position (0 + velocity) / 2 * 2.
    assert at(made, 2100) == pytest.approx([1, 1, 1])


def test_without_interpolation_it_jumps_to_the_next_waypoint() -> None:
    made = follow(point(1, [1]), point(2, [3]), interpolation=Interpolation.NONE)
    assert [at(made, ms)[0] for ms in (100, 1099, 1100, 2099, 2100)] == [0, 0, 3, 3, 3]


def test_the_state_before_is_moved_by_whole_turns() -> None:
    made = follow(point(1, [-3]), before=JointState(np.array([3.0])), wraps=np.array([True]))
    assert at(made, 100)[0] == pytest.approx(3.0 - 2 * math.pi)
    assert at(made, 1100)[0] == -3.0


def test_efforts_are_joined_by_lines() -> None:
    made = follow(point(1, [1], [], [], [4.0]), point(2, [1], [], [], [0.0]))
    efforts = []
    for time_ms in (100, 600, 1100, 1600, 2100):
        made.sample(time_ms * MS)
        efforts.append(float(made.effort[0]))
    assert efforts == pytest.approx([0, 2, 4, 2, 0])


def test_states_are_told_only_within_the_trajectory() -> None:
    made = follow(point(1, [1]))
    assert made.state_at(99 * MS) is None
    assert made.state_at(1100 * MS) is None
    found = made.state_at(600 * MS)
    assert found is not None
    assert found.position == pytest.approx([0.5])
