"""moveit_configs_utils in a launch file's process: launches and the xacro substitution."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

_PROGRAM = """
from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.substitutions import LaunchConfiguration
from launch_param_builder import ParameterBuilder, load_yaml
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigs, MoveItConfigsBuilder, launches
from moveit_configs_utils.launch_utils import DeclareBooleanLaunchArg
from moveit_configs_utils.moveit_configs_builder import moveit_configs_utils_path
from moveit_configs_utils.substitutions import Xacro
from srdfdom.srdf import SRDF

assert (moveit_configs_utils_path / "default_configs" / "ompl_planning.yaml").is_file()
config = MoveItConfigsBuilder("luck_description", package_name="luck_robot").to_moveit_configs()
assert isinstance(config, MoveItConfigs)


def parts(name):
    description = getattr(launches, f"generate_{name}_launch")(config)
    assert isinstance(description, LaunchDescription)
    arguments = [e for e in description.entities if isinstance(e, DeclareLaunchArgument)]
    nodes = [e for e in description.entities if isinstance(e, Node)]
    included = [e for e in description.entities if isinstance(e, IncludeLaunchDescription)]
    programs = [(n.node_package, n.node_executable) for n in nodes]
    return {a.name for a in arguments}, programs, included


state_publisher = ("robot_state_publisher", "robot_state_publisher")
assert parts("rsp")[:2] == ({"publish_frequency"}, [state_publisher])
assert parts("moveit_rviz")[:2] == ({"debug", "rviz_config"}, [("rviz2", "rviz2")] * 2)
move_group = ("moveit_ros_move_group", "move_group")
arguments, nodes, _ = parts("move_group")
assert nodes == [move_group] * 2
assert arguments == {
    "debug", "allow_trajectory_execution", "publish_monitored_planning_scene", "capabilities",
    "disable_capabilities", "monitor_dynamics",
}
assert parts("spawn_controllers")[1] == [("controller_manager", "spawner")] * 2
assert parts("static_virtual_joint_tfs")[1] == []
config.robot_description_semantic["second"] = (
    '<robot name="r"><virtual_joint name="v" type="fixed" parent_frame="map" child_link="base"/>'
    "</robot>"
)
assert parts("static_virtual_joint_tfs")[1] == [("tf2_ros", "static_transform_publisher")]
del config.robot_description_semantic["second"]
assert parts("setup_assistant")[1][0][0] == "moveit_setup_assistant"
assert {"reset", "moveit_warehouse_port"} < parts("warehouse_db")[0]
arguments, nodes, included = parts("demo")
assert arguments == {"db", "debug", "use_rviz"}
assert nodes == [("controller_manager", "ros2_control_node")] and len(included) == 5

flag = DeclareBooleanLaunchArg("x", default_value=True)
assert flag.choices == ["true", "false", "True", "False"]

file = config.package_path / "config" / "luck_description.urdf.xacro"
context = LaunchContext()
context.launch_configurations["sim"] = "false"
text = Xacro(str(file), mappings={"use_sim": LaunchConfiguration("sim")}).perform(context)
assert "mock_components/GenericSystem" in text and "GazeboSystem</plugin>" not in text
try:
    Xacro.parse(["a", "b"])
except TypeError as error:
    assert "one argument" in str(error)
else:
    raise AssertionError("two arguments were taken")
found = ParameterBuilder("luck_robot").yaml("config/kinematics.yaml").to_dict()
assert found == load_yaml(config.package_path / "config" / "kinematics.yaml")
assert SRDF.from_xml_string(config.robot_description_semantic["robot_description_semantic"]).groups
"""


@pytest.mark.tutorial
def test_launches_of_a_package_are_made(passes: Callable[..., Any], workspaces_dir: Path) -> None:
    passes(_PROGRAM, ROS_PACKAGE_PATH=str(workspaces_dir / "ros2_ws" / "src"))
