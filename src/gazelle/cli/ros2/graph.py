"""How the commands of ``ros2`` use the graph: their node, types of topics, calls of services."""

from __future__ import annotations

import argparse
import sys
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from gazelle.cli.ros_tool import ToolError, hint
from gazelle.errors import GraphError
from gazelle.graph import ANY_TYPE, Entity, Graph, Kind, Node, NoGraphError
from gazelle.graph.names import check_name, is_hidden, resolve
from gazelle.interfaces import service_type

__all__ = [
    "absolute",
    "call_service",
    "cli_node",
    "full_name",
    "graph_of_ros2",
    "nodes_offering",
    "type_of_topic",
    "types_by_name",
    "until_ended",
    "wait_for_type",
]

_HIDDEN = "/_ros2cli"
_LOOK_S = 0.5
_TIMEOUT_S = 10.0
_ENDS = (Kind.PUBLISHER, Kind.SUBSCRIPTION)


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


def nodes_offering(
    entities: tuple[Entity, ...], services: dict[str, str], *, include_hidden: bool = False
) -> list[str]:
    """Return the nodes that offer all services, sorted.

    Args:
        entities: all of the graph.
        services: name below the node's own → type.
        include_hidden: hidden nodes too.
    """
    offered = types_by_name(entities, (Kind.SERVICE,))
    nodes = {one.node for one in entities if one.kind is Kind.NODE}
    return sorted(
        node
        for node in nodes
        if (include_hidden or not is_hidden(node))
        and all(kind in offered.get(f"{node}/{name}", ()) for name, kind in services.items())
    )


def call_service(node: Node, name: str, type_name: str, **fields: Any) -> Any:
    """Call a service once and return its response.

    Raises:
        ToolError: it fails, or there is no answer.
    """
    kind = service_type(type_name)
    try:
        return node.create_client(name, kind).call(kind.Request(**fields), timeout_s=_TIMEOUT_S)
    except GraphError as error:
        raise ToolError(str(error)) from None


def absolute(name: str) -> str:
    """Return a node's name with its leading slash."""
    return name if name.startswith("/") else f"/{name}"


def type_of_topic(graph: Graph, topic: str) -> str:
    """Return the type of a topic; when nobody has it, say so and return an empty text.

    Args:
        graph: the graph.
        topic: global name.

    Raises:
        ToolError: it has several types.
    """
    entities = graph.entities()
    found = _type(entities, topic)
    if not found:
        print(f"WARNING: topic [{topic}] does not appear to be published yet", flush=True)
        near = hint(topic, types_by_name(entities, _ENDS)).strip("\n")
        if near:
            print(near, file=sys.stderr, flush=True)
    return found


def wait_for_type(graph: Graph, topic: str, ended: threading.Event) -> str:
    """Return the type of a topic, once somebody has it; an empty text when the node has ended.

    Raises:
        ToolError: it has several types.
    """
    found = type_of_topic(graph, topic)
    while not found and not ended.is_set():
        graph.discovery.wait_for(lambda known: bool(_type(known, topic)), _LOOK_S)
        found = _type(graph.discovery.known(), topic)
    return found


def _type(entities: Iterable[Entity], topic: str) -> str:
    types = types_by_name(entities, _ENDS).get(topic, ())
    if len(types) > 1:
        raise ToolError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    return types[0] if types else ""
