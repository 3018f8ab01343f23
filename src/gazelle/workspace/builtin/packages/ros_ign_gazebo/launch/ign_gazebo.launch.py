"""A world of the new Gazebo under its older name; see gz_sim.launch.py of ros_gz_sim."""

from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription


def generate_launch_description():
    """Return that file."""
    folder = FindPackageShare("ros_gz_sim")
    file = PathJoinSubstitution([folder, "launch", "gz_sim.launch.py"])
    return LaunchDescription([IncludeLaunchDescription(PythonLaunchDescriptionSource([file]))])
