"""Which parameters of a built-in node change nothing: known ones, and names that were misspelt.

Nodes tell it themselves when they start; this tells it of files that nobody has started.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, Literal, NamedTuple

from gazelle.diagnostics import did_you_mean
from gazelle.navigation.controllers import CONTROLLERS
from gazelle.navigation.costmap.costmap_parameters import (
    InflationOptions,
    ObstacleOptions,
    StaticOptions,
    VoxelOptions,
)
from gazelle.navigation.planners import PLANNERS
from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.spec import resolved
from gazelle.nodes.move_base.global_planner import planner_tables
from gazelle.nodes.move_base.local_planner import local_planner_tables
from gazelle.nodes.move_base.parameters import CLEAR, ROTATE, SLOW
from gazelle.nodes.nav2 import parameters as nav2
from gazelle.nodes.navigation.costmap_from_parameters import costmap_table, layer_table
from gazelle.nodes.parameters import OF_EVERY_NODE
from gazelle.nodes.robot_localization.parameters import EKF, ekf_table
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.trees import flattened, nested, values_only

__all__ = [
    "MisspeltParameter",
    "UnsupportedParameter",
    "misspelt_parameters",
    "node_of_name",
    "unsupported_parameters",
]

RosVersion = Literal[1, 2]

_COSTMAPS = ("local_costmap", "global_costmap")
_LAYERS = (StaticOptions, ObstacleOptions, VoxelOptions, InflationOptions)
# What launch files of ROS 2 call nodes besides the names that they have of themselves.
_NAMES = {
    "lifecycle_manager_localization": "nav2_lifecycle_manager/lifecycle_manager",
    "lifecycle_manager_navigation": "nav2_lifecycle_manager/lifecycle_manager",
}

# Whoever looks at controllers and at MoveIt's configuration tells it of them.
_TOLD_ELSEWHERE = (
    ("controller_manager", "ros2_control_node"),
    ("moveit_ros_move_group", "move_group"),
)


class UnsupportedParameter(NamedTuple):
    """A parameter without effect: its name with dots, and why it has none."""

    key: str
    reason: str


class MisspeltParameter(NamedTuple):
    """A name that a node does not know, with dots, and what it may have been meant for."""

    key: str
    hint: str


def unsupported_parameters(
    node: str, values: Mapping[str, Any], ros_version: RosVersion
) -> tuple[UnsupportedParameter, ...]:
    """Return the parameters of a node that are known and have no effect here.

    Args:
        node: ``package/type``, or ``costmap`` for the node of a costmap in ROS 2.
        values: its parameters by their names below the node.
        ros_version: of ROS.
    """
    tree = nested(values)
    table = _table_of(node, tree, ros_version)
    if table is None:
        return ()
    return tuple(
        UnsupportedParameter(key, row.meaning)
        for _, key, row, value in _walk(table, tree, "", ros_version)
        if row is not None and row.asks_in_vain(value)
    )


def misspelt_parameters(
    node: str, values: Mapping[str, Any], ros_version: RosVersion
) -> tuple[MisspeltParameter, ...]:
    """Return the parameters of a node that it does not know, and nearly: others may be a plug-in's.

    Args:
        node: as for `unsupported_parameters`.
        values: its parameters by their names below the node.
        ros_version: of ROS.
    """
    tree = nested(values)
    table = _table_of(node, tree, ros_version)
    if table is None:
        return ()
    found = (
        MisspeltParameter(key, did_you_mean(key.rpartition(".")[2], own.keys()))
        for own, key, row, _ in _walk(table, tree, "", ros_version)
        if row is None and not _is_of_every_node(key) and not _is_of_a_plugin(key, ros_version)
    )
    return tuple(item for item in found if item.hint)


def node_of_name(name: str) -> str:
    """Return what is meant by the name of a node in a file of ROS 2, empty when it is not known."""
    own = name.strip("/").rpartition("/")[2]
    if own in _COSTMAPS:
        return "costmap"
    if own in _NAMES:
        return _NAMES[own]
    named = (f"{spec.package}/{spec.executable}" for spec in node_specs() if spec.name == own)
    found = next((node for node in named if node in _places(2)), "")
    return found or next((node for node in _places(2) if node.rpartition("/")[2] == own), "")


def _table_of(node: str, tree: Mapping[str, Any], ros_version: RosVersion) -> ParameterTable | None:
    if node in EKF.types:
        return ekf_table(tree)
    return costmap_table(ros_version) if node == "costmap" else _table(node, ros_version)


def _is_of_every_node(key: str) -> bool:
    return key.partition(".")[0] in OF_EVERY_NODE


def _is_of_a_plugin(key: str, ros_version: RosVersion) -> bool:
    """Tell whether a plug-in has such a parameter: layers of costmaps read those above them."""
    name = key.rpartition(".")[2]
    return any(table.row_for(name) is not None for table in _plugins(ros_version).values())


def _walk(
    table: ParameterTable, tree: Mapping[str, Any], prefix: str, ros_version: RosVersion
) -> Iterator[tuple[ParameterTable, str, Parameter | None, Any]]:
    """Yield every value with the table it is of, its name and its row."""
    kinds = _kinds(tree)
    for key, value in tree.items():
        if isinstance(value, Mapping):
            below = _below(key, value, kinds, ros_version)
            if below is not None:
                yield from _walk(below, value, f"{prefix}{key}.", ros_version)
                continue
        for name, leaf in values_only(flattened({key: value})):
            row = table.row_for(name)
            if row is not None or not isinstance(value, Mapping):
                yield table, f"{prefix}{name}", row, leaf


def _below(
    key: str, value: Mapping[str, Any], kinds: Mapping[str, str], ros_version: RosVersion
) -> ParameterTable | None:
    if key in _COSTMAPS:
        return costmap_table(ros_version)
    return _plugins(ros_version).get(_plain(str(value.get("plugin", kinds.get(key, "")))))


def _kinds(tree: Mapping[str, Any]) -> dict[str, str]:
    """Return the types of plug-ins by their names: of ROS 1's lists, else the type's last word."""
    kinds = {}
    for value in tree.values():
        if isinstance(value, str) and "/" in value:
            kinds[value.rpartition("/")[2]] = value
        for item in value if isinstance(value, list) else ():
            if isinstance(item, Mapping) and {"name", "type"} <= set(item):
                kinds[str(item["name"])] = str(item["type"])
    return kinds


def _plain(plugin: str) -> str:
    return plugin.replace("/", "::")


def _table(node: str, ros_version: RosVersion) -> ParameterTable | None:
    """Return the table of a node's row, by any of its names; None where it has none."""
    place = _places(ros_version).get(node)
    return None if place is None else resolved(place)


@cache
def _places(ros_version: RosVersion) -> dict[str, str]:
    """Return where the tables of nodes are, by ``package/executable``."""
    return {
        f"{name.package}/{name.executable}": spec.parameters
        for spec in node_specs()
        for name in spec.names
        if spec.parameters and ros_version in name.ros and name[:2] not in _TOLD_ELSEWHERE
    }


@cache
def _plugins(ros_version: RosVersion) -> dict[str, ParameterTable]:
    """Return the tables of plug-ins by their types."""
    tables = [layer_table(options, ros_version) for options in _LAYERS]
    if ros_version == 1:
        tables += [*planner_tables(), *local_planner_tables(), CLEAR, ROTATE, SLOW]
    else:
        tables += [nav2.planner_table(name) for name in PLANNERS if "::" in name]
        tables += [nav2.controller_table(name) for name in CONTROLLERS if "::" in name]
        tables += [*nav2.GOAL_CHECKERS.values(), *nav2.PROGRESS_CHECKERS.values(), nav2.SMOOTHER]
    return {_plain(name): table for table in tables for name in table.types}
