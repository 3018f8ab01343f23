"""What the Setup Assistant proposes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from tests.motion.setup_assistant.conftest import HERON, SEVEN, proposed
from tests.motion.setup_assistant.robots import joint, link

from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.description.moveit import read_moveit_config
from gazelle.diagnostics import Diagnostics
from gazelle.motion.setup_assistant import RobotSource, propose, read_robot
from gazelle.motion.setup_assistant.hardware import command_interfaces
from gazelle.motion.setup_assistant.package_files import SetupAssistantError
from gazelle.motion.setup_assistant.proposal import package_name_for
from gazelle.workspace import Workspace


def _model(urdf: str) -> Model:
    text = f'<robot name="r">{urdf}</robot>'
    (model,) = load_models(text, workspace=None, diagnostics=Diagnostics())
    return model


def test_herons_proposal_is_what_its_makers_chose_and_more_pairs_that_never_meet() -> None:
    config, _ = proposed(HERON)
    own = read_moveit_config(HERON.parents[2] / "heron_moveit_config", diagnostics=Diagnostics())
    assert own is not None
    assert [
        (group.name, group.chains, group.links, group.joints) for group in config.srdf.groups
    ] == [(group.name, group.chains, group.links, group.joints) for group in own.srdf.groups]
    assert config.srdf.passive_joints == own.srdf.passive_joints
    assert not config.srdf.virtual_joints
    ours = {(pair.link1, pair.link2): pair.reason for pair in config.srdf.disabled_pairs}
    theirs = {
        tuple(sorted((pair.link1, pair.link2))): pair.reason for pair in own.srdf.disabled_pairs
    }
    assert theirs.items() <= ours.items()
    assert {ours[pair] for pair in ours.keys() - theirs.keys()} == {"Never"}
    assert [(one.name, one.joints, one.type, one.action_ns) for one in config.controllers] == [
        (one.name, one.joints, one.type, one.action_ns) for one in own.controllers
    ]
    assert config.controllers[1].plugin == "effort_controllers/GripperActionController"
    assert config.added_joints == ()


def test_poses_are_home_open_and_close_and_hardware_begins_at_them() -> None:
    config, _ = proposed(SEVEN)
    poses = {(state.group, state.name): dict(state.values) for state in config.srdf.states}
    assert poses.keys() == {("arm", "home"), ("hand", "open"), ("hand", "close")}
    assert poses["arm", "home"]["joint4"] == (-1.5708,)
    assert poses["hand", "open"] == {"finger": (0.04,)}
    assert poses["hand", "close"] == {"finger": (0.0,)}
    assert config.initial_positions["joint4"] == -1.5708
    assert config.initial_positions["finger"] == 0.04
    assert "finger_mirror" not in config.initial_positions


def test_limits_are_the_urdfs_speed_and_no_acceleration() -> None:
    config, model = proposed(SEVEN)
    limit = config.joint_limits["joint1"]
    axis = model.joint("joint1").axis
    assert (limit.has_velocity_limits, limit.max_velocity) == (True, axis.velocity)
    assert (limit.has_acceleration_limits, limit.max_acceleration) == (False, 0.0)


def test_transmissions_say_the_interface_in_ros_1_and_ros2_control_in_ros_2() -> None:
    urdf = link("a") + link("b") + joint("j", "a", "b") + (
        '<transmission name="t"><type>transmission_interface/SimpleTransmission</type>'
        '<joint name="j"><hardwareInterface>hardware_interface/EffortJointInterface'
        '</hardwareInterface></joint><actuator name="m"/></transmission>'
    )  # fmt: skip
    model = _model(urdf)
    assert command_interfaces(model, 1) == {"j": ("effort",)}
    assert command_interfaces(model, 2) == {"j": ("position",)}


def test_short_arms_reach_positions_only_and_a_robot_on_wheels_is_held_in_the_plane() -> None:
    urdf = link("base") + link("one") + link("two") + link("three") + link("wheel")
    urdf += joint("a", "base", "one") + joint("b", "one", "two") + joint("c", "two", "three")
    urdf += joint("wheel_joint", "base", "wheel", "continuous", axis="0 1 0")
    model = _model(urdf)
    config = propose(model, RobotSource(Path("r.urdf")), diagnostics=Diagnostics())
    assert config.kinematics["arm"].position_only
    (virtual,) = config.srdf.virtual_joints
    assert (virtual.type, virtual.parent_frame, virtual.child_link) == ("planar", "odom", "base")
    assert config.command_interfaces["wheel_joint"] == ("velocity",)


def test_packages_are_named_after_the_robot() -> None:
    assert package_name_for("My-Arm 2") == "my_arm_2_moveit_config"
    assert package_name_for("") == "robot_moveit_config"


def test_a_file_without_a_robot_is_told(tmp_path: Path) -> None:
    file = tmp_path / "bad.urdf"
    file.write_text("<robot", encoding="utf-8")
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    with pytest.raises(SetupAssistantError, match=r"there is no robot in .*bad\.urdf:"):
        read_robot(file, workspace=workspace, diagnostics=Diagnostics())


def test_a_robot_of_no_package_is_copied(tmp_path: Path) -> None:
    file = tmp_path / "own.urdf"
    file.write_text(f'<robot name="own">{link("a")}</robot>', encoding="utf-8")
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    source, model = read_robot(file, workspace=workspace, diagnostics=Diagnostics())
    assert (source.package, source.relative_path) == ("", "config/own.urdf")
    assert source.copied_text == file.read_text(encoding="utf-8")
    assert replace(source, xacro_args="a:=1 b:=x").mappings == {"a": "1", "b": "x"}
    assert model.name == "own"
