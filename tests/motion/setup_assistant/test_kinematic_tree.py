"""Planning groups that a kinematic tree suggests."""

from __future__ import annotations

from collections.abc import Callable

from tests.motion.setup_assistant.robots import chain, joint, link

from gazelle.description.srdf import Chain
from gazelle.motion.model import RobotModel
from gazelle.motion.setup_assistant.kinematic_tree import KinematicTree

Bare = Callable[[str], RobotModel]
_SLIDE = {"kind": "prismatic", "axis": "0 1 0", "limits": 'lower="0" upper="0.04"'}


def _fingers(parent: str, prefix: str = "") -> str:
    names = [f"{prefix}left_finger", f"{prefix}right_finger"]
    return "".join(
        link(name) + joint(f"{name}_joint", parent, name, **_SLIDE)  # type: ignore[arg-type]
        for name in names
    )


def test_an_arm_is_a_chain_to_its_tools_frame_and_its_fingers_are_an_end_effector(
    bare: Bare,
) -> None:
    urdf = link("base") + chain("", "base", 6) + link("palm") + link("tool0", "")
    urdf += joint("mount", "link_6", "palm", "fixed") + joint("tool", "palm", "tool0", "fixed")
    groups, effectors = KinematicTree(bare(urdf + _fingers("palm"))).groups()
    arm, hand = groups
    assert (arm.name, arm.chains) == ("arm", (Chain("base", "tool0"),))
    assert (hand.name, hand.links) == ("gripper", ("palm",))
    assert hand.joints == ("left_finger_joint", "right_finger_joint")
    (effector,) = effectors
    assert (effector.name, effector.group, effector.parent_link, effector.parent_group) == (
        "gripper_ee", "gripper", "tool0", "arm",
    )  # fmt: skip


def test_without_a_tools_frame_the_tip_is_above_the_hand(bare: Bare) -> None:
    urdf = link("base") + chain("", "base", 6) + link("flange") + link("hand")
    urdf += joint("f", "link_6", "flange", "fixed") + joint("h", "flange", "hand", "fixed")
    groups, _ = KinematicTree(bare(urdf + _fingers("hand"))).groups()
    assert groups[0].chains == (Chain("base", "flange"),)
    assert groups[1].name == "hand"


def test_two_arms_on_a_torso_have_sides(bare: Bare) -> None:
    urdf = link("base") + link("torso") + joint("torso_lift", "base", "torso", "prismatic")
    urdf += chain("left_", "torso", 6) + chain("right_", "torso", 6)
    urdf += _fingers("left_link_6", "left_") + _fingers("right_link_6", "right_")
    groups, effectors = KinematicTree(bare(urdf)).groups()
    assert [group.name for group in groups] == [
        "torso", "left_arm", "left_gripper", "right_arm", "right_gripper",
    ]  # fmt: skip
    assert [effector.parent_group for effector in effectors] == ["left_arm", "right_arm"]


def test_wheels_are_no_group_and_make_a_robot_drive(bare: Bare) -> None:
    urdf = link("base") + chain("arm_", "base", 5)
    for side in ("left", "right"):
        urdf += link(f"{side}_wheel") + joint(f"{side}_wheel_joint", "base", f"{side}_wheel")
    tree = KinematicTree(bare(urdf))
    assert [group.name for group in tree.groups()[0]] == ["arm"]
    assert tree.has_wheels


def test_a_single_joint_without_a_telling_name_is_no_group(bare: Bare) -> None:
    urdf = link("base") + link("bellows") + joint("bellows_joint", "base", "bellows")
    assert KinematicTree(bare(urdf)).groups() == ((), ())
