"""A robot with movable joints, shown."""

from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return the arguments, the description, joints and view."""
    share = FindPackageShare("urdf_launch")
    description = PathJoinSubstitution([share, "launch", "description.launch.py"])
    config = PathJoinSubstitution([share, "config", "urdf.rviz"])
    names = ("urdf_package", "urdf_package_path")
    return LaunchDescription(
        [
            DeclareLaunchArgument("urdf_package", description="package with the robot"),
            DeclareLaunchArgument("urdf_package_path", description="its file in the package"),
            DeclareLaunchArgument("rviz_config", default_value=config, description="view"),
            DeclareLaunchArgument("jsp_gui", default_value="true", description="sliders or not"),
            IncludeLaunchDescription(
                description,
                launch_arguments=[(name, LaunchConfiguration(name)) for name in names],
            ),
            _joints("joint_state_publisher", UnlessCondition(LaunchConfiguration("jsp_gui"))),
            _joints("joint_state_publisher_gui", IfCondition(LaunchConfiguration("jsp_gui"))),
            Node(
                package="rviz2",
                executable="rviz2",
                output="screen",
                arguments=["-d", LaunchConfiguration("rviz_config")],
            ),
        ]
    )


def _joints(name, condition):
    return Node(package=name, executable=name, condition=condition)
