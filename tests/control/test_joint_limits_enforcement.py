"""Laws of joint_limits_interface; expected values follow the comments of its header."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.control.joint_limits import EffortLimits, PositionLimits, VelocityLimits
from gazelle.control.resource_manager import JointLimits

LIMITS = JointLimits(True, -1.0, 1.0, max_velocity=2.0, max_effort=8.0)
SOFT = JointLimits(
    True, -1.0, 1.0, 2.0, None, None, 8.0, True, -0.8, 0.8, k_position=10.0, k_velocity=20.0
)


def one(limits: Any, command: float, position: float = 0.0, velocity: float = 0.0) -> float:
    arrays = (np.array([value]) for value in (command, position, velocity))
    return float(limits.enforce(*arrays, 0.01)[0])


def test_position_command_moves_no_faster_than_the_velocity_limit() -> None:
    limits = PositionLimits([LIMITS])
    moved = [one(limits, 5.0, position=0.3) for _ in range(60)]
    assert moved[0] == pytest.approx(0.32)
    assert np.diff(moved[:30]) == pytest.approx(0.02)
    assert moved[-1] == 1.0


def test_position_commands_start_where_the_joint_is_after_a_reset() -> None:
    limits = PositionLimits([LIMITS])
    one(limits, 1.0)
    limits.reset()
    assert one(limits, 1.0, position=-0.5) == pytest.approx(-0.48)


def test_position_command_slows_down_before_a_soft_limit() -> None:
    limits = PositionLimits([SOFT])
    moved = [one(limits, 5.0) for _ in range(400)]
    steps = np.diff(moved)
    assert steps[0] == pytest.approx(0.02)
    # Far from the limit at full speed, then k_position times the distance to it.
    near = np.array(moved[:-1]) > 0.8 - 2.0 / 10.0
    assert steps[near] == pytest.approx(10.0 * (0.8 - np.array(moved[:-1]))[near] * 0.01)
    assert moved[-1] == pytest.approx(0.8, abs=1e-9)


def test_velocity_command_stays_within_velocity_and_acceleration() -> None:
    limits = VelocityLimits([JointLimits(max_velocity=2.0, max_acceleration=50.0)])
    assert [one(limits, 9.0) for _ in range(6)] == pytest.approx([0.5, 1.0, 1.5, 2.0, 2.0, 2.0])
    assert one(limits, -9.0) == pytest.approx(1.5)


def test_velocity_command_fades_out_before_a_soft_limit() -> None:
    limits = VelocityLimits([SOFT])
    assert one(limits, 9.0, position=0.0) == 2.0
    assert one(limits, 9.0, position=0.75) == pytest.approx(0.5)
    # Beyond the soft limit it is driven back.
    assert one(limits, 9.0, position=0.9) == pytest.approx(-1.0)


def test_effort_beyond_a_position_limit_pushes_inwards_only() -> None:
    limits = EffortLimits([LIMITS])
    assert one(limits, 99.0) == 8.0
    assert one(limits, 99.0, position=1.1) == 0.0
    assert one(limits, -99.0, position=1.1) == -8.0
    assert one(limits, -99.0, position=-1.1) == 0.0


def test_effort_above_the_velocity_limit_brakes_only() -> None:
    limits = EffortLimits([LIMITS])
    assert one(limits, 5.0, velocity=2.1) == 0.0
    assert one(limits, -5.0, velocity=2.1) == -5.0
    assert one(limits, -5.0, velocity=-2.1) == 0.0


def test_effort_fades_out_towards_soft_limits() -> None:
    limits = EffortLimits([SOFT])
    assert one(limits, 99.0, velocity=0.0) == 8.0
    # 20 times the distance to the largest allowed speed, which is 2 far from the limits …
    assert one(limits, 99.0, velocity=1.9) == pytest.approx(20.0 * 0.1)
    # … and 10 times the distance to the soft limit near them.
    assert one(limits, 99.0, position=0.79, velocity=0.0) == pytest.approx(20.0 * 0.1)
    assert one(limits, 99.0, position=0.9, velocity=0.0) == -8.0


@pytest.mark.parametrize("limits", [PositionLimits, VelocityLimits, EffortLimits])
def test_a_joint_without_limits_is_left_alone_and_nan_stays_nan(limits: Any) -> None:
    free = limits([JointLimits(), JointLimits()])
    command = np.array([1e6, math.nan])
    result = free.enforce(command, np.zeros(2), np.zeros(2), 0.001)
    assert result[0] == 1e6
    assert math.isnan(result[1])


def test_joints_with_and_without_soft_limits_share_one_array() -> None:
    limits = EffortLimits([LIMITS, SOFT])
    both = limits.enforce(np.full(2, 99.0), np.full(2, 0.9), np.zeros(2), 0.001)
    assert both == pytest.approx([8.0, -8.0])
