"""The channels: every topic of the graph with its schema, open while a viewer looks at it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple

from gazelle.bridge.foxglove.server_interface import Channel, Viewers
from gazelle.errors import GazelleError, NotFoundError
from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.graph.names import is_hidden
from gazelle.interfaces import ros2_definition

if TYPE_CHECKING:
    from gazelle.graph import MessageInfo, Node, RawMessage, Subscription

__all__ = ["Feed", "SchemaBook", "Topic", "Topics"]

_WAITING = 50


class Topic(NamedTuple):
    """A topic by global name and type (``pkg/msg/Name``); two types are two topics."""

    name: str
    type_name: str


class _Frame(NamedTuple):
    data: bytes
    stamp_ns: int


class Feed:
    """Carries one topic to its channel.

    Attributes:
        topic: what is carried.
        channel: where it goes.
        latching: nodes whose last message late viewers get too.
    """

    def __init__(
        self,
        node: Node,
        topic: Topic,
        channel: Channel,
        sim_time: Callable[[], int | None],
    ) -> None:
        """Wait for viewers.

        Args:
            node: subscribes.
            topic: see the class.
            channel: see the class.
            sim_time: gives simulated time in nanoseconds, None where wall time counts.
        """
        self.topic = topic
        self.channel = channel
        self.latching: frozenset[str] = frozenset()
        self._node = node
        self._sim_time = sim_time
        self._lock = threading.Lock()
        self._viewers: set[int] = set()
        self._last: dict[str, _Frame] = {}
        self._subscription: Subscription | None = None

    @property
    def is_open(self) -> bool:
        """Whether a viewer looks."""
        return bool(self._viewers)

    def add(self, viewer: int) -> None:
        """Let a viewer look; he gets what was latched."""
        with self._lock:
            is_first = not self._viewers
            self._viewers.add(viewer)
            # The server cannot send to one viewer alone: the others get it once more, as they
            # would from a node that publishes it again.
            late = [self._last[node] for node in self._last if node in self.latching]
        for frame in late:
            self.channel.send(frame.data, frame.stamp_ns)
        if is_first:
            self._subscription = self._node.create_subscription(
                self.topic.name,
                None,
                self._on_message,
                raw=True,
                with_info=True,
                queue_size=_WAITING,
                announced=self.topic.type_name,
            )

    def remove(self, viewer: int) -> None:
        """Forget a viewer; with the last one the graph is listened to no more."""
        with self._lock:
            self._viewers.discard(viewer)
            if self._viewers:
                return
            subscription, self._subscription = self._subscription, None
            self._last.clear()
        if subscription is not None:
            subscription.unregister()

    def close(self) -> None:
        """Forget all viewers."""
        for viewer in tuple(self._viewers):
            self.remove(viewer)

    def _on_message(self, message: RawMessage, info: MessageInfo) -> None:
        if message.type_name != self.topic.type_name:
            return
        sim_ns = self._sim_time()
        frame = _Frame(message.data, info.stamp_ns if sim_ns is None else sim_ns)
        with self._lock:
            if not self._viewers:
                return
            self._last[info.publisher] = frame
        self.channel.send(frame.data, frame.stamp_ns)


class SchemaBook:
    """Looks schemas up and tells once of each type that viewers cannot have."""

    def __init__(self, notice: Callable[[str], None]) -> None:
        """Know nothing yet.

        Args:
            notice: told what viewers cannot have.
        """
        self._notice = notice
        self._told: set[str] = set()

    def message(self, type_name: str, where: str) -> str | None:
        """Return a type's ``ros2msg`` schema, None where viewers cannot have it.

        Args:
            type_name: ``pkg/msg/Name``, or ``pkg/srv/Name_Request``.
            where: what has that type, for the notice.
        """
        try:
            return ros2_definition(type_name)
        except NotFoundError:
            text = (
                f"{where} is not shown: nothing here defines its type {type_name}\n"
                "  fix: start the bridge where the package that defines it is found"
            )
        except GazelleError as error:
            text = f"{where} is not shown: {error}"
        if type_name not in self._told:
            self._told.add(type_name)
            self._notice(text)
        return None


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
