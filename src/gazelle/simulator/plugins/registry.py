"""Which plug-in a library or system name means."""

from __future__ import annotations

import re
from collections.abc import Callable
from difflib import SequenceMatcher
from functools import cache
from importlib import import_module

from gazelle.description.model import PluginTag
from gazelle.diagnostics import nearest_names
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginTable

__all__ = ["all_tables", "known_names", "load_plugin", "looked_up", "plain_name"]

Load = Callable[[PluginContext], None]

_SLIP = 0.92
_COMMON_BEGIN = "gazebo_ros_"
_MIN_LIKENESS = 0.8
# sdformat's word for a missing file name; Gazebo passes over such a plug-in.
_NO_PLUGIN = "__default__"
_RELEASE = re.compile(r"^(gz-sim|ignition-gazebo)\d+(?=-)")

# Module, table, load function; imported when a robot names one of them.
_FAMILIES = (
    ("diff_drive", "TABLE", "load"),
    ("laser", "TABLE", "load"),
    ("laser", "ROS2_TABLE", "load_ray_sensor"),
    ("camera", "CAMERA_TABLE", "load"),
    ("camera", "TRIGGERED_TABLE", "load_triggered"),
    ("depth_camera", "OPENNI_TABLE", "load_openni"),
    ("depth_camera", "DEPTH_TABLE", "load"),
    ("imu", "TABLE", "load"),
    ("imu", "SENSOR_TABLE", "load_sensor"),
    ("hector_imu", "TABLE", "load"),
    ("joint_state_publisher", "TABLE", "load"),
    ("p3d", "TABLE", "load"),
    ("gz_diff_drive", "GZ_TABLE", "load"),
    ("joint_state_publisher", "GZ_TABLE", "load_gz"),
    ("gz_builtin_systems", "TABLE", "load"),
    ("gz_builtin_systems", "SERVER_TABLE", "load"),
    ("gazebo_ros_state", "STATE_TABLE", "load_state"),
    ("gazebo_ros_state", "PROPERTIES_TABLE", "load_properties"),
    ("ros_control", "TABLE", "load"),
    ("ros2_control", "TABLE", "load"),
    ("ros2_control", "GZ_TABLE", "load_gz"),
    ("bumper", "TABLE", "load"),
    ("ft_sensor", "TABLE", "load"),
    ("ft_sensor", "F3D_TABLE", "load_f3d"),
    ("gps", "TABLE", "load"),
    ("gps", "HECTOR_TABLE", "load_hector"),
    ("magnetometer", "TABLE", "load"),
    ("magnetometer", "BARO_TABLE", "load_baro"),
    ("range", "TABLE", "load"),
    ("range", "HECTOR_TABLE", "load_hector"),
    ("multicamera", "TABLE", "load"),
    ("block_laser", "TABLE", "load"),
    ("skid_steer", "TABLE", "load"),
    ("planar_move", "TABLE", "load"),
    ("velocity_control", "TABLE", "load"),
    ("ackermann", "TABLE", "load"),
    ("gz_ackermann", "GZ_TABLE", "load"),
    ("tricycle", "TABLE", "load"),
    ("wheel_slip", "TABLE", "load"),
    ("wheel_slip", "GAZEBO_TABLE", "load_gazebo"),
    ("wheel_slip", "GZ_TABLE", "load_gz"),
    ("force", "TABLE", "load"),
    ("apply_link_wrench", "TABLE", "load"),
    ("gz_joints", "FORCE_TABLE", "load_force"),
    ("gz_joints", "VELOCITY_TABLE", "load_velocity"),
    ("gz_joints", "POSITION_TABLE", "load_position"),
    ("gz_joint_trajectory", "TRAJECTORY_TABLE", "load"),
    ("vacuum_gripper", "TABLE", "load"),
    ("hand_of_god", "TABLE", "load"),
    ("joint_pose_trajectory", "TABLE", "load"),
    ("mimic_joint", "TABLE", "load"),
    ("gz_odometry", "TABLE", "load"),
    ("gz_odometry", "POSE_TABLE", "load_poses"),
    ("unsupported_plugins", "TABLE", "load"),
    ("unsupported_plugins", "NOTHING_TABLE", "load_nothing"),
)


