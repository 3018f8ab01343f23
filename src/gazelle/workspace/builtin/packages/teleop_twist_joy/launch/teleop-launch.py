"""Driving by a joystick."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return the arguments, the joystick and what makes velocities of it."""
    layout = [LaunchConfiguration("joy_config"), ".config.yaml"]
    file = PathJoinSubstitution([FindPackageShare("teleop_twist_joy"), "config", layout])
    joystick = {
        "device_id": LaunchConfiguration("joy_dev"),
        "deadzone": 0.3,
        "autorepeat_rate": 20.0,
    }
    stamped = ParameterValue(LaunchConfiguration("publish_stamped_twist"), value_type=bool)
    return LaunchDescription(
        [
            DeclareLaunchArgument("joy_vel", default_value="cmd_vel"),
            DeclareLaunchArgument("joy_config", default_value="ps3"),
            DeclareLaunchArgument("joy_dev", default_value="0"),
            DeclareLaunchArgument("publish_stamped_twist", default_value="false"),
            DeclareLaunchArgument("config_filepath", default_value=file),
            Node(package="joy", executable="joy_node", name="joy_node", parameters=[joystick]),
            Node(
                package="teleop_twist_joy",
                executable="teleop_node",
                name="teleop_twist_joy_node",
                parameters=[
                    LaunchConfiguration("config_filepath"),
                    {"publish_stamped_twist": stamped},
                ],
                remappings=[("/cmd_vel", LaunchConfiguration("joy_vel"))],
            ),
        ]
    )
