"""Limits are never exceeded, and they are reached."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.control.wheels.speed_limiter import (
    AccelerationLimits,
    SpeedLimiter,
    SpeedLimits,
    TractionLimiter,
    TractionLimits,
)

DT = 0.01


def _run(limiter, wanted):
    return np.array([0.0, 0.0] + [limiter.limit(value, DT) for value in wanted])


@pytest.fixture
def wanted():
    random = np.random.default_rng(7)
    return np.repeat(random.uniform(-3, 3, 40), 30)


def test_velocity_stays_within_its_bounds_and_reaches_both(wanted):
    speeds = _run(SpeedLimiter(SpeedLimits(velocity=(-0.5, 1.0))), wanted)
    assert (speeds.min(), speeds.max()) == (-0.5, 1.0)


def test_each_kind_of_acceleration_keeps_its_own_bound(wanted):
    bounds = AccelerationLimits(1.0, -2.0, -3.0, 4.0)
    speeds = _run(SpeedLimiter(SpeedLimits(acceleration=bounds)), wanted)
    before, rates = speeds[1:-1], np.diff(speeds)[1:] / DT
    assert rates[before >= 0].max() == pytest.approx(1.0)
    assert rates[before > 0].min() == pytest.approx(-2.0)
    assert rates[before <= 0].min() == pytest.approx(-3.0)
    assert rates[before < 0].max() == pytest.approx(4.0)


@pytest.mark.parametrize("factor", [1.0, 2.0])
def test_jerk_reaches_its_bound_and_in_ros1_twice_of_it(factor):
    limits = SpeedLimits(jerk=(-5.0, 5.0), ros1_jerk=factor == 2.0)
    speeds = _run(SpeedLimiter(limits), np.maximum.accumulate(np.linspace(0, 3, 400)))
    jerks = np.diff(speeds, 2) / DT**2
    assert jerks.max() == pytest.approx(5.0 * factor)


def test_ros1_jerk_holds_in_both_directions_at_any_time(wanted):
    speeds = _run(SpeedLimiter(SpeedLimits(jerk=(-5.0, 5.0), ros1_jerk=True)), wanted)
    jerks = np.diff(speeds, 2) / DT**2
    assert np.abs(jerks).max() == pytest.approx(10.0)


def test_ros2_jerk_does_not_hold_while_acceleration_is_taken_back():
    limiter = SpeedLimiter(SpeedLimits(jerk=(-5.0, 5.0)))
    _run(limiter, [1.0] * 20)
    last = limiter.limit(1.0, DT)
    assert limiter.limit(last, DT) == last


def test_nothing_is_limited_without_limits(wanted):
    assert _run(SpeedLimiter(SpeedLimits()), wanted)[2:] == pytest.approx(wanted)


def test_reset_starts_from_rest():
    limiter = SpeedLimiter(SpeedLimits(acceleration=AccelerationLimits(1.0, -1.0, -1.0, 1.0)))
    _run(limiter, [1.0] * 50)
    limiter.reset()
    assert limiter.limit(1.0, DT) == pytest.approx(0.01)


def test_traction_brakes_by_its_deceleration_in_both_directions():
    limits = TractionLimits(value=(0.0, 2.0), increase=(0.0, 1.0), decrease=(0.0, 5.0))
    for sign in (1.0, -1.0):
        speeds = _run(TractionLimiter(limits), [3.0 * sign] * 300 + [0.0] * 100)
        rates = np.diff(np.abs(speeds)) / DT
        assert np.abs(speeds).max() == pytest.approx(2.0)
        assert (rates.max(), rates.min()) == pytest.approx((1.0, -5.0))


def test_steering_angle_stays_between_its_ends():
    limits = TractionLimits(increase=(0.0, 2.0), decrease=(0.0, 2.0), between=(-0.3, 0.5))
    angles = _run(TractionLimiter(limits), [1.0] * 100 + [-1.0] * 100)
    assert (angles.min(), angles.max()) == (-0.3, 0.5)
    assert np.abs(np.diff(angles)).max() / DT == pytest.approx(2.0)


def test_traction_jerk_is_bounded():
    limits = TractionLimits(bend=(0.0, 5.0))
    speeds = _run(TractionLimiter(limits), np.linspace(0, 3, 100))
    assert np.abs(np.diff(speeds, 2)).max() / DT**2 == pytest.approx(10.0)
