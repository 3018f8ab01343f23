"""The page of nodes' parameters: ``python -m gazelle.nodes.docs > docs/nodes.md``."""

from __future__ import annotations

import sys

from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.spec import resolved
from gazelle.parameters import ParameterTable
from gazelle.parameters.markdown import table_section

__all__ = ["page"]

_INTRODUCTION = (
    "# Nodes: parameters\n\nGenerated from the tables that the nodes read; do not edit"
    " (`python -m gazelle.nodes.docs > docs/nodes.md`). Names are those below a node's"
    " own (`~`); parts are joined with dots here, in ROS 1 with slashes. Parameters without effect"
    " are told, with the reason, where they ask for what the original does, and so are names that"
    " are not listed. Nodes of [navigation](navigation.md) and [SLAM](slam.md) have pages of their"
    " own."
)
# What the pages of navigation and SLAM are made of.
_ELSEWHERE = ("frontier_exploration", "move_base", "nav2", "slam")
# Tables of what a node loads, by the node's own.
_LASER_FILTERS = "gazelle.nodes.filters.laser_filters"
_PARTS = {f"{_LASER_FILTERS}:PARAMETERS": f"{_LASER_FILTERS}:FILTER_TABLES"}


def page() -> str:
    """Return the page."""
    return "\n\n".join([_INTRODUCTION, *map(table_section, _tables())]) + "\n"


def _tables() -> list[ParameterTable]:
    """Return the tables of the nodes' rows and of their parts, each once."""
    found: dict[str, list[ParameterTable]] = {}
    for spec in node_specs():
        place = str(spec.parameters or "").removeprefix("gazelle.nodes.").partition(".")[0]
        if spec.parameters and place not in _ELSEWHERE:
            parts = resolved(_PARTS[spec.parameters]) if spec.parameters in _PARTS else {}
            found.setdefault(spec.parameters, [resolved(spec.parameters), *parts.values()])
    return [table for tables in found.values() for table in tables]


if __name__ == "__main__":
    sys.stdout.write(page())
