"""A joystick's axes and buttons."""

from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return the node, whose end ends the launch."""
    file = PathJoinSubstitution([FindPackageShare("joy"), "config", "joy-params.yaml"])
    node = Node(package="joy", executable="joy_node", output="both", parameters=[file])
    return LaunchDescription([node])
