"""One pose from several sources."""

from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return the node with its file of parameters."""
    file = PathJoinSubstitution([FindPackageShare("robot_localization"), "params", "ekf.yaml"])
    return LaunchDescription(
        [
            Node(
                package="robot_localization",
                executable="ekf_node",
                name="ekf_filter_node",
                output="screen",
                parameters=[file],
            )
        ]
    )
