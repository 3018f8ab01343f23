from __future__ import annotations

from gazelle.control.joint_limits import limits_from_parameters, limits_of
from gazelle.control.resource_manager import JointLimits
from gazelle.description.model import Joint, JointAxis, JointType, SafetyController


def joint(kind: JointType = JointType.REVOLUTE, safety: SafetyController | None = None) -> Joint:
    axis = JointAxis(lower=-1.0, upper=2.0, effort=5.0, velocity=3.0)
    return Joint("j", kind, "a", "b", axis=axis, safety=safety)


def test_limits_come_from_the_description() -> None:
    expected = JointLimits(True, -1.0, 2.0, max_velocity=3.0, max_effort=5.0)
    assert limits_of(joint()) == expected


def test_continuous_joint_has_no_position_limits() -> None:
    limits = limits_of(joint(JointType.CONTINUOUS))
    assert not limits.has_position_limits
    assert limits.max_effort == 5.0


def test_joint_without_limit_has_none() -> None:
    free = limits_of(Joint("j", JointType.CONTINUOUS, "a", "b", axis=JointAxis()))
    assert (free.max_velocity, free.max_effort) == (None, None)


def test_safety_controller_gives_soft_limits() -> None:
    limits = limits_of(joint(safety=SafetyController(-0.5, 1.5, 20.0, 10.0)))
    assert limits.has_soft_limits
    assert (limits.soft_lower, limits.soft_upper) == (-0.5, 1.5)
    assert (limits.k_position, limits.k_velocity) == (20.0, 10.0)


def test_parameters_override_take_away_and_add_limits() -> None:
    tree = {
        "has_position_limits": False,
        "has_velocity_limits": True,
        "max_velocity": 9,
        "has_acceleration_limits": True,
        "max_acceleration": 4.0,
        "has_effort_limits": False,
    }
    limits = limits_from_parameters(limits_of(joint()), tree)
    assert not limits.has_position_limits
    assert limits.max_velocity == 9.0
    assert limits.max_acceleration == 4.0
    assert limits.max_effort is None


def test_a_limit_without_its_values_changes_nothing() -> None:
    given = limits_of(joint())
    tree = {"has_position_limits": True, "min_position": -9.0, "has_velocity_limits": True}
    assert limits_from_parameters(given, {**tree, "max_effort": 1.0}) == given


def test_soft_limits_from_parameters_need_all_four_values() -> None:
    tree = {"has_soft_limits": True, "soft_lower_limit": 0, "soft_upper_limit": 1, "k_position": 2}
    assert not limits_from_parameters(JointLimits(), tree).has_soft_limits
    limits = limits_from_parameters(JointLimits(), {**tree, "k_velocity": 3})
    assert limits.has_soft_limits
    assert limits.k_velocity == 3.0
