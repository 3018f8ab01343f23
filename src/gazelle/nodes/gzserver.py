"""``gazebo_ros/gzserver``: the simulator as a node of a launch."""

from __future__ import annotations

import threading

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.log_output import print_ros2
from gazelle.simulator.server_parameters import PARAMETERS

__all__ = ["PARAMETERS", "run"]


def run(
    arguments: NodeArguments,
    graph: Graph,
    stop: threading.Event,
    *,
    falls_back: bool = True,
    found: Diagnostics | None = None,
) -> int:
    """Run a world until told to stop.

    Args:
        arguments: how the node was started.
        graph: where topics and services go.
        stop: set to end it.
        falls_back: run the empty world where the named one is not found.
        found: what is wrong with its parameters already, to be told with the rest.
    """
    from gazelle.simulator.server_main import serve

    if arguments.ros_version == 2:
        graph.console = print_ros2
    return serve(arguments, graph, stop, falls_back=falls_back, found=found)
