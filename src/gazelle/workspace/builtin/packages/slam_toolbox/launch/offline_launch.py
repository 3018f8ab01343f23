"""SLAM of a bag that is played."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

PARAMETERS = "mapper_params_offline.yaml"
ARGUMENTS = [
    ("use_sim_time", "true", "follow /clock"),
    ("autostart", "true", "accepted; the node begins at once"),
    ("use_lifecycle_manager", "false", "accepted; the node begins at once"),
]


def generate_launch_description():
    """Return the arguments and the node."""
    file = PathJoinSubstitution([FindPackageShare("slam_toolbox"), "config", PARAMETERS])
    text = "file of parameters"
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=value, description=about)
                for name, value, about in ARGUMENTS
            ),
            DeclareLaunchArgument("slam_params_file", default_value=file, description=text),
            Node(
                package="slam_toolbox",
                executable="sync_slam_toolbox_node",
                name="slam_toolbox",
                output="screen",
                parameters=[
                    LaunchConfiguration("slam_params_file"),
                    {"use_sim_time": LaunchConfiguration("use_sim_time")},
                ],
            ),
        ]
    )
