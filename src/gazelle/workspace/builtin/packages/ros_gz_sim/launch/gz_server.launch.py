"""A world of the new Gazebo as a node, in place of one in a container."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription

ARGUMENTS = [
    ("world_sdf_file", "", "path of the world"),
    ("world_sdf_string", "", "text of the world"),
    ("container_name", "ros_gz_container", "accepted; the world is a process of its own"),
    ("create_own_container", "False", "accepted; the world is a process of its own"),
    ("use_composition", "False", "accepted; the world is a process of its own"),
]


def generate_launch_description():
    """Return the arguments and the node."""
    names = ("world_sdf_file", "world_sdf_string")
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=value, description=text)
                for name, value, text in ARGUMENTS
            ),
            Node(
                package="ros_gz_sim",
                executable="gzserver",
                output="screen",
                parameters=[{name: LaunchConfiguration(name) for name in names}],
            ),
        ]
    )
