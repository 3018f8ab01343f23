"""Puts a model into the running world."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import LaunchDescription

# Arguments and the parameters of create that they are.
TEXTS = {
    "world": ("world", "name of the world"),
    "file": ("file", "path of the model"),
    "model_string": ("string", "text of the model"),
    "topic": ("topic", "topic with the model's text"),
    "entity_name": ("name", "name in the world"),
}
NUMBERS = ("x", "y", "z", "R", "P", "Y")


def generate_launch_description():
    """Return the arguments and the node."""
    values = {
        name: ParameterValue(LaunchConfiguration(argument), value_type=str)
        for argument, (name, _text) in TEXTS.items()
    }
    for name in NUMBERS:
        values[name] = ParameterValue(LaunchConfiguration(name, default="0.0"), value_type=float)
    renaming = LaunchConfiguration("allow_renaming")
    values["allow_renaming"] = ParameterValue(renaming, value_type=bool)
    text = "whether a name that is taken gets a number"
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value="", description=about)
                for name, (_name, about) in TEXTS.items()
            ),
            DeclareLaunchArgument("allow_renaming", default_value="False", description=text),
            Node(package="ros_gz_sim", executable="create", output="screen", parameters=[values]),
        ]
    )
