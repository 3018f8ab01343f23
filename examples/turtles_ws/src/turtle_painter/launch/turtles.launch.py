"""The canvas of turtlesim, and the program whose turtles paint on it."""

from launch_ros.actions import Node

from launch import LaunchDescription


def generate_launch_description():
    return LaunchDescription(
        [
            Node(
                package="turtlesim",
                executable="turtlesim_node",
                name="turtlesim",
                parameters=[{"background_r": 20, "background_g": 40, "background_b": 60}],
            ),
            Node(package="turtle_painter", executable="paint", output="screen"),
        ]
    )
