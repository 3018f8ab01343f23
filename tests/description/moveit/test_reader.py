"""MoveIt config packages of ROS 1 and ROS 2."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.shared_files import needs_shared

from gazelle.description.moveit import (
    CartesianLimits,
    config_from_parameters,
    read_moveit_config,
)
from gazelle.diagnostics import Diagnostics
from gazelle.errors import NotFoundError
from gazelle.parameters.trees import nested
from gazelle.workspace import Workspace

Make = Callable[..., Any]

_INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
)
_URDF = (
    f'<robot name="arm"><link name="base">{_INERTIAL}</link><link name="tool">{_INERTIAL}</link>'
    '<joint name="elbow" type="revolute">'
    '<parent link="base"/><child link="tool"/><axis xyz="0 0 1"/>'
    '<limit lower="-1" upper="2" effort="1" velocity="1"/></joint></robot>'
)
_SRDF = '<robot name="arm"><group name="arm"><joint name="elbow"/></group></robot>'
_LIMITS = """\
default_velocity_scaling_factor: 0.5
joint_limits:
  elbow:
    has_velocity_limits: true
    max_velocity: 2
    has_acceleration_limits: true
    max_acceleration: 3.5
"""
_CONTROLLERS = """\
trajectory_execution:
  allowed_start_tolerance: 0.25
moveit_simple_controller_manager:
  controller_names: [arm_controller]
  arm_controller:
    type: FollowJointTrajectory
    action_ns: follow_joint_trajectory
    default: true
    joints: [elbow]
