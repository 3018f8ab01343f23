"""The page of all parameters: ``python -m gazelle.nodes.navigation.docs > docs/navigation.md``."""

from __future__ import annotations

import sys
from collections.abc import Mapping

from gazelle.navigation.controllers import CONTROLLERS, REFUSED_CONTROLLERS
from gazelle.navigation.costmap import REFUSED_LAYERS
from gazelle.navigation.planners import PLANNERS, REFUSED_PLANNERS
from gazelle.nodes.move_base.global_planner import planner_tables
from gazelle.nodes.move_base.local_planner import local_planner_tables
from gazelle.nodes.move_base.parameters import CLEAR, MOVE_BASE, ROTATE, SLOW
from gazelle.nodes.nav2 import parameters as nav2
from gazelle.nodes.nav2.behavior_trees.xml_parsing import NODE_TYPES
from gazelle.nodes.nav2.collision_monitor.parameters import (
    COLLISION_MONITOR,
    POLYGON,
    SOURCE,
    SUB_POLYGON,
)
from gazelle.nodes.navigation.costmap_from_parameters import COSTMAP_TABLES
from gazelle.parameters import ParameterTable
from gazelle.parameters.markdown import table_section

__all__ = ["page"]

_INTRODUCTION = (
    "# Navigation: parameters\n\nGenerated from the tables that the nodes read; do not edit"
    " (`python -m gazelle.nodes.navigation.docs > docs/navigation.md`). Parameters marked *live*"
    " change while the node runs. Those without effect are told when a file sets them, with the"
    " reason, and so are names that are not listed."
)


def page() -> str:
    """Return the page."""
    parts = [_INTRODUCTION, "## ROS 1"]
    tables = (MOVE_BASE, *planner_tables(), *local_planner_tables(), CLEAR, ROTATE, SLOW)
    parts += [table_section(table) for table in tables]
    parts += ["## Costmaps of both generations"]
    parts += [table_section(table) for table in COSTMAP_TABLES]
    parts += ["## Nav2"]
    parts += [table_section(table) for table in _nav2_tables()]
    parts += ["## What is not there", _refused()]
    parts += ["## Nodes of behaviour trees", _nodes()]
    return "\n\n".join(parts) + "\n"


def _nav2_tables() -> list[ParameterTable]:
    servers = [
        nav2.PLANNER_SERVER, nav2.CONTROLLER_SERVER, *nav2.GOAL_CHECKERS.values(),
        *nav2.PROGRESS_CHECKERS.values(), nav2.BEHAVIOR_SERVER, nav2.BT_NAVIGATOR,
        nav2.WAYPOINT_FOLLOWER, nav2.SMOOTHER_SERVER, nav2.SMOOTHER,
        nav2.VELOCITY_SMOOTHER, COLLISION_MONITOR, POLYGON, SUB_POLYGON, SOURCE,
        nav2.LIFECYCLE_MANAGER,
    ]  # fmt: skip
    planners = [nav2.planner_table(name) for name in PLANNERS if "::" in name]
    controllers = [nav2.controller_table(name) for name in CONTROLLERS if "::" in name]
    return [*servers, *planners, *controllers]


def _refused() -> str:
    groups: tuple[tuple[str, Mapping[str, str]], ...] = (
        ("Planners", REFUSED_PLANNERS),
        ("Controllers", REFUSED_CONTROLLERS),
        ("Layers", REFUSED_LAYERS),
    )
    lines = []
    for title, refusals in groups:
        lines += [f"{title}:", ""]
        lines += [f"- `{name}`: {why}" for name, why in sorted(refusals.items())]
        lines += [""]
    return "\n".join(lines).strip()


def _nodes() -> str:
    lines = ["| node | ports | what it does |", "| --- | --- | --- |"]
    for name, kind in sorted(NODE_TYPES.items()):
        ports = ", ".join(f"`{port}`" for port in dict.fromkeys((*kind.INPUTS, *kind.OUTPUTS)))
        about = (kind.__doc__ or "").strip().splitlines()[0]
        lines.append(f"| `{name}` | {ports} | {about} |")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.stdout.write(page())
