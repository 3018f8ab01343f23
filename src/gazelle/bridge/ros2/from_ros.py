"""ROS as the graph sees it: nodes, topics and services that stand for those of ROS."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.bridge.node_mirrors import NodeMirrors, RosNodeEntities
from gazelle.bridge.ros2.mirror_plan import BRIDGE_NAME, GraphEntities, TopicOfType, crosses
from gazelle.bridge.ros2.qos import QosProfile, request_for
from gazelle.bridge.ros2.rclpy_process import RclpyLink
from gazelle.bridge.ros2.ros2_graph import NOTHING, RosState
from gazelle.bridge.ros2.types import MessageKind, ServiceKind, TypeBook
from gazelle.errors import GazelleError
from gazelle.interfaces import from_cdr, to_cdr

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node, Publisher

__all__ = ["FromRos"]

_MATCH_S = 0.3
_MATCH_PERIOD_S = 0.002


class _Asked(NamedTuple):
    channel: int
    node: str
    qos: QosProfile


class _Publication(NamedTuple):
    kind: MessageKind
    latched: bool


class FromRos:
    """Keeps the graph's view of ROS current; `settle` is called from one thread."""

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
            graph: where it is shown.
            node: the bridge's own.
            link: to ROS.
            book: looks types up.
            notice: told of what goes wrong.
        """
        self._link = link
        self._book = book
        self._notice = notice
        self._mirrors: NodeMirrors[MessageKind, ServiceKind] = NodeMirrors(
            graph, node, self._call, self._end_in_ros
        )
        self._lock = threading.Lock()
        self._state = NOTHING
        self._publisher_nodes: dict[int, str] = {}
        self._publications: dict[tuple[str, str], _Publication] = {}
        self._asked: dict[TopicOfType, _Asked] = {}
        self._topics: dict[int, TopicOfType] = {}
        self._clients: dict[str, int] = {}
        self._heard: set[bytes] = set()
        self._told: set[tuple[str, str]] = set()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of ROS's nodes on the graph."""
        return self._mirrors.names

    def settle(self, graph_entities: GraphEntities, state: RosState) -> None:
        """Show what ROS has; take the topics from it that the graph wants."""
        self._state = state
        self._publisher_nodes = {one.number: one.node for one in state.publishers}
        ros_entities = self._ros_entities_of(state)
        latched = {(one.node, one.topic) for one in state.publishers if one.latched}
        self._publications = {
            (node, topic): _Publication(kind, (node, topic) in latched)
            for node, one in ros_entities.items()
            for topic, kind in one.publishers.items()
        }
        self._mirrors.settle(ros_entities)
        for node, topic in latched & set(self._publications):
            self._mirrors.publisher(node, topic, self._publications[node, topic].kind, True)
        self._settle_topics(graph_entities, state)
        self._settle_clients(state)

    def owner_of(self, channel: int) -> tuple[str, str] | None:
        """Return what a channel is for, and its type, in words; None when it is not from here."""
        with self._lock:
            wanted = self._topics.get(channel)
        return wanted and (f"topic {wanted.topic}", wanted.type_name)

    def take_message(self, channel: int, number: int, cdr: bytes) -> None:
        """Publish what a publisher in ROS has sent."""
        with self._lock:
            wanted = self._topics.get(channel)
        if wanted is None:
            return
        try:
            publisher = self._publisher_of(wanted, number)
            if publisher is None:
                return
            if publisher.gid not in self._heard:
                self._heard.add(publisher.gid)
                _await_match(publisher)
            publisher.publish_raw(cdr)
        except GazelleError as error:
            self._tell(wanted.topic, "message", f"a message on {wanted.topic} is lost: {error}")

    def close(self) -> None:
        """Take everything of ROS off the graph."""
        self._mirrors.close()

    def _ros_entities_of(
        self, state: RosState
    ) -> dict[str, RosNodeEntities[MessageKind, ServiceKind]]:
        found: dict[str, RosNodeEntities[MessageKind, ServiceKind]] = {
            name: RosNodeEntities({}, {}, {}) for name in state.nodes
        }
        for end in state.publishers:
            ros_entities = found.setdefault(end.node, RosNodeEntities({}, {}, {}))
            if crosses(end.topic, end.type_name):
                where = f"topic {end.topic} of {end.node}"
                kind = self._book.message(end.type_name, where, reliable=end.reliable)
                if kind is not None:
                    ros_entities.publishers[end.topic] = kind
        for end in state.subscriptions:
            ros_entities = found.setdefault(end.node, RosNodeEntities({}, {}, {}))
            if crosses(end.topic, end.type_name):
                ros_entities.subscribers[end.topic] = end.type_name
        for node, name, type_name in state.services:
            if crosses(name, type_name):
                service = self._book.service(type_name, f"service {name} of {node}")
                if service is not None:
                    found[node].services[name] = service
        return found

    def _settle_topics(self, graph_entities: GraphEntities, state: RosState) -> None:
        wanted: dict[TopicOfType, tuple[str, QosProfile]] = {}
        for key, node in graph_entities.subscriptions.items():
            ends = [one for one in state.publishers if (one.topic, one.type_name) == key]
            qos, told = request_for(key.topic, ends)
            for policy, text in told.items():
                self._tell(key.topic, policy, text)
            if not self._book.is_missing(key.type_name):
                wanted[key] = (node, qos)
        for key, asked in list(self._asked.items()):
            if wanted.get(key) != (asked.node, asked.qos):
                self._give_up(key, asked, is_wanted=key in wanted)
        for key, (node, qos) in wanted.items():
            if key not in self._asked:
                self._ask(key, node, qos)

    def _ask(self, key: TopicOfType, node: str, qos: QosProfile) -> None:
        with self._lock:
            channel = self._link.do(
                "subscription",
                node=node,
                topic=key.topic,
                type=key.type_name,
                **qos._asdict(),
            )
            self._asked[key] = _Asked(channel, node, qos)
            self._topics[channel] = key

    def _give_up(self, key: TopicOfType, asked: _Asked, *, is_wanted: bool) -> None:
        with self._lock:
            self._topics.pop(asked.channel, None)
            del self._asked[key]
        self._link.drop(asked.channel)
        if not is_wanted:
            self._mirrors.forget_latched(key.topic)

    def _settle_clients(self, state: RosState) -> None:
        there = {one.name for one in state.services}
        with self._lock:
            gone = [self._clients.pop(name) for name in set(self._clients) - there]
        for channel in gone:
            self._link.drop(channel)

    def _publisher_of(self, wanted: TopicOfType, number: int) -> Publisher | None:
        topic, type_name = wanted
        node = self._publisher_nodes.get(number) or self._only_publisher(wanted)
        found = self._publications.get((node, topic))
        if found is not None and found.kind.type_name == type_name:
            return self._mirrors.publisher(node, topic, found.kind, found.latched)
        # It speaks before ROS has told of it.
        kind = self._book.message(type_name, f"topic {topic}", reliable=True)
        return kind and self._mirrors.publisher(BRIDGE_NAME, topic, kind, False)

    def _only_publisher(self, wanted: TopicOfType) -> str:
        """Whoever speaks when nobody says: an older rclpy, or a publisher that is just new."""
        found = (one.node for one in self._state.publishers if one[1:3] == wanted)
        return next(found, BRIDGE_NAME)

    def _call(self, name: str, kind: ServiceKind, request: Any) -> Any:
        with self._lock:
            channel = self._clients.get(name)
            if channel is None:
                channel = self._link.do("client", topic=name, type=kind.type_name)
                self._clients[name] = channel
        return from_cdr(kind.service_class.Response, self._link.call(channel, to_cdr(request)))

    def _end_in_ros(self, name: str, reason: str) -> None:
        self._tell(name, "end", f"{name} runs in ROS 2, where nobody can end a node from outside")

    def _tell(self, what: str, why: str, text: str) -> None:
        if (what, why) not in self._told:
            self._told.add((what, why))
            self._notice(text)


def _await_match(publisher: Publisher) -> None:
    """Wait a moment for those who listen: the first message of a publisher may be its only one."""
    due_s = time.monotonic() + _MATCH_S
    while not publisher.matched and time.monotonic() < due_s:
        time.sleep(_MATCH_PERIOD_S)