"""


def test_a_package_of_ros_2_is_read(package: Make) -> None:
    made = package().write("config/joint_limits.yaml", _LIMITS)
    made.write("config/kinematics.yaml", "arm:\n  kinematics_solver: kdl/KDL\n"
               "  kinematics_solver_timeout: 0.1\n  position_only_ik: true\n")  # fmt: skip
    made.write("config/moveit_controllers.yaml", _CONTROLLERS)
    made.write("config/ros2_controllers.yaml", "controller_manager: {}\n")
    made.write("config/pilz_cartesian_limits.yaml", "cartesian_limits:\n  max_trans_vel: 0.5\n")
    made.write("config/sensors_3d.yaml", "sensors: []\n")
    config = made.read()
    assert made.said == ""
    assert [group.name for group in config.srdf.groups] == ["arm"]
    assert config.kinematics["arm"].timeout_s == 0.1 and config.kinematics["arm"].position_only
    limit = config.joint_limits["elbow"]
    assert (limit.max_velocity, limit.max_acceleration) == (2.0, 3.5)
    assert (config.velocity_scaling, config.acceleration_scaling) == (0.5, 0.1)
    assert config.cartesian_limits == CartesianLimits(max_trans_vel=0.5)
    (controller,) = config.controllers
    assert (controller.name, controller.joints) == ("arm_controller", ("elbow",))
    assert controller.default and controller.action_ns == "follow_joint_trajectory"
    assert config.execution.allowed_start_tolerance == 0.25
    assert config.default_pipeline == "ompl"
    assert config.pipelines["ompl"].planner_configs["RRTConnect"]["type"].endswith("RRTConnect")
    assert config.pipelines["pilz_industrial_motion_planner"].default_planner == "PTP"


def test_a_package_of_ros_1_is_read(package: Make) -> None:
    robot = package("arm_description", robot=False).write("urdf/arm.urdf", _URDF)
    assert robot.folder.is_dir()
    made = package(robot=False)
    made.write(
        ".setup_assistant",
        "moveit_setup_assistant_config:\n  URDF:\n    package: arm_description\n"
        "    relative_path: urdf/arm.urdf\n  SRDF:\n    relative_path: config/a.srdf.xacro\n",
    )
    xmlns = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    argument = '<xacro:arg name="group" default="arm"/>'
    group = '<group name="$(arg group)"><joint name="elbow"/></group>'
    made.write("config/a.srdf.xacro", f'<robot name="arm" {xmlns}>{argument}{group}</robot>')
    made.write("config/kinematics.yaml", "$(arg group):\n  kinematics_solver: kdl/KDL\n")
    made.write(
        "config/ompl_planning.yaml",
        "planner_configs:\n  RRT:\n    type: geometric::RRT\n"
        "$(arg group):\n  default_planner_config: RRT\n  planner_configs: [RRT]\n"
        "  longest_valid_segment_fraction: 0.01\n",
    )
    made.write(
        "config/simple_moveit_controllers.yaml",
        "controller_list:\n  - name: arm_controller\n    action_ns: follow\n    joints: [elbow]\n",
    )
    made.write("config/cartesian_limits.yaml", "cartesian_limits:\n  max_rot_vel: 1\n")
    config = made.read()
    assert made.said == ""
    assert set(config.kinematics) == {"arm"}
    planners = config.pipelines["ompl"].groups["arm"]
    assert (planners.planners, planners.default_planner) == (("RRT",), "RRT")
    assert planners.longest_valid_segment_fraction == 0.01
    assert set(config.pipelines["ompl"].planner_configs) == {"RRT"}
    assert [item.name for item in config.controllers] == ["arm_controller"]
    assert config.cartesian_limits == CartesianLimits(max_rot_vel=1.0)
    other = made.read(mappings={"group": "leg"})
    assert [item.name for item in other.srdf.groups] == ["leg"] and set(other.kinematics) == {"leg"}


def test_herons_package_is_read_without_a_complaint(examples_dir: Path) -> None:
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=examples_dir / "arm_ws")
    config = read_moveit_config("heron_moveit_config", workspace=workspace, diagnostics=diagnostics)
    assert config is not None and list(diagnostics) == []
    assert config.robot.name == "heron"
    assert [group.name for group in config.srdf.groups] == ["arm", "hand"]
    assert [item.name for item in config.controllers] == ["arm_controller", "hand_controller"]
    assert config.joint_limits["joint_1"].max_acceleration == 4.0
    assert config.execution.allowed_start_tolerance == 0.02


@needs_shared
def test_luck_is_read_without_a_complaint(workspaces_dir: Path) -> None:
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=workspaces_dir / "ros2_ws")
    config = read_moveit_config("luck_robot", workspace=workspace, diagnostics=diagnostics)
    assert config is not None and list(diagnostics) == []
    assert config.robot.name == "luck_description"
    assert config.srdf.groups[0].name == "test_group"
    assert [item.name for item in config.controllers] == ["test_group_controller"]
    assert all(limit.max_acceleration == 1.0 for limit in config.joint_limits.values())


def test_all_mistakes_are_told_at_once_with_places(package: Make) -> None:
    made = package()
    made.write(
        "config/joint_limits.yaml",
        "joint_limits:\n"
        "  elbw:\n    max_velocity: 1.0\n"
        "  elbow:\n    max_velocity: 1.0\n    has_acceleration_limits: true\n"
        "    max_acceleration: fast\n    max_jerc: 2.0\n    max_position: -1.5\n"
        "    min_position: 1.5\n    has_jerk_limits: true\n    max_jerk: -1\n"
        "    has_deceleration_limits: true\n    max_deceleration: 2.0\n",
    )
    made.write(
        "config/kinematics.yaml", "amr:\n  kinematics_solver: kdl\narm:\n  kinematics_sovler: k\n"
    )
    made.write("config/moveit_controllers.yaml",
               "moveit_simple_controller_manager:\n  controller_names: [a, b]\n"
               "  a:\n    joints: [elbow, elbo]\n"
               "    allowed_goal_duration_margin: 1.0\n")  # fmt: skip
    made.write("config/ompl_planning.yaml",
               "planner_configs:\n  RRT: {type: geometric::RRT}\n"
               "arm:\n  planner_configs: [RTT]\n")  # fmt: skip
    made.read()
    for words in (
        "joint_limits.yaml:2:3: warning: robot_description_planning.joint_limits names joint"
        " 'elbw'; the robot has no such joint, the entry has no effect [parameters.moveit-name]"
        "\n  fix: did you mean 'elbow'?",
        "joint_limits.yaml:5:5: warning: robot_description_planning.joint_limits.elbow."
        "max_velocity has no effect, as in MoveIt, for has_velocity_limits is not true"
        " [moveit.limit-without-flag]\n  fix: add has_velocity_limits: true",
        "max_acceleration is 'fast', not a number; it has no effect [moveit.wrong-type]",
        "has a acceleration limit and no max_acceleration; the URDF's stays",
        "joint_limits.yaml:8:5: warning: robot_description_planning.joint_limits.elbow.max_jerc"
        " is not a parameter of MoveIt; it has no effect [moveit.unknown-key]\n  fix: did you"
        " mean 'max_jerk'",
        "min_position 1.5 is above max_position -1.5; both are ignored [moveit.bad-limit]",
        "max_jerk is -1, limits are above 0",
        "max_deceleration is 2, decelerations are below 0",
        "kinematics.yaml:1:1: warning: robot_description_kinematics names group 'amr'; the SRDF"
        " has no such group",
        "kinematics.yaml:4:3: warning: robot_description_kinematics.arm.kinematics_sovler is not",
        "names no kinematics_solver; MoveIt gives the group no inverse kinematics",
        "controller_names has 'b', which is not described below it",
        "names joint 'elbo'; the robot has no such joint",
        "ompl_planning.yaml:4:3: warning: ompl.arm.planner_configs names 'RTT', which"
        " planner_configs does not describe",
    ):
        assert words in made.said, words
    assert "allowed_goal_duration_margin" not in made.said


@pytest.mark.parametrize(
    ("name", "text", "code", "words"),
    [
        (
            "kinematics.yaml",
            "arm: [1,\n",
            "moveit.bad-yaml",
            "kinematics.yaml:2:1: error: not YAML",
        ),
        ("kinematics.yaml", "arm: kdl\n", "moveit.wrong-type", "arm is 'kdl', not a mapping"),
        ("kinematics.yaml", "arm:\n", "moveit.wrong-type", "kinematics.arm is empty"),
        (
            "kinematics.yaml",
            "arm: {kinematics_solver: k, kinematics_solver_ik_links: [tol]}\n",
            "parameters.moveit-name",
            "names link 'tol'; the robot has no such link",
        ),
        ("kinematics.yaml", "- 1\n", "moveit.bad-yaml", "the file holds no mapping"),
        ("kinematics.yaml", "arm: 3\narm: 4\n", "moveit.double-key", "'arm' is there twice"),
        ("kinematics.yaml", "$(arg x): {}\n", "moveit.no-argument", ":1:1: warning: $(arg x) has"),
        (
            "joint_limits.yaml",
            "default_velocity_scaling_factor: 1.5\n",
            "moveit.bad-limit",
            "it has to be above 0 and at most 1; 0.1 is used",
        ),
        (
            "joint_limits.yaml",
            "joint_limits: {elbow: {has_velocity_limits: true, max_velocity: 1e1}}\n",
            "moveit.wrong-type",
            "is the text '1e1'; it is taken as 10",
        ),
        (
            "joint_limits.yaml",
            "joint_limits: {elbow: {has_velocity_limits: true}}\n",
            "moveit.limit-without-value",
            "has a velocity limit and no max_velocity",
        ),
        (
            "simple_moveit_controllers.yaml",
            "controller_list:\n  - joints: [elbow]\n",
            "moveit.controller",
            "entry 1 of controller_list has no name",
        ),
    ],
)
def test_broken_files_are_told(package: Make, name: str, text: str, code: str, words: str) -> None:
    made = package().write(f"config/{name}", text)
    made.read()
    assert words in made.said and f"[{code}]" in made.said


def test_packages_without_robot_or_groups_are_told(package: Make) -> None:
    made = package(robot=False)
    with pytest.raises(AssertionError, match=r"\[moveit.no-description\]"):
        made.read()
    assert "[moveit.no-srdf]" in made.said


def test_one_of_several_robots_is_named(package: Make) -> None:
    made = package().write("config/other.srdf", _SRDF)
    made.read()
    assert (
        "the package has several SRDFs ('arm.srdf', 'other.srdf'); 'arm.srdf' is used" in made.said
    )
    assert "[moveit.several-files]" in made.said
    named = package()
    assert named.read(robot_name="arm").srdf.file == named.folder / "config" / "arm.srdf"
    named.diagnostics = Diagnostics()
    named.read(robot_name="othr")
    assert "a file 'othr.srdf'" in named.said and "did you mean 'other'?" in named.said


def test_a_package_that_is_not_there_is_named() -> None:
    workspace = Workspace.discover(environ={}, cwd="/")
    with pytest.raises(NotFoundError, match="package 'nowhere_moveit_config' not found"):
        read_moveit_config("nowhere_moveit_config", workspace=workspace, diagnostics=Diagnostics())


def test_parameters_of_a_node_are_read_with_dots_and_slashes() -> None:
    diagnostics = Diagnostics()
    config = config_from_parameters(
        {
            "robot_description": _URDF,
            "robot_description_semantic": _SRDF,
            "robot_description_kinematics.arm.kinematics_solver": "kdl",
            "robot_description_planning": {"joint_limits": {"elbow": {"max_position": 1.5}}},
            "robot_description_planning.joint_limits.elbow.has_jerk_limits": True,
            "robot_description_planning.joint_limits.elbow.max_jerk": 9.0,
            "trajectory_execution/allowed_start_tolerance": 0.5,
            "trajectory_execution.execution_duration_monitoring": False,
            "planning_pipelines": ["ompl", "chimp"],
            "default_planning_pipeline": "opml",
            "ompl": {"planning_plugins": ["ompl_interface/OMPLPlanner"]},
            "chomp": {"planning_plugins": ["chomp_interface/CHOMPPlanner"]},
        },
        workspace=None,
        diagnostics=diagnostics,
    )
    assert config is not None
    limit = config.joint_limits["elbow"]
    assert (limit.max_position, limit.max_jerk) == (1.5, 9.0)
    assert config.execution.allowed_start_tolerance == 0.5
    assert config.execution.duration_monitoring is False
    texts = [item.message for item in diagnostics.by_code("moveit.no-pipeline")]
    assert texts == [
        "planning_pipelines names 'chimp', of which there are no parameters",
        "default_planning_pipeline is 'opml'; there are: ompl, chimp",
    ]
    assert config.default_pipeline == "ompl"


def test_parameters_without_descriptions_are_told() -> None:
    diagnostics = Diagnostics()
    assert config_from_parameters({}, workspace=None, diagnostics=diagnostics) is None
    assert diagnostics.by_code("moveit.no-description")
    parameters = {"robot_description": _URDF}
    assert config_from_parameters(parameters, workspace=None, diagnostics=diagnostics) is not None
    assert diagnostics.by_code("moveit.no-srdf")


def test_nested_parameters_merge_branches() -> None:
    flat = {"a.b": 1, "a": {"c": 2, "d.e": 3}, "f/g": 4}
    assert nested(flat) == {"a": {"b": 1, "c": 2, "d": {"e": 3}}, "f": {"g": 4}}


@pytest.mark.parametrize("name", ["ompl", "chomp", "stomp", "pilz_industrial_motion_planner"])
def test_pipelines_that_moveit_brings_along_have_a_planner(package: Make, name: str) -> None:
    config = package().read()
    assert config.pipelines[name].plugins and config.pipelines[name].response_adapters


@pytest.mark.parametrize(
    ("name", "text", "code"),
    [
        ("kinematics.yaml", "arm: {kinematics_solver_timeout: 0.1}\n", "moveit.no-solver"),
        (
            "ompl_planning.yaml",
            "planner_configs: {RRT: {type: r}}\narm: {default_planner_config: RTT}\n",
            "moveit.no-planner",
        ),
    ],
)
def test_entries_that_lack_what_they_need_are_told(
    package: Make, name: str, text: str, code: str
) -> None:
    made = package().write(f"config/{name}", text)
    made.read()
    assert [item.code for item in made.diagnostics] == [code]
