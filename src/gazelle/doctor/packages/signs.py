"""Words in a package's files that tell which ROS they were written for."""

from __future__ import annotations

import re
from typing import NamedTuple

__all__ = ["SIGNS", "Sign"]


class Sign(NamedTuple):
    """A pattern and what it tells.

    Attributes:
        part: what kind of file: ``launch``, ``description``, ``code``, ``parameters``.
        endings: names of files that are looked at.
        pattern: searched for in the text without XML comments.
        written_for: distributions, in words.
        ros_version: 1 or 2, 0 when the sign tells nothing about it.
        why: what changed when.
        here: what Gazelle does with it.
        is_strict: the other generation cannot read such a file at all.
    """

    part: str
    endings: tuple[str, ...]
    pattern: re.Pattern[str]
    written_for: str
    ros_version: int
    why: str
    here: str
    is_strict: bool = False


_LAUNCH1 = (".launch", ".launch.xml")
_LAUNCH2 = (".launch.py", "_launch.py", ".launch.xml", ".launch.yaml")
_ROBOT = (".urdf", ".xacro", ".xml", ".sdf", ".world", ".gazebo", ".trans")
_CODE = (".py",)
_CPP = (".cpp", ".cc", ".h", ".hpp")
_YAML = (".yaml", ".yml")
_AS_IT_IS = "runs as it is"
_ROWS: tuple[tuple[str, tuple[str, ...], str, str, int, str, str, bool], ...] = (
    # -- ROS 1 launch files
    ("launch", _LAUNCH1, r'pkg="gazebo"', "Fuerte and before", 1,
     "package gazebo became gazebo_ros in Groovy", "the old name is an alias", True),
    ("launch", _LAUNCH1, r"pr2_controller_manager", "Fuerte and before", 1,
     "pr2_controller_manager became controller_manager in Hydro", "the old name is an alias", True),
    ("launch", _LAUNCH1, r'type="state_publisher"', "Melodic and before", 1,
     "state_publisher was renamed to robot_state_publisher", "the old name is an alias", True),
    ("launch", _LAUNCH1, r"xacro\.py", "Melodic and before", 1,
     "xacro.py was removed in Noetic", "the old name is an alias", True),
    ("launch", _LAUNCH1, r"xacro\S*\s[^>]*--inorder", "Indigo to Melodic", 1,
     "--inorder is the rule since Melodic", "accepted, without effect", True),
    ("launch", _LAUNCH1, r'<param\s[^>]*name="use_gui"', "Melodic and before", 1,
     "use_gui moved to joint_state_publisher_gui in Noetic", _AS_IT_IS, True),
    ("launch", _LAUNCH1, r'<node\b[^>]*\stype\s*=', "ROS 1", 1,
     "<node type=…> is roslaunch's", _AS_IT_IS, True),
    ("launch", (".launch",), r'pkg="gazebo_ros"|\$\(find gazebo_ros\)', "Hydro to Noetic", 1,
     "gazebo_ros of ROS 1", "starts Gazelle's simulator", True),
    # -- ROS 2 launch files
    ("launch", _LAUNCH2, r"\bnode_(?:executable|name|namespace)\s*=", "Dashing to Foxy", 2,
     "Node(node_executable=…) became executable=… in Foxy, the old word went in Galactic", "read",
     True),
    ("launch", _LAUNCH2, r"spawn_entity\.py", "Foxy to Humble", 2,
     "spawn_entity.py spawns into Gazebo Classic, which Jazzy no longer has", "read", True),
    ("launch", _LAUNCH2, r"\bros_ign_gazebo\b|\bign gazebo\b", "Foxy to Humble", 2,
     "ros_ign_gazebo became ros_gz_sim in Humble", "read", True),
    ("launch", _LAUNCH2, r"\bros_gz_sim\b", "Humble and later", 2,
     "ros_gz_sim starts the new Gazebo", "read", True),
    ("launch", _LAUNCH2, r"""["']spawner\.py["']""", "Foxy to Galactic", 2,
     "spawner.py became spawner in Galactic", "read", True),
    ("launch", _LAUNCH2, r"MoveItConfigsBuilder", "Humble and later", 2,
     "moveit_configs_utils came with Humble", "read", True),
    ("launch", (".launch.py", "_launch.py"), r"generate_launch_description", "ROS 2", 2,
     "generate_launch_description() is ROS 2's", "read", True),
    # -- descriptions
    ("description", _ROBOT, r"<(?:controller|interface|sensor):\w+", "Diamondback to Fuerte", 1,
     "prefixed tags of Gazebo before 1.0", "read as their successors", False),
    ("description", _ROBOT, r"<hardwareInterface>\s*(?:Effort|Position|Velocity)Joint", "Hydro", 1,
     "hardware interfaces have their package in front since Indigo", "both are read", False),
    ("description", _ROBOT, r"<hardwareInterface>\s*hardware_interface/", "Indigo to Noetic", 1,
     "hardware_interface/… in <transmission>", "driven by ros_control's controllers", False),
    ("description", _ROBOT, r"libgazebo_ros_control\b", "Hydro to Noetic", 1,
     "gazebo_ros_control is ROS 1's", "driven by ros_control's controllers", False),
    ("description", _ROBOT, r"<robotNamespace>", "ROS 1", 1,
     "<robotNamespace> is a plug-in's parameter of ROS 1", "both are read", False),
    ("description", _ROBOT, r"gazebo_ros2_control/GazeboSystem", "Foxy to Humble", 2,
     "gazebo_ros2_control drives Gazebo Classic", "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"ign_ros2_control|IgnitionSystem", "Foxy to Humble", 2,
     "ign_ros2_control/IgnitionSystem became gz_ros2_control/GazeboSimSystem",
     "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"gz_ros2_control/GazeboSimSystem", "Humble and later", 2,
     "gz_ros2_control drives the new Gazebo", "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"<ros2_control\b", "ROS 2", 2,
     "<ros2_control> is ROS 2's", "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"<ros>\s*<", "Foxy to Humble", 2,
     "<ros> in a plug-in of Gazebo Classic is ROS 2's", "both are read", False),
    ("description", _ROBOT, r"libignition-gazebo|ignition::gazebo|ignition-gazebo-",
     "Gazebo Citadel to Fortress", 0, "ignition::gazebo became gz::sim in Garden",
     "both names are the same plug-in", False),
    ("description", _ROBOT, r"gz::sim|gz-sim-\w+-system", "Gazebo Garden and later", 0,
     "gz::sim is the name since Garden", "both names are the same plug-in", False),
    # -- code
    ("code", _CODE, r"roslib\.load_manifest", "Fuerte and before", 1,
     "load_manifest is rosbuild's", _AS_IT_IS, True),
    ("code", _CODE, r"(?m)^[ \t]*print[ \t]+[\"'%\w]", "Melodic and before", 1,
     "print without parentheses is Python 2's", "translated when it is started", False),
    ("code", _CODE, r"(?m)^[ \t]*(?:import|from) rospy\b", "ROS 1", 1, "rospy is ROS 1's",
     _AS_IT_IS, True),
    ("code", _CODE, r"(?m)^[ \t]*(?:import|from) rclpy\b", "ROS 2", 2, "rclpy is ROS 2's",
     _AS_IT_IS, True),
    ("code", _CPP, r"#include\s*[<\"]ros/ros\.h", "ROS 1", 1, "ros/ros.h is ROS 1's",
     "compiled code has to be built by catkin", True),
    ("code", _CPP, r"#include\s*[<\"]rclcpp/", "ROS 2", 2, "rclcpp is ROS 2's",
     "compiled code has to be built by colcon", True),
    # -- parameters
    ("parameters", _YAML, r"(?m)^\s*(?:TrajectoryPlannerROS|DWAPlannerROS|TebLocalPlannerROS):",
     "ROS 1", 1, "parameters of move_base", "read", False),
    ("parameters", _YAML, r"(?m)^\s*type:\s*[\"']?(?:effort|position|velocity)_controllers/Joint"
     r"(?!Group)", "ROS 1", 1, "controllers of ros_control", "read", False),
    ("parameters", _YAML, r"recoveries_server:", "Foxy to Galactic", 2,
     "recoveries_server became behavior_server in Humble", "read", False),
    ("parameters", _YAML, r"enable_stamped_cmd_vel:", "Jazzy and later", 2,
     "enable_stamped_cmd_vel came with Jazzy", "read", False),
    ("parameters", _YAML, r"ros__parameters:", "ROS 2", 2, "ros__parameters is ROS 2's", "read",
     True),
)  # fmt: skip
SIGNS: tuple[Sign, ...] = tuple(
    Sign(part, endings, re.compile(pattern), for_, ros_version, why, here, strict)
    for part, endings, pattern, for_, ros_version, why, here, strict in _ROWS
)
