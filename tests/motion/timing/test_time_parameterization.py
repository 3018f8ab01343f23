from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.motion.plane import Map2D, space_of

from gazelle.motion.joint_space import FloatArray, JointSpace
from gazelle.motion.planning import FINE_STEP, Path, first_fault
from gazelle.motion.timing import Method, Trajectory, method_of, parameterise


def _space(seed: int, size: int) -> JointSpace:
    rng = np.random.default_rng(seed)
    return replace(
        space_of(size, reach=10.0),
        velocity=rng.uniform(0.5, 3.0, size),
        acceleration=rng.uniform(0.5, 6.0, size),
        jerk=rng.uniform(2.0, 60.0, size),
    )


def _line(seed: int, size: int) -> tuple[JointSpace, FloatArray]:
    rng = np.random.default_rng(seed + 100)
    return _space(seed, size), rng.uniform(-2.0, 2.0, (2, size))


def _least(space: JointSpace, way: FloatArray) -> float:
    """The least time along a straight line, without and with cruising."""
    share = np.abs(way)
    v, a = float((space.velocity / share).min()), float((space.acceleration / share).min())
    return 1.0 / v + v / a if v * v / a <= 1.0 else 2.0 / math.sqrt(a)


def _assert_within_limits(fine: Trajectory, space: JointSpace, factor: float = 1.0) -> None:
    assert (np.abs(fine.velocities) <= space.velocity * factor * 1.0005).all()
    assert (np.abs(fine.accelerations) <= space.acceleration * factor * 1.0005).all()


def _assert_derivatives_agree(fine: Trajectory, most: float) -> None:
    steps = np.diff(fine.times_s)[:, None]
    assert (steps > 0.0).all()
    moved = np.diff(fine.positions, axis=0) / steps
    middle = 0.5 * (fine.velocities[1:] + fine.velocities[:-1])
    assert np.abs(moved - middle).max() < most


@pytest.mark.parametrize("seed", range(8))
def test_straight_motions_take_the_least_time(seed: int) -> None:
    space, ends = _line(seed, 1 + seed % 7)
    trajectory = parameterise(ends, space)
    assert trajectory.duration_s == pytest.approx(_least(space, ends[1] - ends[0]), rel=1e-6)
    assert trajectory.positions[0] == pytest.approx(ends[0])
    assert trajectory.positions[-1] == pytest.approx(ends[1])
    assert np.abs(trajectory.velocities[[0, -1]]).max() == 0.0


@pytest.mark.parametrize("scaling", [(0.5, 1.0), (1.0, 0.25), (0.1, 0.1)])
def test_scaling_factors_scale_the_limits(scaling: tuple[float, float]) -> None:
    space, ends = _line(3, 6)
    slow = replace(
        space, velocity=space.velocity * scaling[0], acceleration=space.acceleration * scaling[1]
    )
    trajectory = parameterise(
        ends, space, velocity_scaling=scaling[0], acceleration_scaling=scaling[1]
    )
    assert trajectory.duration_s == pytest.approx(_least(slow, ends[1] - ends[0]), rel=1e-6)
    assert trajectory.notes == ()


def _random_path(seed: int) -> tuple[JointSpace, FloatArray]:
    size = 1 + seed % 7
    rng = np.random.default_rng(seed)
    return _space(seed, size), rng.uniform(-2.0, 2.0, (3 + seed, size))


@pytest.mark.parametrize("seed", range(1, 9))
def test_motions_around_corners_stay_within_limits(seed: int) -> None:
    space, waypoints = _random_path(seed)
    fine = parameterise(waypoints, space, resample_dt_s=0.001)
    _assert_within_limits(fine, space)
    _assert_derivatives_agree(fine, 0.01)
    assert fine.positions[-1] == pytest.approx(waypoints[-1])


@pytest.mark.parametrize("seed", range(1, 9))
def test_a_limit_is_always_exhausted(seed: int) -> None:
    space, waypoints = _random_path(seed)
    fine = parameterise(waypoints, space, resample_dt_s=0.001)
    used = np.maximum(
        np.abs(fine.velocities) / space.velocity, np.abs(fine.accelerations) / space.acceleration
    ).max(axis=1)
    assert np.mean(used > 0.9) > 0.99
    assert np.mean(used > 0.98) > 0.9


