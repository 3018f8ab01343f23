"""Windows that are not there: `rviz`, `gzclient` and their kin stay alive and say what they are.

Launch files make them ``required="true"``, so ending would take the whole launch along.
"""

from __future__ import annotations

import threading

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Say once that no window opens, then wait to be stopped."""
    node = start_node(arguments, graph)
    node.log(
        "info",
        f"[{arguments.name}] no window opens: this version of Gazelle has no view yet; "
        "the node stays alive, since launch files count on it",
    )
    stop.wait()
    node.shutdown()
    return 0
