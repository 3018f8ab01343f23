"""What moves over the bridge: messages, calls of services, ends of nodes."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

from gazelle.bridge.ros1.addresses import Address
from gazelle.bridge.ros1.publisher import PublishedTopic, TcprosPublisher
from gazelle.bridge.ros1.services import serve_requests
from gazelle.bridge.ros1.subscriber import PublisherOf, TcprosSubscriber
from gazelle.bridge.ros1.subscriber_link import SubscriberLink
from gazelle.bridge.ros1.types import ServiceKind
from gazelle.errors import GazelleError
from gazelle.graph.errors import ServiceCallError, ServiceRefusedError

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node

__all__ = ["Connections"]


class Connections:
    """The traffic of all nodes; safe to use from many threads.

    Attributes:
        master_uri: where the master is.
        address: what servers of the bridge bind to and are called.
        own_uris: slave servers of the bridge itself, which are no publishers of ROS 1.
    """

    def __init__(
        self,
        graph: Graph,
        node: Node,
        address: Address,
        master_uri: str,
        publisher_of: PublisherOf,
    ) -> None:
        """Carry nothing yet.

        Args:
            graph: the graph.
            node: the bridge's own, which calls services and tells what goes wrong.
            address: see the class.
            master_uri: see the class.
            publisher_of: finds what speaks on the graph for a node of ROS 1.
        """
        self.master_uri = master_uri
        self.address = address
        self.own_uris: set[str] = set()
        self.on_parameter: Callable[[str, Any], None] = lambda name, value: None
        self._graph = graph
        self._node = node
        self._publisher_of = publisher_of
        self._lock = threading.RLock()
        self._publishers: dict[str, TcprosPublisher] = {}
        self._subscribers: dict[str, TcprosSubscriber] = {}

    def serve_topic(
        self, stream: socket.socket, header: dict[str, str], offer: PublishedTopic, name: str
    ) -> None:
        """Send a topic over a connection until the other side closes it."""
        topic = header["topic"]
        with self._lock:
            publisher = self._publishers.get(topic)
            if publisher is None:
                publisher = self._publishers[topic] = TcprosPublisher(
                    self._graph, topic, self.notice
                )
        publisher.serve(stream, header, offer, name)

    def serve_service(
        self, stream: socket.socket, header: dict[str, str], kind: ServiceKind, name: str
    ) -> None:
        """Answer calls over a connection until the other side closes it."""
        service = header["service"]
        client = self._node.create_client(service, kind.service_class)

        def answer(request: Any) -> Any:
            try:
                return client.call(request)
            except ServiceCallError as error:
                text = str(error).removeprefix(f"service [{service}] responded with an error: ")
                raise ServiceRefusedError(text) from error

        try:
            serve_requests(stream, header, kind, name, answer)
        finally:
            client.unregister()

    def take_topic(self, topic: str, uris: list[str], name: str) -> None:
        """Learn where a topic is published in ROS 1.

        Args:
            topic: global name.
            uris: slave servers of its publishers.
            name: of a node of the graph that wants it.
        """
        with self._lock:
            subscriber = self._subscribers.get(topic)
            if subscriber is None:
                subscriber = TcprosSubscriber(topic, name, self._publisher_of, self.notice)
                self._subscribers[topic] = subscriber
            subscriber.update(uri for uri in uris if uri not in self.own_uris)

    def keep_topics(self, wanted: Collection[str]) -> list[str]:
        """Take no other topics any more; return those given up."""
        with self._lock:
            gone = [topic for topic in self._subscribers if topic not in wanted]
            for topic in gone:
                self._subscribers.pop(topic).close()
        return gone

    def forget_published(self, node: str, topics: Collection[str]) -> None:
        """End the connections of topics that a node of the graph publishes no more."""
        with self._lock:
            publishers = [self._publishers[topic] for topic in topics if topic in self._publishers]
        for publisher in publishers:
            publisher.forget(node)

    def links_of(self, node: str) -> list[tuple[str, SubscriberLink]]:
        """Return topic and connection of all that carries what a node publishes."""
        with self._lock:
            publishers = list(self._publishers.values())
        return [
            (publisher.topic, link) for publisher in publishers for link in publisher.links(node)
        ]

    def connections_of(self, topics: Collection[str]) -> list[tuple[str, str]]:
        """Return topic and publisher of the connections that bring these topics."""
        with self._lock:
            subscribers = [
                self._subscribers[topic] for topic in topics if topic in self._subscribers
            ]
        return [
            (subscriber.topic, one[0])
            for subscriber in subscribers
            for one in subscriber.connections
        ]

    def end_node(self, node: str, reason: str) -> None:
        """End a node of the graph, some time soon."""
        threading.Thread(target=self._end_node, args=(node, reason), daemon=True).start()

    def process_of(self, node: str) -> int:
        """Return the process of a node of the graph, 0 when it is not known."""
        try:
            return self._graph.node_info(node).pid
        except GazelleError:
            return 0

    def changed_parameter(self, name: str, value: Any) -> None:
        """Learn of a parameter's new value from the master."""
        self.on_parameter(name, value)

    def notice(self, text: str) -> None:
        """Tell the user."""
        if not self._node.closed:
            self._node.log("warn", text)

    def close(self) -> None:
        """End all connections."""
        self.keep_topics(())
        with self._lock:
            publishers, self._publishers = self._publishers, {}
        for publisher in publishers.values():
            publisher.close()

    def _end_node(self, node: str, reason: str) -> None:
        try:
            self._graph.kill_node(node, reason)
        except GazelleError:
            # It has gone by itself in the meantime.
            return
