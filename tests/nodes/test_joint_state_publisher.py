"""Where joints stand that nothing moves."""

from __future__ import annotations

import pytest

from gazelle.description.model import Joint, JointAxis, JointType
from gazelle.nodes.joint_state_publisher import default_position


def _joint(lower: float, upper: float) -> Joint:
    return Joint("j", JointType.REVOLUTE, "a", "b", axis=JointAxis(lower=lower, upper=upper))


@pytest.mark.parametrize(
    ("lower", "upper", "expected"), [(-1.0, 1.0, 0.0), (0.5, 1.5, 1.0), (-2.0, -1.0, -1.5)]
)
def test_joint_stands_at_zero_or_in_the_middle_when_zero_is_out_of_range(
    lower: float, upper: float, expected: float
) -> None:
    assert default_position(_joint(lower, upper), {}) == expected


def test_zeros_parameter_wins() -> None:
    assert default_position(_joint(-1.0, 1.0), {"j": 0.3}) == 0.3
