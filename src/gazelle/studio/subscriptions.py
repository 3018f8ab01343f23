"""Topics as the page listens to them: one raw subscription for all who look at a topic."""

from __future__ import annotations

import struct
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE, MessageInfo, Node, RawMessage
from gazelle.interfaces import Message, from_cdr, message_type
from gazelle.interfaces.definition import Array
from gazelle.interfaces.stamps import seconds_of
from gazelle.studio.errors import StudioError

if TYPE_CHECKING:
    from gazelle.graph import Subscription

__all__ = ["Arrival", "Listener", "Sample", "Subscriptions", "stamp_s", "topic_name"]

_MAX_ARRIVALS = 5000
_HEADER = "std_msgs/msg/Header"
_STAMP = (struct.Struct("<iI"), struct.Struct(">iI"))
_STAMP_PLACE = 4


def stamp_s(message: Any, arrived_s: float) -> float:
    """Return when a message is from: its header's time, else when it came, seconds."""
    header = getattr(message, "header", None)
    stamp = getattr(header, "stamp", None)
    if stamp is not None and (stamp.sec or stamp.nanosec):
        return seconds_of(stamp)
    return arrived_s


class Sample(NamedTuple):
    """A message that came, not decoded yet.

    Attributes:
        raw: its bytes and type.
        info: where it came from.
        time_s: when it came, on the graph's clock, seconds.
    """

    raw: RawMessage
    info: MessageInfo
    time_s: float

    def message(self) -> Message:
        """Decode it.

        Raises:
            InterfaceError: the bytes are not of the type.
            NotFoundError: nothing defines the type.
        """
        return from_cdr(message_type(self.raw.type_name), self.raw.data)


class Arrival(NamedTuple):
    """A message as it is counted: when it came (monotonic), how long it is, how old it was."""

    wall_s: float
    size_bytes: int
    delay_s: float | None


class _SharedSubscription:
    def __init__(self) -> None:
        self.listeners: tuple[Listener, ...] = ()
        self.subscription: Subscription | None = None
        self.last: Sample | None = None
        self.count = 0
        self.arrivals: deque[Arrival] = deque(maxlen=_MAX_ARRIVALS)
        self.has_header = False


class Subscriptions:
    """Subscriptions of the topics that somebody looks at.

    Listeners are called in the transport's threads: they keep the sample and go.

    Attributes:
        node: who subscribes.
    """

    def __init__(self, node: Node) -> None:
        """Subscribe as `node`."""
        self.node = node
        self._lock = threading.Lock()
        self._subscriptions: dict[str, _SharedSubscription] = {}

    @property
    def topics(self) -> tuple[str, ...]:
        """The topics that are listened to."""
        with self._lock:
            return tuple(self._subscriptions)

    def listen(self, topic: str, listener: Listener) -> Callable[[], None]:
        """Call `listener` with every message from now on; returns what ends that.

        Who comes later gets the last message at once, as a latched topic would give it.

        Raises:
            StudioError: the topic has no name.
            IllegalNameError: its name is not legal.
        """
        topic = topic_name(self.node, topic)
        with self._lock:
            tap = self._subscriptions.get(topic)
            if tap is None:
                tap = _SharedSubscription()
                tap.subscription = self._subscribe(topic, tap)
                self._subscriptions[topic] = tap
            tap.listeners += (listener,)
            last = tap.last
        if last is not None:
            listener(last)
        return lambda: self._leave(topic, tap, listener)

    def arrivals(self, topic: str) -> tuple[int, tuple[Arrival, ...]]:
        """Return how many messages of a topic came, and the last of them one by one."""
        with self._lock:
            tap = self._subscriptions.get(topic)
        return (tap.count, tuple(tap.arrivals)) if tap else (0, ())

    def _subscribe(self, topic: str, tap: _SharedSubscription) -> Subscription:
        clock = self.node.clock

        def take(raw: RawMessage, info: MessageInfo) -> None:
            now_s = clock.now_ns() * 1e-9
            sample = Sample(raw, info, now_s)
            if not tap.count:
                tap.has_header = _starts_with_header(raw.type_name)
            delay_s = now_s - _header_s(raw.data) if tap.has_header else None
            tap.arrivals.append(Arrival(time.monotonic(), len(raw.data), delay_s))
            tap.count += 1
            tap.last = sample
            for listener in tap.listeners:
                listener(sample)

        known = self.node.graph.discovery.known()
        types = [one.type_name for one in known if one.name == topic and one.type_name != ANY_TYPE]
        return self.node.create_subscription(
            topic,
            None,
            take,
            raw=True,
            with_info=True,
            inline=True,
            announced=types[0] if types else "",
        )

    def _leave(self, topic: str, tap: _SharedSubscription, listener: Listener) -> None:
        with self._lock:
            tap.listeners = tuple(one for one in tap.listeners if one is not listener)
            over = not tap.listeners and self._subscriptions.get(topic) is tap
            if over:
                del self._subscriptions[topic]
        if over and tap.subscription is not None:
            tap.subscription.unregister()


def topic_name(node: Node, text: str) -> str:
    """Return a topic's global name.

    Raises:
        StudioError: it has none.
        IllegalNameError: it is not legal.
    """
    name = node.resolve_name(text.strip())
    if not name.strip("/"):
        raise StudioError("a topic needs a name, such as /cmd_vel")
    return name


def _starts_with_header(type_name: str) -> bool:
    try:
        fields = message_type(type_name).FIELDS
    except GazelleError:
        return False
    return bool(fields) and fields[0].type.base == _HEADER and fields[0].type.array is Array.ONE


def _header_s(data: bytes) -> float:
    """The stamp of a message that starts with a header lies behind CDR's four bytes."""
    if len(data) < _STAMP_PLACE + 8:
        return 0.0
    sec, nanosec = _STAMP[data[1] != 1].unpack_from(data, _STAMP_PLACE)
    return float(sec + nanosec * 1e-9)


Listener = Callable[[Sample], None]
