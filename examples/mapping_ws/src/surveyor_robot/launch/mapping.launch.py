"""The flat, the robot in it, SLAM and navigation: goals can be set while the map grows."""

import os

import xacro
from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription


def generate_launch_description():
    share = get_package_share_directory("surveyor_robot")
    world = os.path.join(share, "worlds", "flat.world")
    robot = xacro.process_file(os.path.join(share, "urdf", "surveyor.urdf.xacro")).toxml()
    sim_time = {"use_sim_time": True}
    return LaunchDescription(
        [
            DeclareLaunchArgument("gui", default_value="false", description="open Gazebo's window"),
            DeclareLaunchArgument("rviz", default_value="false", description="open RViz"),
            included("gazebo_ros", "gazebo.launch.py", world=world, gui=LaunchConfiguration("gui")),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": robot}, sim_time],
            ),
            Node(
                package="gazebo_ros",
                executable="spawn_entity.py",
                arguments=["-topic", "robot_description", "-entity", "surveyor"],
                output="screen",
            ),
            included(
                "nav2_bringup",
                "bringup_launch.py",
                slam="True",
                map="",
                use_sim_time="True",
                use_composition="True",
                params_file=os.path.join(share, "config", "navigation.yaml"),
            ),
            Node(
                package="rviz2",
                executable="rviz2",
                arguments=["-d", os.path.join(share, "rviz", "mapping.rviz")],
                parameters=[sim_time],
                condition=IfCondition(LaunchConfiguration("rviz")),
            ),
        ]
    )


def included(package, file, **arguments):
    """Return the launch file of another package, with its arguments."""
    path = os.path.join(get_package_share_directory(package), "launch", file)
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(path), launch_arguments=arguments.items()
    )
