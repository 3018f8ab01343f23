"""All of Nav2 for one robot: localisation or SLAM, and navigation."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch.actions import (
    GroupAction,
    IncludeLaunchDescription,
    OpaqueFunction,
    SetEnvironmentVariable,
)
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import Node, PushRosNamespace
from nav2_common.bringup import (
    RELATIVE_TF,
    arguments,
    configured,
    is_true,
    value_of,
)
from nav2_common.launch import ReplaceString

from launch import LaunchDescription

NAMES = (
    "namespace",
    "use_namespace",
    "slam",
    "map",
    "use_localization",
    "use_sim_time",
    "params_file",
    "autostart",
    "use_respawn",
    "log_level",
)
OWN = {"use_composition": "True"}
PASSED = ("namespace", "use_sim_time", "autostart", "use_respawn", "params_file", "log_level")


def generate_launch_description():
    """Return the arguments and what is started."""
    return LaunchDescription(
        [
            SetEnvironmentVariable("RCUTILS_LOGGING_BUFFERED_STREAM", "1"),
            *arguments(*NAMES, *OWN, **OWN),
            OpaqueFunction(function=_start),
        ]
    )


def _start(context):
    given = {name: value_of(context, name) for name in PASSED}
    composing = {
        "use_composition": value_of(context, "use_composition"),
        "container_name": "nav2_container",
    }
    if is_true(context, "use_namespace"):
        # Files for several robots name the robot's topics by this word.
        replaced = ReplaceString(
            source_file=given["params_file"],
            replacements={"<robot_namespace>": f"/{given['namespace'].strip('/')}"},
        )
        given["params_file"] = replaced.perform(context)
    parts = []
    if is_true(context, "use_composition"):
        parts.append(_container(context))
    if is_true(context, "use_localization"):
        if is_true(context, "slam"):
            parts.append(_included("slam", given))
        else:
            own = {**given, **composing, "map": value_of(context, "map")}
            parts.append(_included("localization", own))
    parts.append(_included("navigation", {**given, **composing}))
    if is_true(context, "use_namespace"):
        parts.insert(0, PushRosNamespace(given["namespace"]))
    return [GroupAction(parts)]


def _container(context):
    return Node(
        name="nav2_container",
        package="rclcpp_components",
        executable="component_container_isolated",
        parameters=[configured(context), {"autostart": is_true(context, "autostart")}],
        arguments=["--ros-args", "--log-level", value_of(context, "log_level")],
        remappings=list(RELATIVE_TF),
        output="screen",
    )


def _included(name, given):
    folder = Path(get_package_share_directory("nav2_bringup")) / "launch"
    file = PythonLaunchDescriptionSource(str(folder / f"{name}_launch.py"))
    return IncludeLaunchDescription(file, launch_arguments=given.items())
