"""A scan out of a picture of depths."""

from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return the node with its file of parameters."""
    share = FindPackageShare("depthimage_to_laserscan")
    return LaunchDescription(
        [
            Node(
                package="depthimage_to_laserscan",
                executable="depthimage_to_laserscan_node",
                name="depthimage_to_laserscan",
                remappings=[("depth", "depth/image"), ("depth_camera_info", "depth/camera_info")],
                parameters=[PathJoinSubstitution([share, "cfg", "param.yaml"])],
            )
        ]
    )
