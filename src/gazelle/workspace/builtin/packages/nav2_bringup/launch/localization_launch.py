"""Nav2's localisation in a map that is there already."""

from launch.actions import OpaqueFunction, SetEnvironmentVariable
from nav2_common.bringup import Managed, arguments, started, value_of

from launch import LaunchDescription

NAMES = (
    "namespace",
    "map",
    "use_sim_time",
    "params_file",
    "autostart",
    "use_composition",
    "container_name",
    "use_respawn",
    "log_level",
)
NODES = (
    Managed("nav2_map_server", "map_server", "nav2_map_server::MapServer", "map_server"),
    Managed("nav2_amcl", "amcl", "nav2_amcl::AmclNode", "amcl"),
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
    path = value_of(context, "map")
    # A file of parameters may have nothing for map_server.
    extra = {"map_server": {"yaml_filename": path}} if path else {}
    return started(context, NODES, "lifecycle_manager_localization", extra)
