"""Nodes of real ROS as the graph sees them: their names, topics and services."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, Protocol, TypeVar

from gazelle.graph import Publisher
from gazelle.graph.key_expressions import ANY_TYPE, NO_HASH, Entity, Kind, token
from gazelle.graph.names import is_legal, is_legal_base, split
from gazelle.graph.type_support import hash_of

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node, Publisher, ServiceServer

__all__ = ["M", "NodeMirror", "NodeMirrors", "OfMessage", "OfService", "RosNodeEntities", "S"]


class OfMessage(Protocol):
    """What a mirror must know of a message type."""

    @property
    def message_class(self) -> Any:
        """Class of the messages on the graph."""

    @property
    def reliable(self) -> bool:
        """Whether slow subscriptions are waited for."""


class OfService(Protocol):
    """What a mirror must know of a service type."""

    @property
    def service_class(self) -> Any:
        """The service as the graph knows it."""


M = TypeVar("M", bound=OfMessage)


S = TypeVar("S", bound=OfService)


class RosNodeEntities(NamedTuple, Generic[M, S]):
    """What a node of real ROS offers and wants.

    Attributes:
        publishers: types by topic.
        subscribers: topic → type on the graph, `ANY_TYPE` when any is taken.
        services: types by name.
    """

    publishers: dict[str, M]
    subscribers: dict[str, str]
    services: dict[str, S]


class _Publication(NamedTuple, Generic[M]):
    kind: M
    latched: bool
    publisher: Publisher


class NodeMirror(Generic[M, S]):
    """Stands for one node.

    Attributes:
        name: the node's name in ROS.
        shares: whether the graph shows it under a name that others have too.
    """

    def __init__(
        self,
        graph: Graph,
        name: str,
        node: Node,
        answer: Callable[[str, S, Any], Any],
        *,
        shares: bool,
    ) -> None:
        """Announce nothing yet.

        Args:
            graph: where.
            name: the node's name in ROS.
            node: whose name is shown.
            answer: (service, type, request) → response, asked of ROS.
            shares: `node` belongs to others too and stays when this ends.
        """
        self.name = name
        self._graph = graph
        self._node = node
        self._answer = answer
        self.shares = shares
        self._lock = threading.RLock()
        self._closed = False
        self._publications: dict[str, _Publication[M]] = {}
        self._tokens: dict[tuple[str, str], Any] = {}
        self._services: dict[str, tuple[S, ServiceServer]] = {}

    def settle(self, ros_entities: RosNodeEntities[M, S]) -> None:
        """Announce these topics and services and no others."""
        with self._lock:
            if self._closed or self._node.closed:
                # The node's own things end with it, what was only announced does not.
                self._settle_subscribers({})
                return
            for topic in set(self._publications) - set(ros_entities.publishers):
                self._publications.pop(topic).publisher.unregister()
            for topic, kind in ros_entities.publishers.items():
                self.publisher(topic, kind, None)
            self._settle_subscribers(dict(ros_entities.subscribers))
            self._settle_services(ros_entities.services)

    def publisher(self, topic: str, kind: M, latched: bool | None) -> Publisher | None:
        """Return what publishes on a topic for the node; None after `close`.

        Args:
            topic: global name.
            kind: its type.
            latched: whether late subscriptions get the last message, None to leave it.
        """
        with self._lock:
            if self._closed or self._node.closed:
                return None
            known = self._publications.get(topic)
            keep = known is not None and latched is None
            wanted = known.latched if known is not None and keep else bool(latched)
            if known is not None and known.kind == kind and known.latched == wanted:
                return known.publisher
            if known is not None:
                known.publisher.unregister()
            made = self._node.create_publisher(
                topic, kind.message_class, latch=wanted, reliable=kind.reliable
            )
            self._publications[topic] = _Publication(kind, wanted, made)
            return made

    def speaks_through(self, node: Node) -> bool:
        """Return whether a node of the graph is this one's, and not let go."""
        return self._node is node and not self._closed

    def forget_latched(self, topic: str) -> None:
        """Drop what the topic has latched: nobody renews it while nobody listens."""
        with self._lock:
            known = self._publications.get(topic)
            if known is not None and known.latched:
                self.publisher(topic, known.kind, False)

    def close(self) -> None:
        """Take the node off the graph."""
        with self._lock:
            if self._closed:
                return
            self.settle(RosNodeEntities({}, {}, {}))
            self._closed = True
        if not self.shares:
            self._node.shutdown()

    def _settle_subscribers(self, wanted: dict[str, str]) -> None:
        for key in set(self._tokens) - set(wanted.items()):
            self._tokens.pop(key).undeclare()
        for topic, type_name in wanted.items():
            if (topic, type_name) in self._tokens:
                continue
            # Announced only: messages are taken while there is a connection to send them on.
            entity = Entity(
                self._graph.zid,
                self._node.entity.node_id,
                self._graph.next_id(),
                Kind.SUBSCRIPTION,
                self._node.name,
                topic,
                type_name,
                NO_HASH if type_name == ANY_TYPE else hash_of(type_name),
            )
            text = token(self._graph.domain, entity)
            liveliness = self._graph.session.liveliness()
            self._tokens[topic, type_name] = liveliness.declare_token(text)

    def _settle_services(self, wanted: Mapping[str, S]) -> None:
        for name in list(self._services):
            if wanted.get(name) != self._services[name][0]:
                self._services.pop(name)[1].unregister()
        for name, kind in wanted.items():
            if name not in self._services:
                server = self._node.create_service(
                    name, kind.service_class, self._answerer(name, kind)
                )
                self._services[name] = (kind, server)

    def _answerer(self, name: str, kind: S) -> Callable[[Any], Any]:
        return lambda request: self._answer(name, kind, request)


