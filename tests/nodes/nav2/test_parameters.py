"""Every parameter of nav2_bringup's file is known to the node that it is for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.nav2 import parameters as tables
from gazelle.nodes.nav2.collision_monitor.parameters import (
    COLLISION_MONITOR,
    read_polygons,
    read_sources,
    report_others,
)
from gazelle.nodes.navigation.costmap_from_parameters import assemble
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import ParameterTable
from gazelle.parameters.reader import ParameterReader
from gazelle.parameters.trees import nested
from gazelle.workspace.ament_index import get_package_share_directory

_FILE = Path(get_package_share_directory("nav2_bringup")) / "params" / "nav2_params.yaml"
_SERVERS = {
    "planner_server": tables.PLANNER_SERVER,
    "controller_server": tables.CONTROLLER_SERVER,
    "smoother_server": tables.SMOOTHER_SERVER,
    "behavior_server": tables.BEHAVIOR_SERVER,
    "bt_navigator": tables.BT_NAVIGATOR,
    "waypoint_follower": tables.WAYPOINT_FOLLOWER,
    "velocity_smoother": tables.VELOCITY_SMOOTHER,
}
_PLUGINS: dict[str, Callable[[str], ParameterTable]] = {
    "planner_plugins": tables.planner_table,
    "controller_plugins": tables.controller_table,
    "goal_checker_plugins": tables.GOAL_CHECKERS.__getitem__,
    "progress_checker_plugins": tables.PROGRESS_CHECKERS.__getitem__,
    "smoother_plugins": lambda _: tables.SMOOTHER,
}


def _values(name: str) -> dict[str, Any]:
    section = yaml.safe_load(_FILE.read_text())[name]
    return nested(section["ros__parameters"])


def _check(settings: ParameterReader) -> None:
    """Read all of a server's parameters, and those of its plug-ins by their own tables."""
    below: list[str] = []
    for key, table in _PLUGINS.items():
        for name in settings.tree.get(key, ()):
            own = dict(settings.tree[name])
            found = settings.with_table(table(own.pop("plugin")), own, name)
            found.report_unknown()
            below.append(name)
    settings.report_unknown(*below)
    for row in settings.table.rows:
        if row.kind in ("number", "integer", "flag", "text", "texts", "numbers"):
            settings.value(row)


@pytest.mark.parametrize("name", sorted(_SERVERS))
def test_the_default_file_has_only_what_a_server_knows(name: str) -> None:
    diagnostics = Diagnostics()
    _check(node_reader(_SERVERS[name], _values(name), name, diagnostics))
    assert [str(item) for item in diagnostics] == []


@pytest.mark.parametrize("name", ["local_costmap", "global_costmap"])
def test_the_default_file_has_only_what_a_costmap_knows(name: str) -> None:
    diagnostics = Diagnostics()
    tree: Mapping[str, Any] = yaml.safe_load(_FILE.read_text())[name][name]["ros__parameters"]
    made = assemble(tree, name, diagnostics, ros_version=2)
    assert len(made.costmap.layers) == len(tree["plugins"])
    idle = [str(item) for item in diagnostics if item.code != "parameter.idle"]
    assert idle == []


def test_the_default_file_has_only_what_collision_monitor_knows() -> None:
    diagnostics = Diagnostics()
    settings = node_reader(COLLISION_MONITOR, _values("collision_monitor"), "c", diagnostics)
    assert len(read_polygons(settings)) == len(read_sources(settings)) == 1
    report_others(settings)
    assert [str(item) for item in diagnostics] == []


def test_zones_that_polygons_do_not_name_are_told_once() -> None:
    diagnostics = Diagnostics()
    tree = {"polygons": [], "limit": {"type": "circle", "radius": 1.0, "action_type": "limit"}}
    report_others(node_reader(COLLISION_MONITOR, tree, "/collision_monitor", diagnostics))
    (found,) = diagnostics
    assert "'limit' has parameters and is not one of polygons" in str(found)
