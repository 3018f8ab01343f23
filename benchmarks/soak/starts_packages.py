"""Writes the two small packages that `starts.py` launches beside the examples."""

from __future__ import annotations

from pathlib import Path

__all__ = ["write_classic", "write_gz"]

_ROBOT = """\
<?xml version="1.0"?>
<robot name="{name}">
  <link name="base_link">
    <inertial>
      <origin xyz="0 0 0.05"/>
      <mass value="4"/>
      <inertia ixx="0.03" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.07"/>
    </inertial>
    <visual><origin xyz="0 0 0.05"/><geometry><box size="0.4 0.24 0.08"/></geometry></visual>
    <collision><origin xyz="0 0 0.05"/><geometry><box size="0.4 0.24 0.08"/></geometry></collision>
  </link>
{wheels}
  <ros2_control name="{name}" type="system">
    <hardware><plugin>{hardware}</plugin></hardware>
{joints}
  </ros2_control>
  <gazebo>
    <plugin filename="{library}" name="{plugin}">
      <parameters>{controllers}</parameters>
    </plugin>
  </gazebo>
</robot>
"""
_WHEEL = """\
  <link name="{name}_wheel">
    <inertial>
      <mass value="0.5"/>
      <inertia ixx="0.0008" ixy="0" ixz="0" iyy="0.0012" iyz="0" izz="0.0008"/>
    </inertial>
    <collision>
      <origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.07" length="0.04"/></geometry>
    </collision>
  </link>
  <joint name="{name}_wheel_joint" type="continuous">
    <parent link="base_link"/><child link="{name}_wheel"/>
    <origin xyz="{x} {y} 0"/><axis xyz="0 1 0"/>
  </joint>"""
_WHEELS = (
    ("front_left", 0.13, 0.15),
    ("front_right", 0.13, -0.15),
    ("rear_left", -0.13, 0.15),
    ("rear_right", -0.13, -0.15),
)
_JOINT = """\
    <joint name="{name}_wheel_joint">
      <command_interface name="velocity"/>
      <state_interface name="position"/>
      <state_interface name="velocity"/>
    </joint>"""
_CONTROLLERS = """\
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster:
      type: joint_state_broadcaster/JointStateBroadcaster
    drive_controller:
      type: diff_drive_controller/DiffDriveController

drive_controller:
  ros__parameters:
    left_wheel_names: [front_left_wheel_joint, rear_left_wheel_joint]
    right_wheel_names: [front_right_wheel_joint, rear_right_wheel_joint]
    wheel_separation: 0.3
    wheel_radius: 0.07
"""
_PACKAGE = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>A cart with four wheels.</description>
  <maintainer email="someone@example.com">Someone</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <exec_depend>robot_state_publisher</exec_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
