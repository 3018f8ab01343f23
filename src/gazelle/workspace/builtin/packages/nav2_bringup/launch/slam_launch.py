"""A map made while the robot drives: slam_toolbox, and what saves the map."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch.actions import GroupAction, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import Node, SetRemap
from nav2_common.bringup import (
    RELATIVE_TF,
    arguments,
    configured,
    is_true,
    lifecycle_manager,
    section_names,
    value_of,
)

from launch import LaunchDescription

NAMES = ("namespace", "params_file", "use_respawn", "log_level")
OWN = {"use_sim_time": "True", "autostart": "True"}
RELATIVE = (*RELATIVE_TF, ("/scan", "scan"), ("/map", "map"))


def generate_launch_description():
    """Return the arguments and the nodes."""
    return LaunchDescription(
        [*arguments(*NAMES, *OWN, **OWN), OpaqueFunction(function=_start)],
    )


def _start(context):
    log = ["--ros-args", "--log-level", value_of(context, "log_level")]
    sim = is_true(context, "use_sim_time")
    autostart = is_true(context, "autostart")
    saver = Node(
        package="nav2_map_server",
        executable="map_saver_server",
        output="screen",
        respawn=is_true(context, "use_respawn"),
        respawn_delay=2.0,
        arguments=log,
        parameters=[configured(context), {"use_sim_time": sim}],
        remappings=list(RELATIVE_TF),
    )
    managing = {"use_sim_time": sim, "autostart": autostart, "node_names": ["map_saver"]}
    return [saver, lifecycle_manager("lifecycle_manager_slam", managing, log), _slam(context)]


def _slam(context):
    folder = Path(get_package_share_directory("slam_toolbox")) / "launch"
    given = {"use_sim_time": value_of(context, "use_sim_time")}
    if "slam_toolbox" in section_names(context):
        given["slam_params_file"] = value_of(context, "params_file")
    file = PythonLaunchDescriptionSource(str(folder / "online_sync_launch.py"))
    return GroupAction(
        [
            *(SetRemap(src=absolute, dst=relative) for absolute, relative in RELATIVE),
            IncludeLaunchDescription(file, launch_arguments=given.items()),
        ]
    )
