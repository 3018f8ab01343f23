"""The graph value: nodes, topics, services and actions with their ties."""

from __future__ import annotations

import threading
from typing import Any, TypedDict

from gazelle.graph import Entity, Graph, Kind, Node
from gazelle.graph.actions.action_info import actions_of
from gazelle.graph.graph_info import services_of, topics_of
from gazelle.graph.names import is_hidden, split
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream

__all__ = [
    "OWN_PREFIX",
    "ActionRow",
    "GraphValue",
    "NodeRow",
    "ServiceRow",
    "TopicRow",
    "Topology",
    "get_graph",
    "graph_value",
    "open_graph",
]

OWN_PREFIX = "/_gazelle/"
"""Names of Gazelle's own; nobody is shown them."""

_GATHER_S = 0.1


class NodeRow(TypedDict):
    """A node with the names of its topics and services."""

    name: str
    namespace: str
    publishes: list[str]
    subscribes: list[str]
    serves: list[str]


class TopicRow(TypedDict):
    """A topic with the names of its nodes."""

    name: str
    type: str
    publishers: list[str]
    subscribers: list[str]
    hidden: bool


class ServiceRow(TypedDict):
    """A service with the names of its nodes."""

    name: str
    type: str
    nodes: list[str]


class ActionRow(TypedDict):
    """An action with the names of its nodes."""

    name: str
    type: str
    servers: list[str]
    clients: list[str]


class GraphValue(TypedDict):
    """Who speaks with whom."""

    nodes: list[NodeRow]
    topics: list[TopicRow]
    services: list[ServiceRow]
    actions: list[ActionRow]


def get_graph(node: Node, _params: Params) -> GraphValue:
    """``graph.get``."""
    return graph_value(node.graph.entities())


def open_graph(topology: Topology, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``graph``: the value now and at every change."""
    return OpenStream(topology.follow(channel))


class Topology:
    """Tells channels when the graph changes; changes that come together are told once."""

    def __init__(self, graph: Graph) -> None:
        """Listen to a graph until `close`."""
        self._graph = graph
        self._channels: list[Channel] = []
        self._lock = threading.Lock()
        self._dirty = threading.Event()
        self._closed = False
        graph.discovery.listen(self._on_change)
        threading.Thread(target=self._run, name="studio graph", daemon=True).start()

    def follow(self, channel: Channel) -> Any:
        """Send a channel the value now and at every change; returns what ends that."""
        channel.send(graph_value(self._graph.entities()))
        with self._lock:
            self._channels.append(channel)
        self._dirty.set()
        return lambda: self._leave(channel)

    def _leave(self, channel: Channel) -> None:
        with self._lock:
            self._channels.remove(channel)

    def _on_change(self, entity: Entity, _is_there: bool) -> None:
        if not entity.name.startswith(OWN_PREFIX):
            self._dirty.set()

    def close(self) -> None:
        """Tell nobody any more."""
        self._closed = True
        self._dirty.set()

    def _run(self) -> None:
        pause = threading.Event()
        last: GraphValue | None = None
        while self._dirty.wait() and not self._closed:
            pause.wait(_GATHER_S)
            self._dirty.clear()
            with self._lock:
                channels = tuple(self._channels)
            value = graph_value(self._graph.discovery.known()) if channels else None
            if value is None or value == last:
                continue
            last = value
            for channel in channels:
                channel.send(value)


def graph_value(entities: tuple[Entity, ...]) -> GraphValue:
    """Return the graph value of docs/studio_protocol.md."""
    shown = [
        one
        for one in entities
        if not one.name.startswith(OWN_PREFIX) and not one.node.startswith(OWN_PREFIX)
    ]
    return {
        "nodes": _nodes(shown),
        "topics": [
            {
                "name": topic.name,
                "type": topic.type_name,
                "publishers": sorted(set(topic.publishers)),
                "subscribers": sorted(set(topic.subscriptions)),
                "hidden": is_hidden(topic.name),
            }
            for topic in topics_of(shown, include_hidden=True)
        ],
        "services": [
            {"name": one.name, "type": one.type_name, "nodes": sorted(set(one.servers))}
            for one in services_of(shown)
        ],
        "actions": [
            {
                "name": one.name,
                "type": one.type_name,
                "servers": sorted(set(one.servers)),
                "clients": sorted(set(one.clients)),
            }
            for one in actions_of(tuple(shown))
        ],
    }


def _nodes(entities: list[Entity]) -> list[NodeRow]:
    ends: dict[str, dict[Kind, set[str]]] = {}
    for one in entities:
        of_node = ends.setdefault(one.node, {})
        of_node.setdefault(one.kind, set()).add(one.name)
    return [
        {
            "name": name,
            "namespace": split(name)[0],
            "publishes": sorted(of_node.get(Kind.PUBLISHER, ())),
            "subscribes": sorted(of_node.get(Kind.SUBSCRIPTION, ())),
            "serves": sorted(of_node.get(Kind.SERVICE, ())),
        }
        for name, of_node in sorted(ends.items())
        if Kind.NODE in of_node
    ]
