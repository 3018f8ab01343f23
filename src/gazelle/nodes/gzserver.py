"""``gazebo_ros/gzserver``: the simulator as a node of a launch."""

from __future__ import annotations

import threading

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.ros2_console import print_ros2

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Run a world until told to stop."""
    from gazelle.simulator.server_main import serve

    if arguments.generation == 2:
        graph.console = print_ros2
    return serve(arguments, graph, stop)
