"""A robot that sees nothing it knows."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.scan_matching.scan_matcher import Match
from gazelle.mapping.se2 import Poses, compose
from gazelle.mapping.slam import Slam
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes, keyframe_of
from gazelle.mapping.slam.slam_parameters import SlamParameters
from gazelle.mapping.slam.tracking import Tracker


def _scan(ranges_m: np.ndarray) -> Scan:
    return Scan(0, 0.0, math.tau / 90, np.asarray(ranges_m, np.float32), 0.1, 30.0)


def test_a_lost_robot_goes_on_by_odometry_where_nothing_is_alike() -> None:
    scattered = np.random.default_rng(1)
    slam = Slam()
    slam.begin((0.0, 0.0, 0.0))
    slam.add(_scan(np.full(90, 2.0)), (0.0, 0.0, 0.0))
    for step in range(6):
        ranges_m = np.full(90, np.inf)
        ranges_m[scattered.integers(0, 90, 40)] = scattered.uniform(4, 25, 40)
        odometry = 0.5 * (step + 1), 0.0, 0.0
        found = slam.add(_scan(ranges_m), odometry)
    assert found is not None
    np.testing.assert_allclose(found.pose[:2], odometry[:2], atol=0.5)


@pytest.fixture
def tracker(monkeypatch: pytest.MonkeyPatch) -> Tracker:
    """It is lost, and nothing fits where it is expected."""
    monkeypatch.setattr(Tracker, "_followed", lambda *_args: None)
    tracker = Tracker(Keyframes(SlamParameters()), SlamParameters())
    tracker.lost = 1
    return tracker


def _frame(points: int) -> Keyframe:
    ranges_m = np.full(720, np.inf)
    ranges_m[:points] = np.linspace(5.0, 15.0, points)
    scan = Scan(0, 0.0, math.tau / 720, ranges_m.astype(np.float32), 0.1, 30.0)
    frame = keyframe_of(scan, SlamParameters(), 0.0)
    assert len(frame.points_m) == points
    return frame


def _seen(
    tracker: Tracker, monkeypatch: pytest.MonkeyPatch, points: int, poses: list[Poses]
) -> list[bool]:
    """Return whether the robot is believed to be where each scan fits, 1 m after the other."""
    motion, expected, said = np.array([1.0, 0.0, 0.0]), np.zeros(3), []
    for pose in poses:
        expected = compose(expected, motion)
        fits = Match(pose, 0.9, np.eye(3))
        monkeypatch.setattr(Tracker, "relocate", lambda *_args, fits=fits: fits)
        said.append(tracker.locate(_frame(points), expected, motion) is not None)
    return said


def _carried(scans: int, *, turn_rad: float = 2.5) -> list[Poses]:
    start = np.array([2.0, 1.0, turn_rad])
    return [compose(start, np.array([float(k), 0.0, 0.0])) for k in range(1, scans + 1)]


def test_a_few_points_do_not_turn_the_robot_around(
    tracker: Tracker, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert _seen(tracker, monkeypatch, 40, _carried(8)) == [False] * 8
    assert tracker.lost == 9


def test_a_robot_that_was_carried_is_believed_when_scans_in_a_row_say_so(
    tracker: Tracker, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert _seen(tracker, monkeypatch, 180, _carried(3)) == [False, False, True]
    assert tracker.lost == 0


def test_jumps_that_do_not_agree_are_not_added_up(
    tracker: Tracker, monkeypatch: pytest.MonkeyPatch
) -> None:
    turns = (2.5, -1.0, 2.5, -1.0, 2.5, -1.0)
    poses = [_carried(6, turn_rad=turn)[k] for k, turn in enumerate(turns)]
    assert not any(_seen(tracker, monkeypatch, 180, poses))


def test_what_odometry_may_have_erred_by_needs_no_proof(
    tracker: Tracker, monkeypatch: pytest.MonkeyPatch
) -> None:
    near = [np.array([1.4, 0.2, 0.1])]
    assert _seen(tracker, monkeypatch, 40, near) == [True]
