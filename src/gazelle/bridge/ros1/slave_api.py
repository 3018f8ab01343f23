"""A node of the graph as ROS 1 sees it: a slave server, and registrations at the master.

Source: http://wiki.ros.org/ROS/Slave_API.
"""

from __future__ import annotations

import contextlib
import os
import socket
import threading
from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.bridge.ros1.connections import Connections
from gazelle.bridge.ros1.master_registry import State
from gazelle.bridge.ros1.publisher import PublishedTopic
from gazelle.bridge.ros1.tcpros import read_header, write_header
from gazelle.bridge.ros1.tcpros_server import ServerSocket
from gazelle.bridge.ros1.types import ServiceKind
from gazelle.bridge.ros1.xmlrpc_call import RemoteRefusedError

__all__ = ["Ask", "NodeEntities", "SlaveNode"]

Ask = Callable[..., Any]
"""Calls a method of the master: (method, *arguments) → value."""

_READY = "ready on {host}:{port}"
_TCPROS = "TCPROS"


class NodeEntities(NamedTuple):
    """What a node of the graph offers and wants.

    Attributes:
        node: its name on the graph.
        publishers: by topic.
        subscribers: topic → type in ROS 1.
        services: by name.
    """

    node: str
    publishers: dict[str, PublishedTopic]
    subscribers: dict[str, str]
    services: dict[str, ServiceKind]


