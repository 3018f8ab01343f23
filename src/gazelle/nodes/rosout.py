"""``rosout``: what every node logs, gathered on /rosout_agg and in ``rosout.log``."""

from __future__ import annotations

import threading
from typing import Any

from gazelle.graph import Graph
from gazelle.interfaces import ros1_message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Pass log messages on until told to stop."""
    node = start_node(arguments, graph)
    log_type = ros1_message_type("rosgraph_msgs/Log")
    out = node.create_publisher("/rosout_agg", log_type, queue_size=100)

    def on_log(message: Any) -> None:
        out.publish(message)

    node.create_subscription("/rosout", log_type, on_log, queue_size=0)
    stop.wait()
    node.shutdown()
    return 0
