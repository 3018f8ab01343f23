"""One topic's way to the viewers, open only while one of them looks."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from gazelle.bridge.foxglove.server_interface import Channel

if TYPE_CHECKING:
    from gazelle.graph import MessageInfo, Node, RawMessage, Subscription

__all__ = ["Feed", "Topic"]

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
