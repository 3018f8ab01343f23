"""Robots, groups and limits as MoveIt would have them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import JointType
from gazelle.description.moveit import JointLimit
from gazelle.diagnostics import Diagnostics
from gazelle.errors import NotFoundError
from gazelle.motion.model import JointKind, RobotModel

Make = Callable[..., RobotModel]

_JOINT = (
    '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/>'
    '<limit lower="{4}" upper="{5}" velocity="2" effort="1"/>{6}</joint>'
)


def _joint(
    name: str, parent: str, child: str, kind: str = "revolute",
    low: float = -1, high: float = 1, more: str = "",
) -> str:  # fmt: skip
    return _JOINT.format(name, kind, parent, child, low, high, more) + f'<link name="{child}"/>'


def test_groups_of_the_seven_jointed_arm(seven: RobotModel) -> None:
    arm, hand, everything = (seven.group(name) for name in ("arm", "hand", "all"))
    assert arm.variables == tuple(f"joint{i}" for i in range(1, 8))
    assert (arm.is_chain, arm.base_link, arm.tip_link) == (True, "base", "tcp")
    assert arm.end_effectors == ("gripper",)
    assert "finger_left" in arm.moved_links and "base" not in arm.moved_links
    assert hand.joints == ("hand_joint", "finger", "finger_mirror")
    assert hand.active_joints == ("finger",)
    assert hand.moved_links == ("finger_left", "finger_right")
    assert (hand.is_chain, hand.tip_link) == (False, "")
    assert everything.subgroups == ("arm", "hand")
    assert everything.tip_links == ("finger_left", "finger_right", "tcp")
    assert seven.frame == "world" and seven.root_link == "base"
    assert arm.states["ready"]["joint4"] == -2.356


def test_limits_come_from_the_urdf(seven: RobotModel) -> None:
    space = seven.group("arm").space
    assert space.lower[3] == -3.0718 and space.upper[3] == -0.0698
    assert space.velocity[4] == 2.61 and math.isinf(space.acceleration[0])


def test_default_positions_are_zero_or_the_middle(seven: RobotModel) -> None:
    values = seven.named(seven.default_positions())
    assert values["joint1"] == 0 and values["joint4"] == pytest.approx(-1.5708)


def test_mimicking_joints_follow(seven: RobotModel) -> None:
    values = seven.named(seven.positions({"finger": 0.02}))
    assert values["finger_mirror"] == 0.02
    assert seven.mimic_of("finger_mirror") == ("finger", 1.0, 0.0)


def test_mimics_of_mimics_follow_their_leader(robot: Make) -> None:
    made = robot(
        '<link name="a"/>'
        + _joint("j", "a", "b")
        + _joint("k", "b", "c", more='<mimic joint="j" multiplier="2" offset="0.5"/>')
        + _joint("l", "c", "d", more='<mimic joint="k" multiplier="-1"/>')
    )
    assert made.named(made.positions({"j": 0.1})) == pytest.approx({"j": 0.1, "k": 0.7, "l": -0.7})


def test_joints_are_ordered_depth_first_and_by_name(robot: Make) -> None:
    made = robot(
        '<link name="a"/>' + _joint("z", "a", "b") + _joint("m", "b", "c") + _joint("b", "a", "d")
    )
    assert made.variables == ("b", "z", "m")
    assert made.joints[0].name == "ASSUMED_FIXED_ROOT_JOINT" and made.frame == "a"


def test_a_planar_virtual_joint_has_three_variables(robot: Make) -> None:
    made = robot(
        '<link name="a"/>' + _joint("j", "a", "b"),
        '<virtual_joint name="base" type="planar" parent_frame="odom" child_link="a"/>'
        '<group name="whole"><joint name="base"/><joint name="j"/></group>'
        '<group_state name="there" group="whole"><joint name="base" value="1 2 0.5"/>'
        "</group_state>",
    )
    group = made.group("whole")
    assert group.variables == ("base/x", "base/y", "base/theta", "j")
    assert group.space.continuous.tolist() == [False, False, True, False]
    assert made.frame == "odom" and made.joints[0].kind is JointKind.PLANAR
    assert group.states["there"] == {"base/x": 1.0, "base/y": 2.0, "base/theta": 0.5}
    assert made.positions({"base/x": 3.0, "j": 0.5}).tolist() == [3.0, 0.0, 0.0, 0.5]


def test_a_floating_virtual_joint_starts_upright(robot: Make) -> None:
    made = robot(
        '<link name="a"/>',
        '<virtual_joint name="base" type="floating" parent_frame="world" child_link="a"/>',
    )
    assert made.variables[-1] == "base/rot_w"
    assert made.default_positions().tolist() == [0, 0, 0, 0, 0, 0, 1]


def test_a_chain_up_and_down_has_the_joints_of_both_sides(robot: Make) -> None:
    made = robot(
        '<link name="a"/>' + _joint("j", "a", "left") + _joint("k", "a", "right"),
        '<group name="both"><chain base_link="left" tip_link="right"/></group>',
    )
    group = made.group("both")
    assert group.variables == ("j", "k") and not group.is_chain


def test_a_chain_written_from_its_tip_is_the_same(robot: Make) -> None:
    made = robot(
        '<link name="a"/>' + _joint("j", "a", "b"),
        '<group name="g"><chain base_link="b" tip_link="a"/></group>',
    )
    assert (made.group("g").base_link, made.group("g").tip_link) == ("a", "b")


def test_joint_limits_yaml_changes_limits(robot: Make) -> None:
    change = JointLimit(-0.5, None, True, 0.25, True, 3.0, False, None)
    made = robot(
        '<link name="a"/>' + _joint("j", "a", "b"),
        '<group name="g"><joint name="j"/></group>',
        j=change,
    )
    space = made.group("g").space
    assert (space.lower[0], space.upper[0]) == (-0.5, 1.0)
    assert (space.velocity[0], space.acceleration[0]) == (0.25, 3.0)
    assert math.isinf(space.jerk[0])


def test_a_limit_that_is_switched_off_is_infinite(robot: Make) -> None:
    made = robot(
        '<link name="a"/>' + _joint("j", "a", "b"),
        '<group name="g"><joint name="j"/></group>',
        j=JointLimit(has_velocity=False),
    )
    assert math.isinf(made.group("g").space.velocity[0])


def test_soft_limits_narrow_the_range(robot: Make) -> None:
    soft = '<safety_controller soft_lower_limit="-0.5" soft_upper_limit="3" k_velocity="1"/>'
    made = robot(
        '<link name="a"/>' + _joint("j", "a", "b", more=soft),
        '<group name="g"><joint name="j"/></group>',
    )
    space = made.group("g").space
    assert (space.lower[0], space.upper[0]) == (-0.5, 1.0)


@pytest.mark.parametrize(
    ("urdf", "limits", "code", "words"),
    [
        (
            _joint("j", "a", "b", more='<safety_controller k_velocity="1"/>'),
            {},
            "motion.no-room",
            "the soft limits of joint 'j' leave it no room (0 to 0)",
        ),
        (
            _joint("j", "a", "b"),
            {"j": JointLimit(min_position=1.5)},
            "motion.no-room",
            "leave it no room together with the URDF's (1.5 to 1)",
        ),
        (
            _joint("j", "a", "b", "continuous"),
            {"j": JointLimit(min_position=-1.0, max_position=1.0)},
            "motion.continuous-limit",
            "turns without end",
        ),
    ],
)
def test_limits_without_room_are_told(
    robot: Make, urdf: str, limits: dict[str, JointLimit], code: str, words: str
) -> None:
    told = Diagnostics()
    robot(f'<link name="a"/>{urdf}', diagnostics=told, **limits)
    (found,) = told.by_code(code)
    assert words in found.message


def test_unknown_names_say_what_there_is(seven: RobotModel) -> None:
    with pytest.raises(NotFoundError, match=r"'amr' not found; did you mean 'arm'") as caught:
        seven.group("amr")
    assert "planning groups of 'seven': arm, hand, all" in str(caught.value)
    with pytest.raises(NotFoundError, match=r"joint 'joint_1' not found; did you mean 'joint1'"):
        seven.positions({"joint_1": 0.0})


def test_a_groups_part_goes_there_and_back(seven: RobotModel) -> None:
    group = seven.group("hand")
    positions = seven.with_group(group, np.array([0.03]), seven.default_positions())
    assert group.take(positions).tolist() == [0.03]
    assert seven.named(positions)["finger_mirror"] == 0.03


def test_joints_that_close_loops_or_are_unknown_are_told(seven: RobotModel) -> None:
    told = Diagnostics()
    joints = seven.description.joints
    ball = replace(joints[0], type=JointType.BALL)
    loop = replace(joints[1], name="loop", parent="link1", child="link5")
    changed = replace(seven.description, joints=(ball, *joints[1:], loop))
    made = RobotModel.build(changed, diagnostics=told)
    assert "joint1" not in made.variables and "loop" not in made.variables
    assert "joint 'joint1' is of type ball, which MoveIt does not know" in str(
        told.by_code("motion.joint-type")[0]
    )
    assert "joint 'loop' closes a loop" in str(told.by_code("motion.loop")[0])
