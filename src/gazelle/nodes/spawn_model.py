"""``gazebo_ros/spawn_model``: puts a robot or a thing into the running world."""

from __future__ import annotations

import threading

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Spawn, say how it went, and end."""
    from gazelle.simulator.spawn_model import spawn_model

    node = start_node(arguments, graph)
    try:
        return spawn_model(list(arguments.rest), node, stop)
    finally:
        node.shutdown()
