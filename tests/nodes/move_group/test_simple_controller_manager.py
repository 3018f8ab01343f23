"""Which controllers a trajectory is sent to."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.description.model import Model
from gazelle.description.moveit import ControllerEntry, MoveItConfig
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.simple_controller_manager import (
    ControllerKind,
    ControllerSpec,
    choose_controllers,
    controller_specs,
)

FOLLOW = ControllerKind.FOLLOW_JOINT_TRAJECTORY


def _spec(name: str, joints: str, *, default: bool = False) -> ControllerSpec:
    return ControllerSpec(name, FOLLOW, f"{name}/f", tuple(joints), is_default=default)


def _config(tree: dict[str, Any], *entries: ControllerEntry) -> MoveItConfig:
    return MoveItConfig(Model("m", (), ()), controllers=entries, parameters=tree)


def test_fewest_controllers_then_defaults_then_fewest_joints() -> None:
    left, right = _spec("left", "ab"), _spec("right", "cd")
    both, spare = _spec("both", "abcd", default=True), _spec("spare", "abcde")
    every = [left, right, spare, both]
    assert [s.name for s in choose_controllers(every, "abcd")] == ["both"]
    assert [s.name for s in choose_controllers([left, right], "ac")] == ["left", "right"]
    assert [s.name for s in choose_controllers([spare, left], "ab")] == ["left"]
    assert [s.name for s in choose_controllers(every, "ab", ["spare"])] == ["spare"]


def test_controllers_that_share_a_joint_are_not_used_together() -> None:
    with pytest.raises(MoveGroupError) as caught:
        choose_controllers([_spec("x", "ab"), _spec("y", "bc")], "abc")
    assert caught.value.code is ErrorCode.CONTROL_FAILED
    assert "can actuate the specified joints: [ a b c ]" in caught.value.reason
    assert "controller 'y' controls joints: b c" in caught.value.reason


def test_joints_without_a_controller_and_unknown_names_are_told() -> None:
    with pytest.raises(MoveGroupError, match="no controller has z"):
        choose_controllers([_spec("x", "ab")], "az")
    with pytest.raises(MoveGroupError, match=r"'arm' is not known. Known controllers: 'arm_ctl'"):
        choose_controllers([_spec("arm_ctl", "ab")], "a", ["arm"])


def test_keys_of_grippers_are_read_from_both_generations_layouts() -> None:
    row = {"max_effort": 4, "allow_failure": True, "parallel": True, "command_joint": "g",
           "allowed_goal_duration_margin": 2.0}  # fmt: skip
    entry = ControllerEntry("hand", ("f", "g"), "gripper_cmd", "GripperCommand")
    trees: list[dict[str, Any]] = [
        {"moveit_simple_controller_manager": {"controller_names": ["hand"], "hand": row}},
        {"controller_list": [{"name": "/hand", **row}]},
    ]
    for tree in trees:
        (spec,) = controller_specs(_config(tree, entry))
        assert spec.action == "hand/gripper_cmd"
        assert (spec.max_effort, spec.allow_failure, spec.is_parallel) == (4.0, True, True)
        assert (spec.command_joint, spec.goal_margin_s, spec.duration_scaling) == ("g", 2.0, None)


def test_the_action_has_its_usual_name_when_none_is_given_and_types_are_checked() -> None:
    (spec,) = controller_specs(_config({}, ControllerEntry("arm", ("a",))))
    assert spec.action == "arm/follow_joint_trajectory"
    with pytest.raises(MoveGroupError, match="Unknown controller type: 'FollowJointTrajectories'"):
        controller_specs(_config({}, ControllerEntry("arm", ("a",), "", "FollowJointTrajectories")))