_CMAKE = """\
cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
install(DIRECTORY config launch urdf worlds DESTINATION share/${{PROJECT_NAME}})
ament_package()
"""
_HEAD = '''\
"""The cart in its world with two controllers."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import Node


def generate_launch_description():
    share = Path(get_package_share_directory("{name}"))
    text = (share / "urdf" / "{name}.urdf").read_text().replace("SHARE", str(share))
    state_publisher = Node(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        output="screen",
        parameters=[{{"robot_description": text, "use_sim_time": True}}],
    )
    spawners = [
        Node(package="controller_manager", executable="spawner", arguments=[one], output="screen")
        for one in ("joint_state_broadcaster", "drive_controller")
    ]
'''
_CLASSIC_TAIL = """\
    folder = Path(get_package_share_directory("gazebo_ros"))
    source = PythonLaunchDescriptionSource(str(folder / "launch" / "gazebo.launch.py"))
    gazebo = IncludeLaunchDescription(source, launch_arguments={"gui": "false"}.items())
    spawn = Node(
        package="gazebo_ros",
        executable="spawn_entity.py",
        arguments=["-topic", "robot_description", "-entity", "starling", "-z", "0.1"],
        output="screen",
    )
    return LaunchDescription([gazebo, state_publisher, spawn, *spawners])
"""
_GZ_TAIL = """\
    folder = Path(get_package_share_directory("ros_gz_sim"))
    source = PythonLaunchDescriptionSource(str(folder / "launch" / "gz_sim.launch.py"))
    world = share / "worlds" / "floor.sdf"
    gazebo = IncludeLaunchDescription(
        source, launch_arguments={"gz_args": f"-r -s -v 1 {world}"}.items()
    )
    create = Node(
        package="ros_gz_sim",
        executable="create",
        arguments=["-topic", "robot_description", "-name", "wagtail", "-z", "0.1",
                   "-allow_renaming", "true"],
        output="screen",
    )
    bridge = Node(
        package="ros_gz_bridge",
        executable="parameter_bridge",
        arguments=["/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock"],
        output="screen",
    )
    first = OnProcessExit(target_action=create, on_exit=[spawners[0]])
    second = OnProcessExit(target_action=spawners[0], on_exit=[spawners[1]])
    return LaunchDescription([
        gazebo,
        RegisterEventHandler(first),
        RegisterEventHandler(second),
        bridge,
        state_publisher,
        create,
    ])
"""
_WORLD = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="floor">
    <physics name="1ms" type="ignored">
      <max_step_size>0.001</max_step_size>
      <real_time_factor>1.0</real_time_factor>
    </physics>
    <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics"/>
    <plugin filename="gz-sim-user-commands-system" name="gz::sim::systems::UserCommands"/>
    <plugin filename="gz-sim-scene-broadcaster-system" name="gz::sim::systems::SceneBroadcaster"/>
    <model name="ground">
      <static>true</static>
      <link name="link">
        <collision name="collision">
          <geometry><plane><normal>0 0 1</normal><size>50 50</size></plane></geometry>
        </collision>
      </link>
    </model>
  </world>
</sdf>
"""


def write_classic(workspace: Path) -> Path:
    """Write a cart for Gazebo Classic with gazebo_ros2_control; return the workspace."""
    return _write(
        workspace,
        "starling",
        hardware="gazebo_ros2_control/GazeboSystem",
        library="libgazebo_ros2_control.so",
        plugin="gazebo_ros2_control",
        tail=_CLASSIC_TAIL,
    )


def write_gz(workspace: Path) -> Path:
    """Write a cart for gz-sim with gz_ros2_control; return the workspace."""
    return _write(
        workspace,
        "wagtail",
        hardware="gz_ros2_control/GazeboSimSystem",
        library="gz_ros2_control-system",
        plugin="gz_ros2_control::GazeboSimROS2ControlPlugin",
        tail=_GZ_TAIL,
    )


def _write(
    workspace: Path, name: str, *, hardware: str, library: str, plugin: str, tail: str
) -> Path:
    package = workspace / "src" / name
    wheels = "\n".join(_WHEEL.format(name=one, x=x, y=y) for one, x, y in _WHEELS)
    joints = "\n".join(_JOINT.format(name=one) for one, _, _ in _WHEELS)
    robot = _ROBOT.format(
        name=name,
        wheels=wheels,
        joints=joints,
        hardware=hardware,
        library=library,
        plugin=plugin,
        controllers="SHARE/config/controllers.yaml",
    )
    files = {
        "package.xml": _PACKAGE.format(name=name),
        "CMakeLists.txt": _CMAKE.format(name=name),
        f"urdf/{name}.urdf": robot,
        "config/controllers.yaml": _CONTROLLERS,
        "worlds/floor.sdf": _WORLD,
        f"launch/{name}.launch.py": _HEAD.format(name=name) + tail,
    }
    for path, text in files.items():
        (package / path).parent.mkdir(parents=True, exist_ok=True)
        (package / path).write_text(text, encoding="utf-8")
    return workspace
