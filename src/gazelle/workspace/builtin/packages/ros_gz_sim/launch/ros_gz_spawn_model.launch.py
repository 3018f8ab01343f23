"""A model put into the running world, and a bridge for it."""

from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

ARGUMENTS = [
    ("bridge_name", None, "name of the bridge"),
    ("config_file", None, "file that says what is bridged"),
    ("namespace", "", "of the bridge"),
    ("container_name", "ros_gz_container", "accepted; the bridge is a node of its own"),
    ("use_composition", "True", "accepted; the bridge is a node of its own"),
    ("use_respawn", "False", "start the bridge again when it ends"),
    ("log_level", "info", "least level that the bridge logs"),
    ("world", "", "name of the world"),
    ("file", "", "path of the model"),
    ("model_string", "", "text of the model"),
    ("topic", "", "topic with the model's text"),
    ("entity_name", "", "name in the world"),
    ("allow_renaming", "False", "whether a name that is taken gets a number"),
]
OF_THE_BRIDGE = ("bridge_name", "config_file", "namespace", "use_respawn", "log_level")
OF_THE_MODEL = ("world", "file", "model_string", "topic", "entity_name", "allow_renaming")
POSE = ("x", "y", "z", "R", "P", "Y")


def include(package, file, arguments):
    """Return the inclusion of a package's launch file."""
    path = PathJoinSubstitution([FindPackageShare(package), "launch", file])
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(path), launch_arguments=list(arguments.items())
    )


def generate_launch_description():
    """Return the arguments, the bridge and what puts the model into the world."""
    bridge = {name: LaunchConfiguration(name) for name in OF_THE_BRIDGE}
    model = {name: LaunchConfiguration(name) for name in OF_THE_MODEL}
    model |= {name: LaunchConfiguration(name, default="0.0") for name in POSE}
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=value, description=text)
                for name, value, text in ARGUMENTS
            ),
            include("ros_gz_bridge", "ros_gz_bridge.launch.py", bridge),
            include("ros_gz_sim", "gz_spawn_model.launch.py", model),
        ]
    )
