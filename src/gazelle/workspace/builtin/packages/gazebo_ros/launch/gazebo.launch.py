"""A world and what shows it. Arguments of gzserver.launch.py and gzclient.launch.py count too."""

from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, ThisLaunchFileDir

from launch import LaunchDescription


def generate_launch_description():
    """Return the two halves, each with its switch."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("gui", default_value="true", description="show the world"),
            DeclareLaunchArgument("server", default_value="true", description="run the world"),
            _half("gzserver", "server"),
            _half("gzclient", "gui"),
        ]
    )


def _half(name, switch):
    source = PythonLaunchDescriptionSource([ThisLaunchFileDir(), f"/{name}.launch.py"])
    return IncludeLaunchDescription(source, condition=IfCondition(LaunchConfiguration(switch)))
