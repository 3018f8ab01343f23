from __future__ import annotations

import numpy as np
import pytest

from gazelle.control.trajectory.ros1_trajectory import (
    Segment,
    SegmentTrajectory,
    Track,
    hold,
    ramp_down,
)
from gazelle.control.trajectory.splines import JointState

MS = 1_000_000


def line(start: float, end: float, start_ns: int, end_ns: int) -> Segment:
    first, last = JointState(np.array([start])), JointState(np.array([end]))
    return Segment.between(start_ns, first, end_ns, last)


def test_a_track_rests_before_and_after_its_segments() -> None:
    track = Track(np.array([0]), [line(1.0, 2.0, 10 * MS, 20 * MS)])
    for time_ms, position, velocity in ((5, 1, 0), (10, 1, 100), (15, 1.5, 100), (20, 2, 100)):
        assert track.sample(time_ms * MS)
        assert track.state[:2, 0].tolist() == pytest.approx([position, velocity])
    assert track.sample(21 * MS)
    assert track.state[:, 0].tolist() == pytest.approx([2, 0, 0])
    assert not track.sample(22 * MS)


def test_time_may_go_back() -> None:
    track = Track(np.array([0]), [line(0, 1, 0, 10 * MS), line(1, 0, 10 * MS, 20 * MS)])
    track.sample(19 * MS)
    track.sample(5 * MS)
    assert track.state[0, 0] == pytest.approx(0.5)


def test_sampling_at_will_equals_sampling_in_order() -> None:
    segments = [line(0, 1, 0, 10 * MS), line(1, 3, 10 * MS, 20 * MS)]
    one, other = Track(np.array([0]), segments), Track(np.array([0]), segments)
    for time_ms in (0, 4, 10, 15, 20, 30):
        one.sample(time_ms * MS)
        state = other.state_at(time_ms * MS)
        assert state.position == pytest.approx(one.state[0])
        assert state.velocity == pytest.approx(one.state[1])


def test_tracks_of_a_trajectory_fill_their_own_joints() -> None:
    both = SegmentTrajectory(
        [
            Track(np.array([1]), [line(0, 1, 0, 10 * MS)]),
            Track(np.array([0]), [line(5, 7, 0, 20 * MS)]),
        ]
    )
    assert both.sample(5 * MS)
    assert both.state[0].tolist() == pytest.approx([5.5, 0.5])
    assert both.state_at(10 * MS).position.tolist() == pytest.approx([6.0, 1.0])
    both.sample(15 * MS)
    assert both.state[1].tolist() == pytest.approx([100.0, 0.0])
    assert [both.track_of(joint)[0].indices.tolist() for joint in (0, 1)] == [[0], [1]]


def test_holding_changes_nothing_after_the_first_sample() -> None:
    still = hold(np.array([1.0, 2.0]), 7 * MS)
    assert still.sample(8 * MS)
    assert not still.sample(9 * MS)
    np.testing.assert_array_equal(still.state, [[1, 2], [0, 0], [0, 0]])


def test_a_ramp_begins_with_the_velocity_and_ends_at_rest() -> None:
    ramp = ramp_down(np.array([1.0]), np.array([0.8]), 0, 500 * MS)
    ramp.sample(0)
    assert ramp.state[:2, 0].tolist() == pytest.approx([1.0, 0.8])
    ramp.sample(500 * MS)
    assert ramp.state[1, 0] == pytest.approx(0.0, abs=1e-12)
    # Half of the symmetric quintic there and back: x(T) = v T 5 / 8.
    assert ramp.state[0, 0] == pytest.approx(1.0 + 0.8 * 0.5 * 5 / 8)
    ramp.sample(900 * MS)
    assert ramp.state[1, 0] == 0.0
