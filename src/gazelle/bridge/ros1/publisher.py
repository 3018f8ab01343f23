"""A topic of the graph on its way to subscribers in ROS 1."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from gazelle.bag.message_definitions import fetch_text
from gazelle.bridge.raw_subscription import RawSubscription, Sample
from gazelle.bridge.ros1.subscriber_link import SubscriberLink
from gazelle.bridge.ros1.tcpros import send_all, write_header
from gazelle.bridge.ros1.types import Frame, MessageKind, message_kind
from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE
from gazelle.interfaces import RosVersion, ros1_definition

if TYPE_CHECKING:
    from gazelle.graph import Graph

__all__ = ["PublishedTopic", "TcprosPublisher"]


class PublishedTopic(NamedTuple):
    """A topic as one node of the graph publishes it.

    Attributes:
        node: the node's global name on the graph.
        kind: the type.
        latched: whether late subscriptions get the last message.
    """

    node: str
    kind: MessageKind
    latched: bool


class TcprosPublisher:
    """Sends one topic to all who are connected; listens on the graph only while some are."""

    def __init__(self, graph: Graph, topic: str, notice: Callable[[str], None]) -> None:
        """Wait for connections."""
        self.topic = topic
        self._graph = graph
        self._notice = notice
        self._lock = threading.Lock()
        self._links: dict[str, list[SubscriberLink]] = {}
        self._last: dict[str, Frame] = {}
        self._raw_subscription: RawSubscription | None = None
        self._refused: set[str] = set()

    def serve(
        self, stream: socket.socket, header: dict[str, str], offer: PublishedTopic, name: str
    ) -> None:
        """Send what a node publishes over a connection, until the other side closes it.

        Args:
            stream: the connection, its header already read.
            header: what the subscriber sent.
            offer: the topic of the node that it asked.
            name: the node's name in ROS 1.
        """
        problem = _mismatch(header, offer.kind, self.topic)
        if problem:
            send_all(stream, [write_header({"error": problem})])
            self._notice(f"{header.get('callerid', 'a subscriber')}: {problem}")
            return
        link = SubscriberLink(stream, header.get("callerid", ""), self.topic)
        self._add(link, offer.node)
        try:
            fetch_text(self._graph, offer.kind.ros1_name, RosVersion.ROS1)
            link.start(write_header(_answer(offer, self.topic, name)))
            link.wait()
        finally:
            self._remove(link, offer.node)
            link.close()

    def links(self, node: str) -> list[SubscriberLink]:
        """Return the connections that carry what a node publishes."""
        with self._lock:
            return list(self._links.get(node, ()))

    def forget(self, node: str) -> None:
        """End the connections of a node that does not publish the topic any more."""
        with self._lock:
            self._last.pop(node, None)
            links = list(self._links.get(node, ()))
        for one in links:
            one.close()

    def close(self) -> None:
        """End all connections."""
        with self._lock:
            nodes = list(self._links)
        for node in nodes:
            self.forget(node)

    def _add(self, link: SubscriberLink, node: str) -> None:
        with self._lock:
            if node in self._last:
                link.put(self._last[node])
            self._links.setdefault(node, []).append(link)
            if self._raw_subscription is None:
                self._raw_subscription = RawSubscription(self._graph, self.topic, self._on_sample)

    def _remove(self, link: SubscriberLink, node: str) -> None:
        raw_subscription = None
        with self._lock:
            links = self._links.get(node, [])
            if link in links:
                links.remove(link)
            if not links:
                self._links.pop(node, None)
            if not self._links:
                raw_subscription, self._raw_subscription = self._raw_subscription, None
                self._last.clear()
        if raw_subscription is not None:
            raw_subscription.close()

    def _on_sample(self, sample: Sample) -> None:
        with self._lock:
            # Somebody who has left before he was known still spoke for one of them.
            node = sample.publisher or next(iter(self._links), "")
            links = tuple(self._links.get(node, ()))
        if not links and not sample.latched:
            return
        try:
            frame = message_kind(sample.type_name).to_frame(sample.cdr, sample.sequence)
        except GazelleError as error:
            self._refuse(sample.type_name, error)
            return
        with self._lock:
            if sample.latched:
                self._last[node] = frame
                links = tuple(self._links.get(node, ()))
        for link in links:
            link.put(frame)

    def _refuse(self, type_name: str, error: GazelleError) -> None:
        if type_name not in self._refused:
            self._refused.add(type_name)
            self._notice(f"messages on {self.topic} do not reach ROS 1: {error}")


def _mismatch(header: dict[str, str], kind: MessageKind, topic: str) -> str:
    """Return why this subscriber cannot have the topic, in rospy's words; empty when it can."""
    for field in ("md5sum", "topic"):
        if field not in header:
            return f"Missing required '{field}' field"
    if header["md5sum"] in (ANY_TYPE, kind.md5):
        return ""
    subscriber, wanted = header.get("callerid", "?"), header.get("type", "?")
    return (
        f"Client [{subscriber}] wants topic [{topic}] to have datatype/md5sum "
        f"[{wanted}/{header['md5sum']}], but our version has [{kind.ros1_name}/{kind.md5}] "
        "Dropping connection."
    )


def _answer(offer: PublishedTopic, topic: str, name: str) -> dict[str, str]:
    return {
        "callerid": name,
        "latching": str(int(offer.latched)),
        "md5sum": offer.kind.md5,
        "message_definition": ros1_definition(offer.kind.ros1_name),
        "topic": topic,
        "type": offer.kind.ros1_name,
    }
