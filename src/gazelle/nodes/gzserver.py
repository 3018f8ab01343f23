"""``gazebo_ros/gzserver``: the simulator as a node of a launch."""

from __future__ import annotations

import threading

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Run a world until told to stop."""
    from gazelle.simulator.server_main import serve

    return serve(arguments, graph, stop)