@pytest.mark.parametrize("tolerance", [0.1, 0.02])
def test_corners_are_missed_by_no_more_than_the_tolerance(tolerance: float) -> None:
    waypoints = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    fine = parameterise(waypoints, space_of(2), path_tolerance=tolerance, resample_dt_s=0.001)
    nearest = np.linalg.norm(fine.positions - waypoints[1], axis=1).min()
    assert nearest == pytest.approx(tolerance, rel=1e-3)
    stopping = parameterise(waypoints, space_of(2), path_tolerance=0.0)
    assert stopping.duration_s == pytest.approx(4.0, rel=1e-9)
    assert 3.0 < fine.duration_s < stopping.duration_s


def test_a_motion_back_stops_where_it_turns() -> None:
    fine = parameterise(np.array([[0.0], [1.0], [0.5]]), space_of(1), resample_dt_s=0.01)
    turn = int(np.argmax(fine.positions[:, 0]))
    assert fine.positions[turn, 0] == pytest.approx(1.0, abs=1e-9)
    assert fine.velocities[turn, 0] == pytest.approx(0.0, abs=1e-9)
    assert fine.duration_s == pytest.approx(2.0 + 2.0 * math.sqrt(0.5), rel=1e-9)


def test_samples_are_a_period_apart_with_one_at_the_end() -> None:
    trajectory = parameterise(np.array([[0.0], [1.03]]), space_of(1))
    assert np.diff(trajectory.times_s)[:-1] == pytest.approx(0.1)
    assert trajectory.times_s[-1] == pytest.approx(2.03)


def test_waypoints_on_a_line_change_nothing() -> None:
    ends = np.array([[0.0, 0.0], [1.0, 2.0]])
    dense = np.linspace(0.0, 1.0, 40)[:, None] * ends[1]
    whole = parameterise(ends, space_of(2)).duration_s
    assert parameterise(dense, space_of(2)).duration_s == pytest.approx(whole, rel=1e-6)


def test_corners_keep_away_from_what_they_would_touch() -> None:
    corner = np.array([[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0]])
    post = Map2D(((-0.07, 0.07, 0.05),))
    blind = parameterise(corner, space_of(2))
    assert "circle 0" in first_fault(space_of(2), post, blind.positions)
    seeing = parameterise(corner, space_of(2), validity=post)
    assert first_fault(space_of(2), post, seeing.positions, FINE_STEP) == ""
    at_corner = Map2D(((-0.021, 0.021, 0.0209),))
    stopping = parameterise(corner, space_of(2), validity=at_corner)
    assert first_fault(space_of(2), at_corner, stopping.positions, FINE_STEP) == ""


def _jerks(fine: Trajectory) -> FloatArray:
    jerks: FloatArray = np.diff(fine.accelerations, axis=0) / np.diff(fine.times_s)[:, None]
    return jerks


@pytest.mark.parametrize("seed", range(6))
def test_limits_of_jerk_are_kept_on_lines(seed: int) -> None:
    space, ends = _line(seed, 1 + seed)
    fine = parameterise(ends, space, method="jerk", resample_dt_s=0.001)
    assert (np.abs(_jerks(fine)) <= space.jerk * 1.001).all()
    _assert_within_limits(fine, space)
    _assert_derivatives_agree(fine, 1e-4)
    assert fine.positions[-1] == pytest.approx(ends[1])


@pytest.mark.parametrize(
    ("length", "least"),
    [
        # v = a = 1, j = 4: all seven phases, no cruising, no constant acceleration.
        (3.0, 3.0 + 1.0 + 0.25),
        (0.8, 2.0 * (0.5 * (math.sqrt(0.0625 + 3.2) - 0.25) + 0.25)),
        (0.01, 4.0 * (0.01 / 2.0 / 4.0) ** (1.0 / 3.0)),
    ],
)
def test_the_seven_phases_take_the_least_time(length: float, least: float) -> None:
    space = replace(space_of(1, reach=10.0), jerk=np.array([4.0]))
    found = parameterise(np.array([[0.0], [length]]), space, method="jerk")
    assert found.duration_s == pytest.approx(least, rel=1e-9)


