"""How the commands of ``ros2`` join the graph, and the node they have there."""

from __future__ import annotations

import argparse
import sys
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from gazelle.graph import ANY_TYPE, Entity, Graph, Kind, Node, NoGraphError
from gazelle.graph.names import check_name, is_hidden, resolve

__all__ = ["cli_node", "full_name", "graph_of_ros2", "types_by_name", "until_ended"]

_HIDDEN = "/_ros2cli"
_LOOK_S = 0.5


@contextmanager
def graph_of_ros2() -> Iterator[Graph]:
    """Join the graph for the time of a ``with`` block; where there is none, it is begun.

    ROS 2 has no master: a publisher may be there before everybody else. What joins later finds
    it.
    """
    try:
        graph = Graph.open(role="client")
    except NoGraphError as error:
        reason = str(error).partition(" (")[0]
        print(f"{reason}; only this command is on it", file=sys.stderr, flush=True)
        graph = Graph.open()
    with graph:
        yield graph


def cli_node(
    graph: Graph, options: argparse.Namespace, name: str | None = None
) -> tuple[Node, threading.Event]:
    """Return a node of the command's own, hidden from listings, and the event of its end.

    Args:
        graph: the graph.
        options: ``use_sim_time`` chooses its clock.
        name: a name that the user gives it, which is not hidden.
    """
    graph.clock.use(bool(getattr(options, "use_sim_time", False)))
    if name:
        node = graph.create_node(name, rosout=False)
    else:
        node = graph.create_node("ros2cli", namespace=_HIDDEN, anonymous=True, rosout=False)
    graph.clock.follow(node)
    ended = threading.Event()
    node.on_shutdown(lambda _reason: ended.set())
    return node, ended


def until_ended(ended: threading.Event, *, timeout_s: float | None = None) -> None:
    """Wait for an event, waking up now and then to see Ctrl-C."""
    left_s = timeout_s
    while not ended.wait(_LOOK_S if left_s is None else min(_LOOK_S, left_s)):
        if left_s is not None:
            left_s -= _LOOK_S
            if left_s <= 0:
                return


def full_name(name: str) -> str:
    """Return the global name; relative ones start at the root, as for ros2cli's nodes.

    Raises:
        IllegalNameError: it has a character that names do not have.
    """
    return check_name(resolve(name, "/"), "topic or service name")


def types_by_name(
    entities: Iterable[Entity], kinds: Iterable[Kind], *, include_hidden: bool = True
) -> dict[str, tuple[str, ...]]:
    """Return all types that somebody states for each topic or service, by name."""
    wanted = frozenset(kinds)
    found: dict[str, set[str]] = {}
    for one in entities:
        if one.kind in wanted and (include_hidden or not is_hidden(one.name)):
            types = found.setdefault(one.name, set())
            if one.type_name != ANY_TYPE:
                types.add(one.type_name)
    return {name: tuple(sorted(types)) for name, types in sorted(found.items())}
