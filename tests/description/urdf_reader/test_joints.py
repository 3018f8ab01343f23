from __future__ import annotations

import math

import pytest

from gazelle.description.model import JointType, Mimic, SafetyController

LIMIT = '<limit lower="-1" upper="2" effort="3" velocity="4"/>'


@pytest.mark.parametrize(
    ("kind", "has_axis"),
    [
        ("revolute", True),
        ("continuous", True),
        ("prismatic", True),
        ("planar", True),
        ("fixed", False),
        ("floating", False),
    ],
)
def test_every_type_of_joint(kind: str, has_axis: bool, read_joint) -> None:
    found = read_joint(LIMIT, kind)
    joint = found.robot.joint("j")
    assert joint.type is JointType(kind)
    assert (joint.axis is not None) == has_axis
    assert not found.codes


def test_limits_apply_to_revolute_joints(read_joint) -> None:
    axis = read_joint(LIMIT, "revolute").robot.joint("j").axis
    assert (axis.lower, axis.upper, axis.effort, axis.velocity) == (-1.0, 2.0, 3.0, 4.0)


def test_continuous_joint_keeps_effort_but_no_range(read_joint) -> None:
    axis = read_joint(LIMIT).robot.joint("j").axis
    assert (axis.lower, axis.upper) == (-math.inf, math.inf)
    assert (axis.effort, axis.velocity) == (3.0, 4.0)


def test_axis_is_x_by_default_and_made_a_unit_vector(read_joint) -> None:
    assert read_joint().robot.joint("j").axis.xyz == (1.0, 0.0, 0.0)
    axis = read_joint('<axis xyz="0 3 4"/>').robot.joint("j").axis
    assert axis.xyz == pytest.approx((0.0, 0.6, 0.8))


def test_zero_axis_is_an_error_except_on_fixed_joints(read_joint) -> None:
    found = read_joint('<axis xyz="0 0 0"/>')
    assert "axis of joint 'j' is 0 0 0" in found.message("urdf.zero-axis")
    assert not read_joint('<axis xyz="0 0 0"/>', "fixed").codes


def test_dynamics_mimic_safety_and_calibration(read_joint) -> None:
    joint = read_joint(
        '<dynamics damping="0.1" friction="0.2"/><calibration rising="0.3" falling="0.4"/>'
        '<safety_controller k_velocity="5" k_position="6" soft_lower_limit="-1"/>'
    ).robot.joint("j")
    assert (joint.axis.damping, joint.axis.friction) == (0.1, 0.2)
    assert (joint.calibration_rising, joint.calibration_falling) == (0.3, 0.4)
    assert joint.safety == SafetyController(-1.0, 0.0, 6.0, 5.0)


def test_mimic_keeps_multiplier_and_offset(read_joint) -> None:
    after = (
        '<link name="c"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" '
        'iyz="0" izz="1"/></inertial></link><joint name="k" type="continuous">'
        '<parent link="a"/><child link="c"/><mimic joint="j" multiplier="0" offset="0.5"/></joint>'
    )
    assert read_joint(after=after).robot.joint("k").mimic == Mimic("j", 0.0, 0.5)


def test_negative_damping_is_not_used(read_joint) -> None:
    found = read_joint('<dynamics damping="-1"/>')
    assert "would feed energy in" in found.message("urdf.dynamics-negative")
    assert found.robot.joint("j").axis.damping == 0.0


@pytest.mark.parametrize(
    ("limit", "code", "text"),
    [
        ('effort="0" velocity="1" upper="1"', "urdf.effort-zero", "no motor and no controller"),
        ('effort="1" velocity="0" upper="1"', "urdf.velocity-zero", "hold it still"),
        ('effort="1" velocity="1"', "urdf.limit-no-range", "(0 to 0): it is stuck"),
        ('effort="1" velocity="1" lower="1" upper="-1"', "urdf.limit-order", "exchanged"),
    ],
)
def test_limits_that_hurt_later_are_reported(limit: str, code: str, text: str, read_joint) -> None:
    found = read_joint(f"<limit {limit}/>", "revolute")
    assert found.codes == [code]
    assert text in found.message(code)


def test_zero_effort_is_kept_and_negative_means_none(read_joint) -> None:
    assert read_joint('<limit effort="0" velocity="1"/>').robot.joint("j").axis.effort == 0.0
    assert read_joint('<limit effort="-1" velocity="-1"/>').robot.joint("j").axis.effort == math.inf


def test_limits_in_wrong_order_are_exchanged(read_joint) -> None:
    found = read_joint('<limit lower="1" upper="-1" effort="1" velocity="1"/>', "revolute")
    axis = found.robot.joint("j").axis
    assert (axis.lower, axis.upper) == (-1.0, 1.0)


def test_missing_limits_say_which_joint(read_joint) -> None:
    found = read_joint(kind="prismatic")
    assert "joint 'j' is prismatic but it does not specify limits" in found.message(
        "urdf.limit-missing"
    )


def test_mistyped_type_gets_a_hint(read_joint) -> None:
    assert "did you mean 'revolute'" in read_joint(kind="revolut").message("urdf.joint-type")


def test_mistyped_attribute_gets_a_hint(read_joint) -> None:
    found = read_joint('<limit effort="1" velocity="1" uper="1"/>')
    assert "did you mean 'upper'" in found.message("xml.unknown-attribute")


def test_angle_that_looks_like_degrees(read_joint) -> None:
    found = read_joint(f'{LIMIT}<origin xyz="0 0 0" rpy="90 0 -0.5"/>')
    (item,) = found.diagnostics.by_code("urdf.degrees")
    assert item.message == ("rpy is 90 0 -0.5: angles are radians here, and 90 looks like degrees")
    assert item.fix == 'write rpy="1.5708 0 -0.5"'


@pytest.mark.parametrize("rpy", ["3.14159 0 0", "0 6.2832 0", "0 0 7.5", "0 0 0"])
def test_angles_in_radians_are_nobodys_degrees(rpy: str, read_joint) -> None:
    assert "urdf.degrees" not in read_joint(f'{LIMIT}<origin rpy="{rpy}"/>').codes
