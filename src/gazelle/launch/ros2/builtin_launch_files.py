"""What several launch files of built-in packages are, each under its own name."""

from __future__ import annotations

from gazelle.launch.ros2.actions import DeclareLaunchArgument
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_ros.actions import Node
from gazelle.launch.ros2.launch_ros.substitutions import FindPackageShare
from gazelle.launch.ros2.substitutions import LaunchConfiguration, PathJoinSubstitution

__all__ = ["slam_toolbox", "twist_mux"]

_SLAM_ARGUMENTS = (
    ("use_sim_time", "true", "follow /clock"),
    ("autostart", "true", "accepted; the node begins at once"),
    ("use_lifecycle_manager", "false", "accepted; the node begins at once"),
)
_MUX_FILES = {
    "config_topics": "twist_mux_topics.yaml",
    "config_locks": "twist_mux_locks.yaml",
    "config_joy": "joystick.yaml",
}


def slam_toolbox(executable: str, parameters: str) -> LaunchDescription:
    """Return the arguments and the node of one of slam_toolbox's launch files.

    Args:
        executable: of slam_toolbox.
        parameters: name of its file in the folder ``config``.
    """
    file = PathJoinSubstitution([FindPackageShare("slam_toolbox"), "config", parameters])
    text = "file of parameters"
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=value, description=about)
                for name, value, about in _SLAM_ARGUMENTS
            ),
            DeclareLaunchArgument("slam_params_file", default_value=file, description=text),
            Node(
                package="slam_toolbox",
                executable=executable,
                name="slam_toolbox",
                output="screen",
                parameters=[
                    LaunchConfiguration("slam_params_file"),
                    {"use_sim_time": LaunchConfiguration("use_sim_time")},
                ],
            ),
        ]
    )


def twist_mux() -> LaunchDescription:
    """Return the arguments and the three nodes of twist_mux's launch file."""
    share = FindPackageShare("twist_mux")
    output = LaunchConfiguration("cmd_vel_out")
    clock = {"use_sim_time": LaunchConfiguration("use_sim_time")}
    files = [
        DeclareLaunchArgument(name, default_value=PathJoinSubstitution([share, "config", file]))
        for name, file in _MUX_FILES.items()
    ]
    return LaunchDescription(
        [
            *files,
            DeclareLaunchArgument("cmd_vel_out", default_value="twist_mux/cmd_vel"),
            DeclareLaunchArgument("use_sim_time", default_value="False"),
            Node(
                package="twist_mux",
                executable="twist_mux",
                output="screen",
                remappings=[("/cmd_vel_out", output)],
                parameters=[
                    clock,
                    LaunchConfiguration("config_locks"),
                    LaunchConfiguration("config_topics"),
                ],
            ),
            Node(
                package="twist_mux",
                executable="twist_marker",
                output="screen",
                remappings=[("/twist", output)],
                parameters=[clock, {"frame_id": "base_link"}],
            ),
            Node(
                package="twist_mux",
                executable="joystick_relay.py",
                output="screen",
                remappings=[("joy_vel_in", "input_joy/cmd_vel"), ("joy_vel_out", "joy_vel")],
                parameters=[clock, LaunchConfiguration("config_joy")],
            ),
        ]
    )
