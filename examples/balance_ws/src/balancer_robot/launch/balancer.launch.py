"""Starts the court, the robot in it, its wheel controller, and the node that keeps it up."""

import os

import xacro
from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from launch import LaunchDescription


def generate_launch_description():
    share = get_package_share_directory("balancer_robot")
    world = os.path.join(share, "worlds", "court.world")
    robot = xacro.process_file(os.path.join(share, "urdf", "balancer.urdf.xacro")).toxml()
    gazebo = os.path.join(get_package_share_directory("gazebo_ros"), "launch", "gazebo.launch.py")
    spawn = Node(
        package="gazebo_ros",
        executable="spawn_entity.py",
        arguments=["-topic", "robot_description", "-entity", "balancer"],
        output="screen",
    )
    controllers = Node(
        package="controller_manager",
        executable="spawner",
        arguments=["joint_state_broadcaster", "wheel_controller"],
        output="screen",
    )
    return LaunchDescription(
        [
            DeclareLaunchArgument("gui", default_value="false", description="open Gazebo's window"),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(gazebo),
                launch_arguments={"world": world, "gui": LaunchConfiguration("gui")}.items(),
            ),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": robot, "use_sim_time": True}],
            ),
            spawn,
            RegisterEventHandler(OnProcessExit(target_action=spawn, on_exit=[controllers])),
            Node(
                package="balancer_robot",
                executable="balance",
                name="balance",
                parameters=[os.path.join(share, "config", "balance.yaml"), {"use_sim_time": True}],
                output="screen",
            ),
        ]
    )
