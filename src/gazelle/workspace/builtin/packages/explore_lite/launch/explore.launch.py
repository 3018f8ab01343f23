"""Drives to where the map ends."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return the arguments and the node."""
    file = PathJoinSubstitution([FindPackageShare("explore_lite"), "config", "params.yaml"])
    return LaunchDescription(
        [
            DeclareLaunchArgument("use_sim_time", default_value="true", description="/clock"),
            DeclareLaunchArgument("namespace", default_value="", description="of the node"),
            Node(
                package="explore_lite",
                executable="explore",
                name="explore_node",
                namespace=LaunchConfiguration("namespace"),
                output="screen",
                parameters=[file, {"use_sim_time": LaunchConfiguration("use_sim_time")}],
            ),
        ]
    )