class NodeMirrors(Generic[M, S]):
    """Makes and ends mirrors; safe to use from many threads."""

    def __init__(
        self,
        graph: Graph,
        node: Node,
        answer: Callable[[str, S, Any], Any],
        on_kill: Callable[[str, str], None],
    ) -> None:
        """Start with none.

        Args:
            graph: where.
            node: the bridge's own, which stands for nodes that cannot have their own name.
            answer: (service, type, request) → response, asked of ROS.
            on_kill: (node, reason), called when somebody on the graph ends a node of ROS.
        """
        self._graph = graph
        self._node = node
        self._answer = answer
        self._on_kill = on_kill
        self._lock = threading.RLock()
        self._mirrors: dict[str, NodeMirror[M, S]] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the nodes in ROS, sorted."""
        with self._lock:
            return tuple(sorted(self._mirrors))

    def settle(self, ros_entities: dict[str, RosNodeEntities[M, S]]) -> None:
        """Show these nodes, with what they offer and want, and no others."""
        with self._lock:
            gone = [self._mirrors.pop(name) for name in set(self._mirrors) - set(ros_entities)]
            for name, mirror in list(self._mirrors.items()):
                if mirror.shares and not self._must_share(name):
                    gone.append(self._mirrors.pop(name))
        for mirror in gone:
            mirror.close()
        for name, one in ros_entities.items():
            self._mirror(name).settle(one)

    def publisher(self, name: str, topic: str, kind: M, latched: bool) -> Publisher | None:
        """Return what publishes on a topic for a node of ROS, see `NodeMirror.publisher`."""
        return self._mirror(name).publisher(topic, kind, latched)

    def forget_latched(self, topic: str) -> None:
        """Drop what nodes have latched on a topic that nobody takes over the bridge any more."""
        with self._lock:
            mirrors = tuple(self._mirrors.values())
        for mirror in mirrors:
            mirror.forget_latched(topic)

    def close(self) -> None:
        """Show none."""
        self.settle({})

    def _mirror(self, name: str) -> NodeMirror[M, S]:
        with self._lock:
            known = self._mirrors.get(name)
            if known is not None:
                return known
            shares = self._must_share(name)
            node = self._node if shares else self._make_node(name)
            made: NodeMirror[M, S] = NodeMirror(
                self._graph, name, node, self._answer, shares=shares
            )
            self._mirrors[name] = made
            return made

    def _must_share(self, name: str) -> bool:
        """Whether the name is illegal here, or ours or another's whom a second one would end."""
        if name == self._node.name or not is_legal(name) or not is_legal_base(split(name)[1]):
            return True
        own = self._graph.zid
        return any(
            one.kind is Kind.NODE and one.node == name and one.zid != own
            for one in self._graph.entities()
        )

    def _make_node(self, name: str) -> Node:
        namespace, base = split(name)
        node = self._graph.create_node(base, namespace=namespace, rosout=False)
        node.on_shutdown(lambda reason: self._on_shutdown(name, node, reason))
        return node

    def _on_shutdown(self, name: str, node: Node, reason: str) -> None:
        with self._lock:
            mirror = self._mirrors.get(name)
        # One that we let go is no longer among them.
        if mirror is not None and mirror.speaks_through(node):
            self._on_kill(name, reason)
