"""The graph as ROS sees it: nodes, topics and services that stand for those of the graph."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.bridge.raw_subscription import RawSubscription, Sample
from gazelle.bridge.ros2.mirror_plan import BRIDGE_NAME, GraphEntities, TopicOfNode
from gazelle.bridge.ros2.qos import QosProfile, widened
from gazelle.bridge.ros2.rclpy_process import RclpyLink
from gazelle.bridge.ros2.ros2_graph import RosState
from gazelle.bridge.ros2.types import ServiceKind, TypeBook
from gazelle.errors import GazelleError
from gazelle.interfaces import from_cdr, to_cdr

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node, ServiceClient

__all__ = ["ToRos"]


class _Served(NamedTuple):
    name: str
    kind: ServiceKind
    client: ServiceClient


class _Channel(NamedTuple):
    number: int
    qos: QosProfile


class ToRos:
    """Keeps ROS's view of the graph current; `settle` is called from one thread."""

    def __init__(
        self,
        graph: Graph,
        node: Node,
        link: RclpyLink,
        book: TypeBook,
        notice: Callable[[str], None],
    ) -> None:
        """Show nothing yet.

        Args:
            graph: what is shown.
            node: the bridge's own, which calls services.
            link: to ROS.
            book: knows which types do not cross.
            notice: told of what goes wrong.
        """
        self._graph = graph
        self._node = node
        self._link = link
        self._book = book
        self._notice = notice
        self._lock = threading.Lock()
        self._nodes: set[str] = {BRIDGE_NAME}
        self._names: dict[str, str] = {}
        self._publishers: dict[TopicOfNode, _Channel] = {}
        self._services: dict[tuple[str, str], int] = {}
        self._served: dict[int, _Served] = {}
        self._ready: set[int] = set()
        self._raw_subscriptions: dict[str, RawSubscription] = {}
        self._told: set[tuple[str, str]] = set()

    @property
    def names(self) -> tuple[str, ...]:
        """Names in ROS of the graph's nodes."""
        return tuple(sorted(self._nodes - {BRIDGE_NAME}))

    def settle(self, graph_entities: GraphEntities, state: RosState) -> None:
        """Show these nodes, topics and services and no others; listen to what is wanted."""
        self._names = graph_entities.nodes
        names = {*graph_entities.nodes.values(), BRIDGE_NAME}
        for name in sorted(names - self._nodes):
            self._link.do("node", node=name)
        publishers = self._settle_publishers(graph_entities, state)
        self._settle_services(graph_entities)
        for name in sorted(self._nodes - names):
            self._link.do("unnode", node=name)
        self._nodes = names
        self._settle_taps(publishers, state)

    def channel_is_ready(self, channel: int) -> None:
        """Learn that ROS has made what was asked for."""
        with self._lock:
            self._ready.add(channel)

    def owner_of(self, channel: int) -> tuple[str, str] | None:
        """Return what a channel is for, and its type, in words; None when it is not from here."""
        with self._lock:
            for key, one in self._publishers.items():
                if one.number == channel:
                    return f"topic {key.topic} of {key.node}", key.type_name
            served = self._served.get(channel)
        return served and (f"service {served.name}", served.kind.type_name)

    def take_request(self, channel: int, number: int, cdr: bytes) -> None:
        """Answer a call from ROS, in a thread of its own."""
        served = self._served.get(channel)
        if served is None:
            self._link.respond(channel, number, None)
            return
        work = (served, channel, number, cdr)
        threading.Thread(target=self._answer, args=work, daemon=True).start()

    def close(self) -> None:
        """Listen to nothing any more."""
        for raw_subscription in self._raw_subscriptions.values():
            raw_subscription.close()
        self._raw_subscriptions = {}
        for served in self._served.values():
            served.client.unregister()
        self._served = {}

    def _settle_publishers(
        self, graph_entities: GraphEntities, state: RosState
    ) -> dict[TopicOfNode, QosProfile]:
        wanted: dict[TopicOfNode, QosProfile] = {}
        for key, own in graph_entities.publishers.items():
            if self._book.is_missing(key.type_name):
                continue
            asked = [end for end in state.subscriptions if end.topic == key.topic]
            qos, told = widened(key.node, key.topic, own, asked)
            wanted[key] = qos
            for policy, text in told.items():
                if (key.topic, policy) not in self._told:
                    self._told.add((key.topic, policy))
                    self._notice(text)
        for key in [key for key in self._publishers if self._publishers[key][1] != wanted.get(key)]:
            with self._lock:
                gone = self._publishers.pop(key)
            self._link.drop(gone.number)
        for key, qos in wanted.items():
            if key not in self._publishers:
                self._add_publisher(key, qos)
        return wanted

    def _add_publisher(self, key: TopicOfNode, qos: QosProfile) -> None:
        # The report of how it went comes in another thread, which must find it entered.
        with self._lock:
            made = self._link.do(
                "publisher",
                node=key.node,
                topic=key.topic,
                type=key.type_name,
                **qos._asdict(),
            )
            self._publishers[key] = _Channel(made, qos)

    def _settle_services(self, graph_entities: GraphEntities) -> None:
        for key in set(self._services) - set(graph_entities.services):
            channel = self._services.pop(key)
            self._link.drop(channel)
            served = self._served.pop(channel, None)
            if served is not None:
                served.client.unregister()
        for key, type_name in graph_entities.services.items():
            if key not in self._services and not self._book.is_missing(type_name):
                self._add_service(key, type_name)

    def _add_service(self, key: tuple[str, str], type_name: str) -> None:
        node, name = key
        kind = self._book.service(type_name, f"service {name} of {node}")
        if kind is None:
            return
        client = self._node.create_client(name, kind.service_class)
        with self._lock:
            channel = self._link.do("service", node=node, topic=name, type=type_name)
            self._services[key] = channel
            self._served[channel] = _Served(name, kind, client)

    def _settle_taps(self, publishers: dict[TopicOfNode, QosProfile], state: RosState) -> None:
        asked = {end.topic for end in state.subscriptions}
        with self._lock:
            ready = {
                key.topic for key, one in self._publishers.items() if one.number in self._ready
            }
        wanted = {
            key.topic
            for key, qos in publishers.items()
            # What is latched waits in ROS for whoever comes late.
            if key.topic in ready and (key.topic in asked or qos.latched)
        }
        for topic in set(self._raw_subscriptions) - wanted:
            self._raw_subscriptions.pop(topic).close()
        for topic in wanted - set(self._raw_subscriptions):
            self._raw_subscriptions[topic] = RawSubscription(
                self._graph, topic, self._on_sample(topic)
            )

    def _on_sample(self, topic: str) -> Callable[[Sample], None]:
        def send(sample: Sample) -> None:
            node = self._names.get(sample.publisher, "")
            with self._lock:
                found = self._publishers.get(TopicOfNode(node, topic, sample.type_name))
                # Somebody who has left before he was known still spoke for one of them.
                found = found or next(
                    (
                        one
                        for key, one in self._publishers.items()
                        if key[1:] == (topic, sample.type_name)
                    ),
                    None,
                )
            if found is not None:
                self._link.publish(found.number, sample.cdr)

        return send

    def _answer(self, served: _Served, channel: int, number: int, cdr: bytes) -> None:
        service: Any = served.kind.service_class
        try:
            response = served.client.call(from_cdr(service.Request, cdr))
            answer: bytes | None = to_cdr(response)
        except GazelleError as error:
            answer = None
            self._notice(
                f"a call from ROS 2 got no answer, and ROS 2 has no way to say so: {error}"
            )
        self._link.respond(channel, number, answer)
