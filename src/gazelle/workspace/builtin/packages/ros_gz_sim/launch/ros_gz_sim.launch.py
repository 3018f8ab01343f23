"""A world of the new Gazebo and a bridge to it."""

from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare

from launch import LaunchDescription

ARGUMENTS = [
    ("bridge_name", None, "name of the bridge"),
    ("config_file", None, "file that says what is bridged"),
    ("namespace", "", "of the bridge"),
    ("container_name", "ros_gz_container", "accepted; each is a process of its own"),
    ("create_own_container", "False", "accepted; each is a process of its own"),
    ("use_composition", "False", "accepted; each is a process of its own"),
    ("use_respawn", "False", "start the bridge again when it ends"),
    ("bridge_log_level", "info", "least level that the bridge logs"),
    ("world_sdf_file", "", "path of the world"),
    ("world_sdf_string", "", "text of the world"),
]
OF_THE_WORLD = ("world_sdf_file", "world_sdf_string")
OF_THE_BRIDGE = ("bridge_name", "config_file", "namespace", "use_respawn")


def include(package, file, arguments):
    """Return the inclusion of a package's launch file."""
    path = PathJoinSubstitution([FindPackageShare(package), "launch", file])
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(path), launch_arguments=list(arguments.items())
    )


def generate_launch_description():
    """Return the arguments, the world and the bridge."""
    world = {name: LaunchConfiguration(name) for name in OF_THE_WORLD}
    bridge = {name: LaunchConfiguration(name) for name in OF_THE_BRIDGE}
    bridge["log_level"] = LaunchConfiguration("bridge_log_level")
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=value, description=text)
                for name, value, text in ARGUMENTS
            ),
            include("ros_gz_sim", "gz_server.launch.py", world),
            include("ros_gz_bridge", "ros_gz_bridge.launch.py", bridge),
        ]
    )
