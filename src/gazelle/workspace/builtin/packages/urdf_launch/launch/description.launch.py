"""A robot's description, published."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return the arguments and robot_state_publisher."""
    share = FindPackageShare(LaunchConfiguration("urdf_package"))
    file = PathJoinSubstitution([share, LaunchConfiguration("urdf_package_path")])
    text = ParameterValue(Command(["xacro ", file]), value_type=str)
    return LaunchDescription(
        [
            DeclareLaunchArgument("urdf_package", description="package with the robot"),
            DeclareLaunchArgument("urdf_package_path", description="its file in the package"),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": text}],
            ),
        ]
    )
