"""What a ROS 1 master knows: who publishes, subscribes and answers what, and where."""

from __future__ import annotations

import threading
from typing import NamedTuple

from gazelle.graph import ANY_TYPE

__all__ = ["Registry", "Replaced", "State"]


class Replaced(NamedTuple):
    """A node whose name another process has taken, and the place it was at."""

    node: str
    uri: str


class State(NamedTuple):
    """Everything in a master at one moment; sets of (node, topic or service).

    Attributes:
        publishers: who publishes which topic.
        subscribers: who subscribes which topic.
        services: who answers which service.
        types: topics' types, ``*`` when nobody has told one.
    """

    publishers: frozenset[tuple[str, str]]
    subscribers: frozenset[tuple[str, str]]
    services: frozenset[tuple[str, str]]
    types: dict[str, str]


class Registry:
    """Registrations by kind; safe to use from many threads."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._nodes: dict[str, str] = {}
        self._publishers: dict[str, dict[str, str]] = {}
        self._subscribers: dict[str, dict[str, str]] = {}
        self._services: dict[str, tuple[str, str]] = {}
        self._parameters: dict[str, dict[str, str]] = {}
        self._types: dict[str, str] = {}

    def add_publisher(self, node: str, topic: str, type_name: str, uri: str) -> Replaced | None:
        """Add a publisher; return whom it replaces, when its name is used elsewhere."""
        with self._lock:
            replaced = self._enter(node, uri)
            self._publishers.setdefault(topic, {})[node] = uri
            # The publisher's word counts, a subscriber's until there is one.
            if type_name != ANY_TYPE or topic not in self._types:
                self._types[topic] = type_name
            return replaced

    def add_subscriber(self, node: str, topic: str, type_name: str, uri: str) -> Replaced | None:
        """Add a subscriber; return whom it replaces."""
        with self._lock:
            replaced = self._enter(node, uri)
            self._subscribers.setdefault(topic, {})[node] = uri
            if self._types.get(topic, ANY_TYPE) == ANY_TYPE:
                self._types[topic] = type_name
            return replaced

    def add_service(self, node: str, service: str, service_uri: str, uri: str) -> Replaced | None:
        """Add a service, the newest counts; return whom it replaces."""
        with self._lock:
            replaced = self._enter(node, uri)
            self._services[service] = (node, service_uri)
            return replaced

    def add_parameter(self, node: str, name: str, uri: str) -> Replaced | None:
        """Add a node that wants to hear of a parameter; return whom it replaces."""
        with self._lock:
            replaced = self._enter(node, uri)
            self._parameters.setdefault(name, {})[node] = uri
            return replaced

    def remove_publisher(self, node: str, topic: str, uri: str) -> bool:
        """Remove a publisher; False when there is no such."""
        return self._remove(self._publishers, node, topic, uri)

    def remove_subscriber(self, node: str, topic: str, uri: str) -> bool:
        """Remove a subscriber; False when there is no such."""
        return self._remove(self._subscribers, node, topic, uri)

    def remove_parameter(self, node: str, name: str, uri: str) -> bool:
        """Remove a node's wish to hear of a parameter; False when there is no such."""
        return self._remove(self._parameters, node, name, uri)

    def remove_service(self, node: str, service: str, service_uri: str) -> bool:
        """Remove a service; False when it is another's."""
        with self._lock:
            found = self._services.get(service)
            if found != (node, service_uri):
                return False
            del self._services[service]
            self._leave(node)
            return True

    def node_uri(self, node: str) -> str | None:
        """Return where a node's slave server is."""
        with self._lock:
            return self._nodes.get(node)

    def service_uri(self, service: str) -> str | None:
        """Return where a service is answered."""
        with self._lock:
            found = self._services.get(service)
            return found[1] if found else None

    def publisher_uris(self, topic: str) -> list[str]:
        """Return the slave servers of a topic's publishers."""
        with self._lock:
            return list(self._publishers.get(topic, {}).values())

    def subscribers(self, topic: str) -> list[tuple[str, str]]:
        """Return names and slave servers of a topic's subscribers."""
        with self._lock:
            return list(self._subscribers.get(topic, {}).items())

    def listeners(self, parameter: str) -> list[tuple[str, str, str]]:
        """Return parameter, node and slave server of all that a change concerns.

        They asked for it, for a namespace it is in, or for something below it.
        """
        with self._lock:
            return [
                (name, node, uri)
                for name, nodes in self._parameters.items()
                if _concerns(parameter, name)
                for node, uri in nodes.items()
            ]

    def state(self) -> State:
        """Return everything."""
        with self._lock:
            return State(
                frozenset((n, t) for t, nodes in self._publishers.items() for n in nodes),
                frozenset((n, t) for t, nodes in self._subscribers.items() for n in nodes),
                frozenset((found[0], name) for name, found in self._services.items()),
                dict(self._types),
            )

    def _remove(self, table: dict[str, dict[str, str]], node: str, name: str, uri: str) -> bool:
        with self._lock:
            nodes = table.get(name, {})
            if nodes.get(node) != uri:
                return False
            del nodes[node]
            if not nodes:
                del table[name]
            self._leave(node)
            return True

    def _enter(self, node: str, uri: str) -> Replaced | None:
        before = self._nodes.get(node)
        if before is not None and before != uri:
            self._forget(node)
        self._nodes[node] = uri
        return Replaced(node, before) if before is not None and before != uri else None

    def _leave(self, node: str) -> None:
        tables = (self._publishers, self._subscribers, self._parameters)
        used = any(node in nodes for table in tables for nodes in table.values())
        if not used and all(found[0] != node for found in self._services.values()):
            self._nodes.pop(node, None)

    def _forget(self, node: str) -> None:
        for table in (self._publishers, self._subscribers, self._parameters):
            for name in [name for name, nodes in table.items() if node in nodes]:
                del table[name][node]
                if not table[name]:
                    del table[name]
        self._services = {k: found for k, found in self._services.items() if found[0] != node}


def _concerns(changed: str, wanted: str) -> bool:
    above, below = changed.rstrip("/") + "/", wanted.rstrip("/") + "/"
    return above.startswith(below) or below.startswith(above)
