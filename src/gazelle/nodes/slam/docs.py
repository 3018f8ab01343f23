"""The page of SLAM's parameters: ``python -m gazelle.nodes.slam.docs > docs/slam.md``."""

from __future__ import annotations

import sys

from gazelle.nodes.frontier_exploration.bounded_explore_layer import BOUNDED_EXPLORE, EXPLORE_SERVER
from gazelle.nodes.slam.explore_lite import EXPLORE
from gazelle.nodes.slam.parameters import SLAM_NODES
from gazelle.parameters.markdown import table_section

__all__ = ["page"]

_INTRODUCTION = (
    "# SLAM: parameters\n\nGenerated from the tables that the nodes read; do not edit"
    " (`python -m gazelle.nodes.slam.docs > docs/slam.md`). One engine answers to all these names"
    " ([how](howto/slam.md)). Parameters without effect are told when they are set, with the"
    " reason, and so are names that are not listed. cartographer_node's are those of its Lua file."
)


def page() -> str:
    """Return the page."""
    tables = [one.table for one in SLAM_NODES.values()]
    tables += [EXPLORE, EXPLORE_SERVER, BOUNDED_EXPLORE]
    return "\n\n".join([_INTRODUCTION, *map(table_section, tables)]) + "\n"


if __name__ == "__main__":
    sys.stdout.write(page())