@cache
def _by_name() -> dict[str, tuple[PluginTable, Load]]:
    found: dict[str, tuple[PluginTable, Load]] = {}
    for module_name, table_name, load_name in _FAMILIES:
        module = import_module(f"gazelle.simulator.plugins.{module_name}")
        table: PluginTable = getattr(module, table_name)
        load: Load = getattr(module, load_name)
        for name in table.parameters.types:
            found[plain_name(name)] = (table, load)
    return found


def plain_name(filename: str) -> str:
    """Return a library's name without folder, ``lib`` and ``.so``, in lower case.

    ``gz-sim7-…`` and ``ignition-gazebo6-…`` lose the number of the release they belong to.
    """
    name = filename.strip().rsplit("/", 1)[-1]
    for ending in (".so", ".dylib", ".dll"):
        name = name.removesuffix(ending)
    return _RELEASE.sub(r"\1", name.removeprefix("lib").lower())


def looked_up(plugin: PluginTag) -> tuple[str, ...]:
    """Return the plain names that say what a plug-in is: its library, then its class.

    In Gazebo Classic ``name`` is a word of the user's own, whatever it looks like; gz-sim's
    is the system's class.
    """
    library = plain_name(plugin.filename)
    return (library, plain_name(plugin.name)) if "::" in plugin.name else (library,)


def all_tables() -> tuple[PluginTable, ...]:
    """Return every table, in the order of the documentation."""
    tables: dict[str, PluginTable] = {}
    for table, _ in _by_name().values():
        tables.setdefault(table.parameters.family, table)
    return tuple(tables.values())


def known_names() -> tuple[str, ...]:
    """Return every name that means a plug-in Gazelle has."""
    return tuple(sorted(_by_name()))


def load_plugin(context: PluginContext) -> bool:
    """Start a plug-in; an unknown one is reported by name and place, and False is returned.

    A plug-in is looked up by its ``filename``, a gz-sim one then by its ``name``, the class.
    Then a plug-in of the user's own in Python is looked for.
    """
    plugin = context.plugin
    if plugin.filename == _NO_PLUGIN:
        return True
    for name in looked_up(plugin):
        found = _by_name().get(name)
        if found is not None:
            found[1](context)
            return True
    from gazelle.simulator.plugins.user.finder import python_plugin_names
    from gazelle.simulator.plugins.user.loader import load_user_plugin, report_compiled

    if load_user_plugin(context):
        return True
    if plugin.filename and report_compiled(context):
        return False
    name = plain_name(plugin.filename)
    text = f"plug-in '{plugin.filename}' (name '{plugin.name}') of {context.owner} is "
    text += "compiled code that Gazelle does not have: what it does in Gazebo does not happen here"
    own = python_plugin_names(context.host.workspace)
    near = nearest_names(name, [*own, *_alike(name)])
    as_written = plugin.filename.replace(name, "{}", 1) if name else "{}"
    slips = " or ".join(f"'{as_written.format(one)}'" for one in near)
    context.report("plugin.unknown", text, fix=f"did you mean {slips}?" if slips else "")
    return False


def _alike(name: str) -> list[str]:
    """Return known names that a name may be a slip for: half of all share ``gazebo_ros_``."""
    return [
        known
        for known in known_names()
        if f"_{known}_" in f"_{name}_" or _likeness(name, known) >= _MIN_LIKENESS
    ]


def _likeness(name: str, known: str) -> float:
    # A slip in the common beginning is one, too.
    whole = SequenceMatcher(None, name, known).ratio()
    if whole >= _SLIP:
        return 1.0
    bare = [text.removeprefix(_COMMON_BEGIN) for text in (name, known)]
    return SequenceMatcher(None, bare[0], bare[1]).ratio()
