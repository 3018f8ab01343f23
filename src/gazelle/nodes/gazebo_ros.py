"""``gazebo_ros``: ``gzserver``, the simulator as a node; ``spawn_model``, ``spawn_entity.py``."""

from __future__ import annotations

import threading

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.graph.log_output import print_ros2
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node
from gazelle.simulator.gzserver_ros_parameters import PARAMETERS

__all__ = ["PARAMETERS", "run_gzserver", "run_spawn_entity", "run_spawn_model"]


def run_gzserver(
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
    from gazelle.simulator.gzserver_process import serve

    if arguments.ros_version == 2:
        graph.console = print_ros2
    return serve(arguments, graph, stop, falls_back=falls_back, found=found)


def run_spawn_model(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Spawn, say how it went, and end; the arguments tell whether they are ROS 2's."""
    return _spawn(arguments, graph, stop, None)


def run_spawn_entity(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Do the same with ROS 2's arguments."""
    return _spawn(arguments, graph, stop, True)


def _spawn(arguments: NodeArguments, graph: Graph, stop: threading.Event, ros2: bool | None) -> int:
    from gazelle.simulator.spawn_model import spawn_model

    node = start_node(arguments, graph)
    try:
        return spawn_model(list(arguments.rest), node, stop, ros2=ros2)
    finally:
        node.shutdown()