@pytest.mark.parametrize("seed", range(1, 7))
def test_limits_of_jerk_are_kept_around_corners(seed: int) -> None:
    space, waypoints = _random_path(seed)
    fine = parameterise(waypoints, space, method="jerk", resample_dt_s=0.001)
    assert (np.abs(_jerks(fine)[:-1]) <= space.jerk * 1.02).all()
    _assert_within_limits(fine, space)
    _assert_derivatives_agree(fine, 0.01)
    assert fine.positions[0] == pytest.approx(waypoints[0])
    assert fine.positions[-1] == pytest.approx(waypoints[-1])
    stopping = parameterise(waypoints, space, method="jerk", path_tolerance=0.0)
    assert fine.duration_s <= stopping.duration_s


@pytest.mark.parametrize("method", ["totg", "jerk"])
def test_the_spline_between_samples_stays_near_the_motion(method: Method) -> None:
    rng = np.random.default_rng(2)
    waypoints = rng.uniform(-2.0, 2.0, (5, 4))
    space = replace(space_of(4), jerk=np.full(4, 20.0))
    coarse = parameterise(waypoints, space, method=method)
    fine = parameterise(waypoints, space, method=method, resample_dt_s=0.001)
    off = max(
        float(np.abs(coarse.at(t) - q).max())
        for t, q in zip(fine.times_s[::20], fine.positions[::20], strict=True)
    )
    assert off < 0.002


def test_one_place_is_a_motion_of_no_time() -> None:
    path = Path(("joint_1",), np.array([[0.3], [0.3]]))
    trajectory = parameterise(path, space_of(1))
    assert trajectory.duration_s == 0.0
    assert trajectory.positions.tolist() == [[0.3]]


def test_unknown_limits_are_moveits_and_told() -> None:
    space = replace(space_of(2), velocity=np.array([np.inf, 0.5]), acceleration=np.full(2, np.inf))
    trajectory = parameterise(np.array([[0.0, 0.0], [1.0, 1.0]]), space, velocity_scaling=0.0)
    assert trajectory.notes == (
        "no velocity limit is known for 'joint_1'; 1 is used, as in MoveIt (give max_velocity in "
        "joint_limits.yaml)",
        "no acceleration limit is known for 'joint_1', 'joint_2'; 1 is used, as in MoveIt (give "
        "max_acceleration in joint_limits.yaml)",
        "the max_velocity_scaling_factor is 0, which is not within (0, 1]; 1 is used, as in MoveIt",
    )
    assert trajectory.duration_s == pytest.approx(2.0 + 0.5)


def test_limits_and_settings_without_sense_are_refused() -> None:
    ends = np.array([[0.0], [1.0]])
    still = replace(space_of(1), velocity=np.zeros(1))
    with pytest.raises(ValueError, match="the velocity limit of 'joint_1' is not above zero"):
        parameterise(ends, still)
    with pytest.raises(ValueError, match="path_tolerance is -1 and resample_dt 0"):
        parameterise(ends, space_of(1), path_tolerance=-1.0, resample_dt_s=0.0)


def test_paths_that_are_none_are_refused() -> None:
    with pytest.raises(ValueError, match=r"a path of shape \(2, 1\) for 2 joints"):
        parameterise(np.array([[0.0], [1.0]]), space_of(2))
    with pytest.raises(ValueError, match="waypoint 1 of the path has numbers that are not finite"):
        parameterise(np.array([[0.0], [np.nan]]), space_of(1))


def test_a_start_outside_the_limits_does_not_stop_at_every_corner() -> None:
    corner = np.array([[-3.2, 0.0], [-3.1, 0.0], [0.0, 0.0], [0.0, 1.0]])
    blind = parameterise(corner, space_of(2))
    seeing = parameterise(corner, space_of(2), validity=Map2D(()))
    assert seeing.duration_s == pytest.approx(blind.duration_s)


def test_adapters_of_moveit_name_the_method() -> None:
    prefix = "default_planner_request_adapters/"
    assert method_of([prefix + "AddTimeOptimalParameterization"]) == ("totg", ())
    assert method_of(["default_planning_response_adapters/AddRuckigTrajectorySmoothing"])[0] == (
        "jerk"
    )
    method, notes = method_of([prefix + "AddTimeParameterization", prefix + "FixWorkspaceBounds"])
    assert method == "totg"
    assert notes == (
        "AddTimeParameterization is done by time-optimal parameterisation, which is faster and "
        "keeps the same limits",
    )
