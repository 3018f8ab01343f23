"""Topics as the page listens to them: one raw subscription for all who look at a topic."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from gazelle.graph import ANY_TYPE, MessageInfo, Node, RawMessage
from gazelle.interfaces import Message, from_cdr, message_type

if TYPE_CHECKING:
    from gazelle.graph import Subscription

__all__ = ["Sample", "Taps"]


class Sample(NamedTuple):
    """A message that came, not decoded yet.

    Attributes:
        raw: its bytes and type.
        info: where it came from.
    """

    raw: RawMessage
    info: MessageInfo

    def message(self) -> Message:
        """Decode it.

        Raises:
            InterfaceError: the bytes are not of the type.
            NotFoundError: nothing defines the type.
        """
        return from_cdr(message_type(self.raw.type_name), self.raw.data)


Listener = Callable[[Sample], None]


class _Tap:
    def __init__(self) -> None:
        self.listeners: tuple[Listener, ...] = ()
        self.subscription: Subscription | None = None
        self.last: Sample | None = None


class Taps:
    """Subscriptions of the topics that somebody looks at.

    Listeners are called in the transport's threads: they keep the sample and go.
    """

    def __init__(self, node: Node) -> None:
        """Subscribe as `node`."""
        self._node = node
        self._lock = threading.Lock()
        self._taps: dict[str, _Tap] = {}

    @property
    def topics(self) -> tuple[str, ...]:
        """The topics that are listened to."""
        with self._lock:
            return tuple(self._taps)

    def listen(self, topic: str, listener: Listener) -> Callable[[], None]:
        """Call `listener` with every message from now on; returns what ends that.

        Who comes later gets the last message at once, as a latched topic would give it.

        Raises:
            IllegalNameError: the topic's name is not legal.
        """
        topic = self._node.resolve_name(topic)
        with self._lock:
            tap = self._taps.get(topic)
            if tap is None:
                tap = self._taps[topic] = _Tap()
                tap.subscription = self._subscribe(topic, tap)
            tap.listeners += (listener,)
            last = tap.last
        if last is not None:
            listener(last)
        return lambda: self._leave(topic, tap, listener)

    def _subscribe(self, topic: str, tap: _Tap) -> Subscription:
        def take(raw: RawMessage, info: MessageInfo) -> None:
            sample = Sample(raw, info)
            tap.last = sample
            for listener in tap.listeners:
                listener(sample)

        known = self._node.graph.discovery.known()
        types = [one.type_name for one in known if one.name == topic and one.type_name != ANY_TYPE]
        return self._node.create_subscription(
            topic,
            None,
            take,
            raw=True,
            with_info=True,
            inline=True,
            announced=types[0] if types else "",
        )

    def _leave(self, topic: str, tap: _Tap, listener: Listener) -> None:
        with self._lock:
            tap.listeners = tuple(one for one in tap.listeners if one is not listener)
            over = not tap.listeners and self._taps.get(topic) is tap
            if over:
                del self._taps[topic]
        if over and tap.subscription is not None:
            tap.subscription.unregister()
