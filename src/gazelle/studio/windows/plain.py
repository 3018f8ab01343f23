"""Windows that take no words: each opens the panel of its name."""

from __future__ import annotations

import threading
from collections.abc import Callable

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.studio.windows import window_nodes

__all__ = [
    "action_caller",
    "rqt_action",
    "rqt_console",
    "rqt_ez_publisher",
    "rqt_graph",
    "rqt_logger_level",
    "rqt_msg",
    "rqt_publisher",
    "rqt_reconfigure",
    "rqt_robot_steering",
    "rqt_service_caller",
    "rqt_srv",
    "rqt_tf_tree",
    "rqt_top",
    "rqt_topic",
]

_Node = Callable[[NodeArguments, Graph, threading.Event], int]


def _opens(panel: str) -> _Node:
    def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
        return window_nodes.run_view(panel, {}, arguments, graph, stop)

    return run


action_caller = _opens("action_caller")
rqt_action = _opens("rqt_action")
rqt_console = _opens("rqt_console")
rqt_ez_publisher = _opens("rqt_ez_publisher")
rqt_graph = _opens("rqt_graph")
rqt_logger_level = _opens("rqt_logger_level")
rqt_msg = _opens("rqt_msg")
rqt_publisher = _opens("rqt_publisher")
rqt_reconfigure = _opens("rqt_reconfigure")
rqt_robot_steering = _opens("rqt_robot_steering")
rqt_service_caller = _opens("rqt_service_caller")
rqt_srv = _opens("rqt_srv")
rqt_tf_tree = _opens("rqt_tf_tree")
rqt_top = _opens("rqt_top")
rqt_topic = _opens("rqt_topic")
