"""What the subcommands that go on share: a node of their own, and its end."""

from __future__ import annotations

import threading

from gazelle.graph import Graph, Node

__all__ = ["join_as_node", "uses_sim_time"]


def join_as_node(
    graph: Graph, *, clock: bool = True, rosout: bool = True
) -> tuple[Node, threading.Event]:
    """Return a node of a name of its own, and the event of its end (``rosnode kill``).

    Args:
        graph: the graph.
        clock: follow ``/clock`` while ``/use_sim_time`` is true.
        rosout: announce ``/rosout``.
    """
    node = graph.create_node("rostopic", anonymous=True, rosout=rosout)
    ended = threading.Event()
    node.on_shutdown(lambda _reason: ended.set())
    if clock:
        graph.clock.follow(node)
    return node, ended


def uses_sim_time(graph: Graph) -> bool:
    """Return whether the parameter says that time is simulated."""
    return graph.parameters.get("/use_sim_time", False) is True
