"""A bridge as a node, in place of one in a container."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription

ARGUMENTS = [
    ("bridge_name", None, "name of the node"),
    ("config_file", None, "file that says what is bridged"),
    ("namespace", "", "of the node"),
    ("container_name", "ros_gz_container", "accepted; the bridge is a node of its own"),
    ("create_own_container", "False", "accepted; the bridge is a node of its own"),
    ("use_composition", "False", "accepted; the bridge is a node of its own"),
    ("use_respawn", "False", "start it again when it ends"),
    ("log_level", "info", "least level that is logged"),
]


def generate_launch_description():
    """Return the arguments and the node."""
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=value, description=text)
                for name, value, text in ARGUMENTS
            ),
            Node(
                package="ros_gz_bridge",
                executable="bridge_node",
                name=LaunchConfiguration("bridge_name"),
                namespace=LaunchConfiguration("namespace"),
                output="screen",
                respawn=LaunchConfiguration("use_respawn"),
                respawn_delay=2.0,
                parameters=[{"config_file": LaunchConfiguration("config_file")}],
                ros_arguments=["--log-level", LaunchConfiguration("log_level")],
            ),
        ]
    )
