"""What the launch files of the built-in package nav2_bringup are made of.

Arguments, their defaults, names of nodes and remappings are those of Nav2 from Humble to Jazzy.
Jazzy puts collision_monitor behind velocity_smoother, Humble and Iron do not: which of them a file
of parameters was written for is seen by whether it has some for collision_monitor.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.documents import read_text_limited
from gazelle.documents.yaml import load_yaml
from gazelle.launch.ros2.actions import DeclareLaunchArgument, LogInfo
from gazelle.launch.ros2.launch_ros.actions import LoadComposableNodes, Node
from gazelle.launch.ros2.launch_ros.descriptions import ComposableNode, ParameterFile
from gazelle.launch.ros2.nav2_common import RewrittenYaml
from gazelle.launch.ros2.substitutions import LaunchConfiguration
from gazelle.workspace.ament_index import get_package_share_directory

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "ABSENT",
    "RELATIVE_TF",
    "Managed",
    "arguments",
    "configured",
    "is_true",
    "lifecycle_manager",
    "log_absent_nodes",
    "navigation_nodes",
    "section_names",
    "started",
    "value_of",
]

Rules = tuple[tuple[str, str], ...]

RELATIVE_TF: Rules = (("/tf", "tf"), ("/tf_static", "tf_static"))
"""With these a namespace has transforms of its own."""

ABSENT = {
    "docking_server": "docking is not here; drive up to the dock by NavigateToPose",
    "route_server": "routes along graphs are not here; NavigateThroughPoses goes through poses",
    "loopback_simulator": "the loopback simulator is not here; a world with the robot is",
}
"""Nodes of newer Nav2s that are not here, and what does their work."""

_COMMANDS: Rules = (("cmd_vel", "cmd_vel_nav"),)
_LAST: Rules = (*_COMMANDS, ("cmd_vel_smoothed", "cmd_vel"))
_PARAMS = "params/nav2_params.yaml"
_ARGUMENTS = {
    "namespace": ("", "namespace of everything that is started"),
    "use_namespace": ("false", "whether the namespace is applied"),
    "slam": ("False", "make a map in place of reading one"),
    "map": ("", "path of the map's YAML; without it that of the parameters"),
    "use_localization": ("True", "whether localisation, or SLAM, is started"),
    "use_sim_time": ("false", "follow /clock"),
    "params_file": ("", "path of the file of parameters of all nodes"),
    "autostart": ("true", "bring the managed nodes up at once"),
    "use_composition": ("False", "all nodes in the one process of a container"),
    "container_name": ("nav2_container", "name of the container"),
    "use_respawn": ("False", "start a node again that ended; not in a container"),
    "log_level": ("info", "least level of what is logged"),
}


@dataclass(frozen=True)
class Managed:
    """A node that a lifecycle manager brings up.

    Attributes:
        package, executable: of its process.
        plugin: of it as a component.
        name: of the node.
        remappings: beyond those of tf.
    """

    package: str
    executable: str
    plugin: str
    name: str
    remappings: Rules = ()


def arguments(*names: str, **others: str) -> list[DeclareLaunchArgument]:
    """Return arguments by name, with defaults of Nav2's but for `others`."""
    made = []
    for name in names:
        default, about = _ARGUMENTS[name]
        if name == "params_file":
            default = str(Path(get_package_share_directory("nav2_bringup")) / _PARAMS)
        value = others.get(name, default)
        made.append(DeclareLaunchArgument(name, default_value=value, description=about))
    return made


def value_of(context: LaunchContext, name: str) -> str:
    """Return what an argument is."""
    return LaunchConfiguration(name).perform(context)


def is_true(context: LaunchContext, name: str) -> bool:
    """Tell whether an argument says yes, as Python and YAML write it.

    Raises:
        ValueError: it says neither yes nor no.
    """
    text = value_of(context, name).strip()
    if text.lower() in ("true", "1"):
        return True
    if text.lower() in ("false", "0", ""):
        return False
    raise ValueError(f"launch argument '{name}' is '{text}', neither True nor False")


def section_names(context: LaunchContext) -> frozenset[str]:
    """Return the names of the nodes that the file of parameters speaks of."""
    data = load_yaml(read_text_limited(value_of(context, "params_file")))
    return frozenset(str(key).strip("/") for key in data) if isinstance(data, dict) else frozenset()


