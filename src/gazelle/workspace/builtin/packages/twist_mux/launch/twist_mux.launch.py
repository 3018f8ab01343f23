"""Choosing among velocity commands, with the joystick's relay."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

FILES = {
    "config_topics": "twist_mux_topics.yaml",
    "config_locks": "twist_mux_locks.yaml",
    "config_joy": "joystick.yaml",
}


def generate_launch_description():
    """Return the arguments and the three nodes."""
    share = FindPackageShare("twist_mux")
    output = LaunchConfiguration("cmd_vel_out")
    clock = {"use_sim_time": LaunchConfiguration("use_sim_time")}
    files = [
        DeclareLaunchArgument(name, default_value=PathJoinSubstitution([share, "config", file]))
        for name, file in FILES.items()
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