class SlaveNode:
    """Speaks for one node.

    Attributes:
        name: the node's name in ROS 1.
        node_entities: what it offers and wants now.
    """

    def __init__(self, connections: Connections, ask: Ask, name: str, node: str) -> None:
        """Open the node's port; nothing is registered yet."""
        self.name = name
        self.node_entities = NodeEntities(node, {}, {}, {})
        self._connections = connections
        self._ask = ask
        self._lock = threading.Lock()
        self._registered: set[tuple[str, str]] = set()
        self._refused: set[tuple[str, str]] = set()
        methods: dict[str, Callable[..., Any]] = {
            "getBusInfo": self._bus_info,
            "getBusStats": self._bus_stats,
            "getMasterUri": self._master_uri,
            "getPid": self._pid,
            "getPublications": self._publications,
            "getSubscriptions": self._subscriptions,
            "paramUpdate": self._param_update,
            "publisherUpdate": self._publisher_update,
            "requestTopic": self._request_topic,
            "shutdown": self._shutdown,
        }
        self._server_socket = ServerSocket(
            connections.address, methods, self._take, connections.notice
        )

    @property
    def uri(self) -> str:
        """Address of the slave server."""
        return self._server_socket.uri

    @property
    def _node(self) -> str:
        return self.node_entities.node

    def settle(self, node_entities: NodeEntities) -> None:
        """Make the registrations those of a new set of wishes.

        Raises:
            RemoteError: the master does not answer; call again later.
        """
        before, self.node_entities = self.node_entities, node_entities
        wanted = {
            *(("Publisher", name) for name in node_entities.publishers),
            *(("Subscriber", name) for name in node_entities.subscribers),
            *(("Service", name) for name in node_entities.services),
        }
        with self._lock:
            changed = {
                key for key in wanted & self._registered if _differs(before, node_entities, key)
            }
            for key in (self._registered - wanted) | changed:
                self._unregister(*key)
            for key in sorted(wanted - self._registered):
                try:
                    self._register(*key)
                except RemoteRefusedError as error:
                    self._connections.notice(f"the master refuses {key[1]} of {self.name}: {error}")
                    self._refused.add(key)
                self._registered.add(key)

    def start_over(self) -> None:
        """Forget what was registered: the master is a new one."""
        with self._lock:
            self._registered.clear()
            self._refused.clear()

    def is_forgotten(self, state: State) -> bool:
        """Return whether a master lacks what was registered there.

        Not where somebody else has this name now: that is how it should be.

        Raises:
            RemoteError: the master does not answer; call again later.
        """
        sides = {
            "Publisher": state.publishers,
            "Subscriber": state.subscribers,
            "Service": state.services,
        }
        with self._lock:
            wanted = self._registered - self._refused
        # Of several that offer a service the last one counts.
        wanted -= {("Service", name) for _, name in state.services}
        if all((self.name, name) in sides[what] for what, name in wanted):
            return False
        if not any(node == self.name for side in sides.values() for node, _ in side):
            return True
        with contextlib.suppress(RemoteRefusedError):
            return bool(self._ask("lookupNode", self.name, self.name) == self.uri)
        return True

    def close(self) -> None:
        """Unregister all and close the port.

        Raises:
            RemoteError: the master does not answer any more; the port is closed nevertheless.
        """
        try:
            self.settle(NodeEntities(self.node_entities.node, {}, {}, {}))
        finally:
            self._server_socket.close()

    def _register(self, what: str, name: str) -> None:
        if what == "Service":
            uri = self._server_socket.service_uri
            self._ask("registerService", self.name, name, uri, self.uri)
        elif what == "Publisher":
            kind = self.node_entities.publishers[name].kind
            self._ask("registerPublisher", self.name, name, kind.ros1_name, self.uri)
        else:
            type_name = self.node_entities.subscribers[name]
            found = self._ask("registerSubscriber", self.name, name, type_name, self.uri)
            self._connections.take_topic(name, list(found), self.name)

    def _unregister(self, what: str, name: str) -> None:
        uri = self._server_socket.service_uri if what == "Service" else self.uri
        # One that another process has taken over is not ours to remove; the master knows.
        with contextlib.suppress(RemoteRefusedError):
            self._ask(f"unregister{what}", self.name, name, uri)
        self._registered.discard((what, name))
        self._refused.discard((what, name))

    def _take(self, stream: socket.socket) -> None:
        header = read_header(stream)
        service = self.node_entities.services.get(header.get("service", ""))
        offer = self.node_entities.publishers.get(header.get("topic", ""))
        if service is not None:
            self._connections.serve_service(stream, header, service, self.name)
        elif offer is not None:
            self._connections.serve_topic(stream, header, offer, self.name)
        else:
            name = header.get("service") or header.get("topic") or "?"
            text = f"[{name}] is neither a topic nor a service of [{self.name}]"
            stream.sendall(write_header({"error": text}))

    def _bus_stats(self, _caller: str) -> tuple[int, str, Any]:
        topics: dict[str, list[list[int]]] = {}
        for number, (topic, link) in enumerate(self._connections.links_of(self._node), 1):
            topics.setdefault(topic, []).append([number, link.sent_bytes, link.sent, 1])
        published = [
            [topic, sum(row[1] for row in rows), rows] for topic, rows in sorted(topics.items())
        ]
        return 1, "", [published, [], []]

    def _bus_info(self, _caller: str) -> tuple[int, str, Any]:
        out = [
            (link.subscriber, "o", topic) for topic, link in self._connections.links_of(self._node)
        ]
        into = [
            (publisher, "i", topic)
            for topic, publisher in self._connections.connections_of(self.node_entities.subscribers)
        ]
        rows = [
            [number, other, way, _TCPROS, topic, True]
            for number, (other, way, topic) in enumerate((*out, *into), 1)
        ]
        return 1, "bus info", rows

    def _master_uri(self, _caller: str) -> tuple[int, str, Any]:
        return 1, self._connections.master_uri, self._connections.master_uri

    def _shutdown(self, _caller: str, reason: str = "") -> tuple[int, str, Any]:
        self._connections.end_node(self.node_entities.node, reason)
        return 1, "shutdown", 0

    def _pid(self, _caller: str) -> tuple[int, str, Any]:
        return 1, "", self._connections.process_of(self.node_entities.node) or os.getpid()

    def _subscriptions(self, _caller: str) -> tuple[int, str, Any]:
        return (
            1,
            "subscriptions",
            [list(one) for one in sorted(self.node_entities.subscribers.items())],
        )

    def _publications(self, _caller: str) -> tuple[int, str, Any]:
        offers = sorted(self.node_entities.publishers.items())
        return 1, "publications", [[topic, offer.kind.ros1_name] for topic, offer in offers]

    def _param_update(self, _caller: str, name: str, value: Any) -> tuple[int, str, Any]:
        self._connections.changed_parameter(name, value)
        return 1, "", 0

    def _publisher_update(self, _caller: str, topic: str, uris: Any) -> tuple[int, str, Any]:
        self._connections.take_topic(str(topic), [str(uri) for uri in uris], self.name)
        return 1, "", 0

    def _request_topic(self, _caller: str, topic: str, protocols: Any) -> tuple[int, str, Any]:
        if topic not in self.node_entities.publishers:
            return 0, f"Not a publisher of [{topic}]", 0
        names = [one[0] for one in protocols if isinstance(one, list) and one]
        if _TCPROS not in names:
            return 0, f"no supported protocol implementations among {names}", 0
        host, port = self._server_socket.host, self._server_socket.port
        return 1, _READY.format(host=host, port=port), [_TCPROS, host, port]


def _differs(before: NodeEntities, now: NodeEntities, key: tuple[str, str]) -> bool:
    """Return whether a registration states another type than before."""
    what, name = key
    if what == "Publisher":
        return before.publishers[name].kind.ros1_name != now.publishers[name].kind.ros1_name
    if what == "Subscriber":
        return before.subscribers[name] != now.subscribers[name]
    return before.services[name].md5 != now.services[name].md5