def configured(context: LaunchContext) -> ParameterFile:
    """Return the file of parameters with what arguments put into it."""
    rewrites = {key: value_of(context, key) for key in ("use_sim_time", "autostart")}
    if "map" in context.launch_configurations and value_of(context, "map"):
        rewrites["yaml_filename"] = value_of(context, "map")
    return ParameterFile(
        RewrittenYaml(
            source_file=value_of(context, "params_file"),
            root_key=value_of(context, "namespace"),
            param_rewrites=rewrites,
            convert_types=True,
        ),
        allow_substs=True,
    )


def navigation_nodes(sections: Iterable[str]) -> tuple[Managed, ...]:
    """Return the nodes of navigation for a file with parameters of these nodes."""
    is_guarded = "collision_monitor" in sections
    own, last = (_COMMANDS, _COMMANDS) if is_guarded else ((), _LAST)
    rows = [
        _row("nav2_controller", "controller_server", "ControllerServer", _COMMANDS),
        _row("nav2_smoother", "smoother_server", "SmootherServer"),
        _row("nav2_planner", "planner_server", "PlannerServer"),
        Managed("nav2_behaviors", "behavior_server", "behavior_server::BehaviorServer",
                "behavior_server", own),
        _row("nav2_bt_navigator", "bt_navigator", "BtNavigator"),
        _row("nav2_waypoint_follower", "waypoint_follower", "WaypointFollower"),
        _row("nav2_velocity_smoother", "velocity_smoother", "VelocitySmoother", last),
    ]  # fmt: skip
    if is_guarded:
        rows.append(_row("nav2_collision_monitor", "collision_monitor", "CollisionMonitor"))
    return tuple(rows)


def started(
    context: LaunchContext,
    rows: Sequence[Managed],
    manager: str,
    extra: Mapping[str, Mapping[str, Any]] | None = None,
) -> list[Any]:
    """Return the actions that start nodes and their lifecycle manager.

    Args:
        context: of the launch.
        rows: the nodes, in the order in which they are brought up.
        manager: name of the lifecycle manager.
        extra: parameters beyond the file's, by node.
    """
    file, sim = configured(context), {"use_sim_time": is_true(context, "use_sim_time")}
    managing = {
        **sim, "autostart": is_true(context, "autostart"),
        "node_names": [row.name for row in rows],
    }  # fmt: skip
    own = extra or {}
    values = {row.name: [file, {**sim, **own.get(row.name, {})}] for row in rows}
    if is_true(context, "use_composition"):
        return [_composed(context, rows, values, manager, managing)]
    log = ["--ros-args", "--log-level", value_of(context, "log_level")]
    nodes = [
        Node(
            package=row.package, executable=row.executable, name=row.name, output="screen",
            respawn=is_true(context, "use_respawn"), respawn_delay=2.0,
            parameters=values[row.name], arguments=log,
            remappings=[*RELATIVE_TF, *row.remappings],
        )
        for row in rows
    ]  # fmt: skip
    return [*nodes, lifecycle_manager(manager, managing, log)]


def lifecycle_manager(name: str, values: Mapping[str, Any], log: Sequence[str]) -> Node:
    """Return the node that brings the others up."""
    return Node(
        package="nav2_lifecycle_manager", executable="lifecycle_manager", name=name,
        output="screen", arguments=list(log), parameters=[dict(values)],
    )  # fmt: skip


def log_absent_nodes(sections: Iterable[str]) -> list[LogInfo]:
    """Say which nodes a file of parameters speaks of that are not here."""
    return [
        LogInfo(msg=f"nav2_bringup: {name} is left out: {ABSENT[name]}")
        for name in sorted(set(sections) & set(ABSENT))
    ]


def _composed(
    context: LaunchContext,
    rows: Sequence[Managed],
    values: Mapping[str, list[Any]],
    manager: str,
    managing: Mapping[str, Any],
) -> LoadComposableNodes:
    nodes = [
        ComposableNode(
            package=row.package, plugin=row.plugin, name=row.name, parameters=values[row.name],
            remappings=[*RELATIVE_TF, *row.remappings],
        )
        for row in rows
    ]  # fmt: skip
    managing_node = ComposableNode(
        package="nav2_lifecycle_manager", plugin="nav2_lifecycle_manager::LifecycleManager",
        name=manager, parameters=[dict(managing)],
    )  # fmt: skip
    space = value_of(context, "namespace").strip("/")
    container = f"{space}/{value_of(context, 'container_name')}".strip("/")
    return LoadComposableNodes(
        target_container=f"/{container}", composable_node_descriptions=[*nodes, managing_node]
    )


def _row(package: str, name: str, kind: str, remappings: Rules = ()) -> Managed:
    return Managed(package, name, f"{package}::{kind}", name, remappings)
