"""The channels: every topic of the graph, as long as it is there."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from gazelle.bridge.foxglove.feed import Feed, Topic
from gazelle.bridge.foxglove.schemas import SchemaBook
from gazelle.bridge.foxglove.server_interface import Viewers
from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.graph.names import is_hidden

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Topics"]


class Topics:
    """Keeps a feed for each topic; safe to use from many threads."""

    def __init__(
        self,
        node: Node,
        viewers: Viewers,
        book: SchemaBook,
        sim_time: Callable[[], int | None],
    ) -> None:
        """Offer nothing yet.

        Args:
            node: subscribes; its own subscriptions are no topics of the graph.
            viewers: get the channels.
            book: knows types.
            sim_time: see `Feed`.
        """
        self._node = node
        self._viewers = viewers
        self._book = book
        self._sim_time = sim_time
        self._lock = threading.RLock()
        self._feeds: dict[Topic, Feed] = {}
        self._by_number: dict[int, Feed] = {}

    @property
    def is_watched(self) -> bool:
        """Whether a viewer looks at any topic."""
        with self._lock:
            return any(one.is_open for one in self._feeds.values())

    def settle(self, entities: Iterable[Entity]) -> None:
        """Offer the topics of these entities and no others."""
        latching = _latching(entities, self._node.name)
        with self._lock:
            for topic in [one for one in self._feeds if one not in latching]:
                feed = self._feeds.pop(topic)
                del self._by_number[feed.channel.number]
                feed.close()
                feed.channel.close()
            for topic, nodes in latching.items():
                if topic not in self._feeds:
                    self._add(topic)
                if topic in self._feeds:
                    self._feeds[topic].latching = nodes

    def subscribe(self, viewer: int, number: int) -> None:
        """Let a viewer look at a channel; one that has gone meanwhile is nobody's loss."""
        with self._lock:
            feed = self._by_number.get(number)
            if feed is not None:
                feed.add(viewer)

    def unsubscribe(self, viewer: int, number: int) -> None:
        """Let a viewer look no more."""
        with self._lock:
            feed = self._by_number.get(number)
            if feed is not None:
                feed.remove(viewer)

    def close(self) -> None:
        """Take all channels off."""
        self.settle(())

    def _add(self, topic: Topic) -> None:
        schema = self._book.message(topic.type_name, f"topic {topic.name}")
        if schema is None:
            return
        channel = self._viewers.add_channel(topic.name, topic.type_name, schema)
        feed = Feed(self._node, topic, channel, self._sim_time)
        self._feeds[topic] = feed
        self._by_number[channel.number] = feed


def _latching(entities: Iterable[Entity], own: str) -> dict[Topic, frozenset[str]]:
    """Return the topics, and which nodes latch each."""
    found: dict[Topic, frozenset[str]] = {}
    for one in entities:
        is_own_ear = one.kind is Kind.SUBSCRIPTION and one.node == own
        if one.kind not in (Kind.PUBLISHER, Kind.SUBSCRIPTION) or is_own_ear:
            continue
        if is_hidden(one.name) or one.type_name == ANY_TYPE:
            continue
        latches = one.kind is Kind.PUBLISHER and one.qos.latched
        topic = Topic(one.name, one.type_name)
        found[topic] = found.get(topic, frozenset()) | ({one.node} if latches else frozenset())
    return found
