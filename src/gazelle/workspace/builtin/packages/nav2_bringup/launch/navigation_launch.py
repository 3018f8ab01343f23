"""Nav2 without localisation: planning, control, behaviours, waypoints."""

from launch.actions import OpaqueFunction, SetEnvironmentVariable
from nav2_common.bringup import (
    arguments,
    log_absent_nodes,
    navigation_nodes,
    section_names,
    started,
)

from launch import LaunchDescription

NAMES = (
    "namespace",
    "use_sim_time",
    "params_file",
    "autostart",
    "use_composition",
    "container_name",
    "use_respawn",
    "log_level",
)


def generate_launch_description():
    """Return the arguments and the nodes."""
    return LaunchDescription(
        [
            SetEnvironmentVariable("RCUTILS_LOGGING_BUFFERED_STREAM", "1"),
            *arguments(*NAMES),
            OpaqueFunction(function=_start),
        ]
    )


def _start(context):
    sections = section_names(context)
    rows = navigation_nodes(sections)
    return [*log_absent_nodes(sections), *started(context, rows, "lifecycle_manager_navigation")]
