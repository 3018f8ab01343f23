"""``gazebo_ros/spawn_model`` and ``spawn_entity.py``: put a robot or a thing into a world."""

from __future__ import annotations

import threading

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["run", "run_entity"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Spawn, say how it went, and end; the arguments tell whether they are ROS 2's."""
    return _spawn(arguments, graph, stop, None)


def run_entity(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Do the same with ROS 2's arguments."""
    return _spawn(arguments, graph, stop, True)


def _spawn(arguments: NodeArguments, graph: Graph, stop: threading.Event, ros2: bool | None) -> int:
    from gazelle.simulator.spawn_model import spawn_model

    node = start_node(arguments, graph)
    try:
        return spawn_model(list(arguments.rest), node, stop, ros2=ros2)
    finally:
        node.shutdown()
