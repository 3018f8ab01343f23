from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.motion.joint_space import JointSpace


def _space(**changes: object) -> JointSpace:
    values: dict[str, object] = {
        "names": ("lift", "turn"),
        "lower": [0.0, -np.inf],
        "upper": [0.5, np.inf],
        "continuous": [False, True],
        "velocity": [1.0, 1.0],
        "acceleration": [1.0, 1.0],
        "jerk": [np.inf, np.inf],
    }
    return JointSpace(**(values | changes))  # type: ignore[arg-type]


def test_continuous_joints_take_the_short_way() -> None:
    space = _space()
    step = space.between(np.array([0.1, 3.0]), np.array([0.4, -3.0]))
    assert step == pytest.approx([0.3, 2 * math.pi - 6.0])
    assert space.distance(np.array([0.0, -3.0]), np.array([0.0, 3.0])) == pytest.approx(
        2 * math.pi - 6.0
    )


def test_samples_fill_the_limits_and_nothing_else() -> None:
    space, rng = _space(), np.random.default_rng(1)
    samples = np.array([space.sample(rng) for _ in range(2000)])
    assert samples[:, 0].min() >= 0.0
    assert samples[:, 0].max() <= 0.5
    assert samples.mean(0) == pytest.approx([0.25, 0.0], abs=0.15)
    assert np.abs(samples[:, 1]).max() == pytest.approx(math.pi, abs=0.02)


def test_outside_names_joint_value_and_limits() -> None:
    space = _space()
    assert space.outside(np.array([0.7, 100.0])) == ("joint 'lift' is at 0.7, outside [0, 0.5]",)
    assert space.outside(np.array([0.5001, 0.0]), tolerance=0.001) == ()
    assert space.outside(np.array([math.nan, 0.0])) != ()
    assert space.clamped(np.array([0.7, 100.0])) == pytest.approx([0.5, 100.0])


def test_a_continuous_joint_with_limits_is_bounded() -> None:
    space = _space().restricted(np.array([-np.inf, -1.0]), np.array([np.inf, 1.0]))
    assert not space.continuous.any()
    assert space.upper == pytest.approx([0.5, 1.0])
    assert space.low == pytest.approx([0.0, -1.0])


def test_limits_that_leave_nothing_are_refused() -> None:
    with pytest.raises(
        ValueError, match=r"joint 'lift' has lower limit 0\.6 above its upper limit"
    ):
        _space().restricted(np.array([0.6, -np.inf]), np.array([np.inf, np.inf]))


def test_arrays_come_from_names_or_numbers() -> None:
    space = _space()
    assert space.array({"turn": 2.0, "lift": 0.1, "other": 5.0}) == pytest.approx([0.1, 2.0])
    with pytest.raises(ValueError, match="no position is given for 'turn'"):
        space.array({"lift": 0.1})
    with pytest.raises(ValueError, match=r"3 positions for 2 joints \('lift', 'turn'\)"):
        space.array([0.1, 0.2, 0.3])
    with pytest.raises(ValueError, match="the position of 'turn' is not a finite number"):
        space.array([0.1, math.nan])


def test_arrays_of_a_space_cannot_be_written() -> None:
    with pytest.raises(ValueError, match="read-only"):
        _space().lower[0] = 1.0
    with pytest.raises(ValueError, match=r"jerk has shape \(3,\), there are 2 joints"):
        _space(jerk=[1.0, 1.0, 1.0])
