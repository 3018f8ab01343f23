"""What `message_filters` is in Gazelle: messages of several topics that belong together.

One module for rospy and rclpy: a `Subscriber` of rclpy begins with its node.
"""

from __future__ import annotations

import bisect
import threading
from collections.abc import Callable, Sequence
from typing import Any

from gazelle.compat.rospy.rostime import get_rostime
from gazelle.compat.rospy.topics import Subscriber as _Subscriber
from gazelle.compat.tf.conversions import nanoseconds, time_of
from gazelle.compat.warn_once import warn_once

__all__ = [
    "ApproximateTimeSynchronizer",
    "Cache",
    "SimpleFilter",
    "Subscriber",
    "TimeSynchronizer",
]


class SimpleFilter:
    """Passes messages on to callbacks."""

    def __init__(self) -> None:
        self._callbacks: list[tuple[Callable[..., Any], tuple[Any, ...]]] = []

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:
        """Call a function with every message, `args` after it."""
        self._callbacks.append((cb, args))
        return len(self._callbacks) - 1

    def now_ns(self) -> int:
        """Return the time of messages that have no header."""
        return int(get_rostime().to_nsec())

    def signalMessage(self, *msg: Any) -> None:
        """Pass messages on."""
        for callback, args in self._callbacks:
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """A topic as a filter.

    Takes the arguments of `rospy.Subscriber`, or a node of rclpy, type and topic, then
    ``qos_profile`` and what `Node.create_subscription` takes.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.node: Any = kwargs.pop("node", None)
        if args and hasattr(args[0], "graph_node"):
            self.node, *args = args  # type: ignore[assignment]
        if self.node is None:
            self.topic = args[0]
            kwargs["callback"] = self.signalMessage
            self.sub: Any = _Subscriber(*args, **kwargs)
        else:
            self._subscribe(*args, **kwargs)

    def now_ns(self) -> int:
        """Return the time of messages that have no header."""
        if self.node is None:
            return super().now_ns()
        return int(self.node.get_clock().now_ns())

    def unregister(self) -> None:
        """Stop receiving."""
        if self.node is None:
            self.sub.unregister()
        else:
            self.node.destroy_subscription(self.sub)

    unsubscribe = unregister

    def getTopic(self) -> str:
        """Return the topic."""
        return str(self.topic)

    def _subscribe(self, msg_type: Any, topic: str, qos_profile: Any = 10, **options: Any) -> None:
        self.topic = topic
        self.sub = self.node.create_subscription(
            msg_type, topic, self.signalMessage, qos_profile, **options
        )


class Cache(SimpleFilter):
    """Keeps the last messages of a filter, by time."""

    def __init__(
        self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False
    ) -> None:
        super().__init__()
        self._size = cache_size
        self._allow_headerless = allow_headerless
        self._messages: list[Any] = []
        self._times: list[int] = []
        self._source = f
        f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Keep a message."""
        stamp_ns = _stamp_ns(msg, self._source, allow_headerless=self._allow_headerless)
        if stamp_ns is None:
            return
        index = bisect.bisect(self._times, stamp_ns)
        self._times.insert(index, stamp_ns)
        self._messages.insert(index, msg)
        del self._times[: -self._size], self._messages[: -self._size]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Any, to_stamp: Any) -> list[Any]:
        """Return the messages between two times."""
        low = bisect.bisect_left(self._times, nanoseconds(from_stamp))
        return self._messages[low : bisect.bisect(self._times, nanoseconds(to_stamp))]

    def getElemBeforeTime(self, stamp: Any) -> Any:
        """Return the last message before a time, or None."""
        index = bisect.bisect(self._times, nanoseconds(stamp))
        return self._messages[index - 1] if index else None

    def getElemAfterTime(self, stamp: Any) -> Any:
        """Return the first message after a time, or None."""
        index = bisect.bisect_left(self._times, nanoseconds(stamp))
        return self._messages[index] if index < len(self._messages) else None

    def getLast(self) -> Any:
        """Return the last message, or None."""
        return self._messages[-1] if self._messages else None

    def getLastestTime(self) -> Any:
        """Return the time of the last message, or None; the name is the original's."""
        return self._time(-1)

    def getOldestTime(self) -> Any:
        """Return the time of the oldest message that is kept, or None."""
        return self._time(0)

    def _time(self, index: int) -> Any:
        if not self._times:
            return None
        node = getattr(self._source, "node", None)
        return time_of(self._times[index], 1 if node is None else 2)


class TimeSynchronizer(SimpleFilter):
    """Passes on messages of equal time stamps together."""

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        self._size = queue_size
        self._sources = list(fs)
        self._allow_headerless = False
        self._queues: list[dict[int, Any]] = [{} for _ in fs]
        self._lock = threading.Lock()
        for index, item in enumerate(fs):
            item.registerCallback(self.add, index)

    def add(self, msg: Any, index: int) -> None:
        """Take a message of one filter."""
        source = self._sources[index]
        stamp_ns = _stamp_ns(msg, source, allow_headerless=self._allow_headerless)
        if stamp_ns is None:
            return
        with self._lock:
            queue = self._queues[index]
            queue[stamp_ns] = msg
            while len(queue) > self._size:
                del queue[min(queue)]
            found = self._matched(stamp_ns, index)
        if found is not None:
            self.signalMessage(*found)

    def _matched(self, stamp_ns: int, index: int) -> list[Any] | None:
        del index
        if all(stamp_ns in queue for queue in self._queues):
            return [queue.pop(stamp_ns) for queue in self._queues]
        return None


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on messages whose time stamps differ by at most `slop` seconds."""

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
    ) -> None:
        super().__init__(fs, queue_size)
        self._allow_headerless = allow_headerless
        self._slop_ns = int(slop * 1e9)

    def _matched(self, stamp_ns: int, index: int) -> list[Any] | None:
        chosen: list[int] = []
        for number, queue in enumerate(self._queues):
            nearest = stamp_ns if number == index else _nearest(queue, stamp_ns)
            if nearest is None or abs(nearest - stamp_ns) > self._slop_ns:
                return None
            chosen.append(nearest)
        if max(chosen) - min(chosen) > self._slop_ns:
            return None
        return [queue.pop(stamp) for queue, stamp in zip(self._queues, chosen, strict=True)]


def _nearest(queue: dict[int, Any], stamp_ns: int) -> int | None:
    return min(queue, key=lambda stamp: abs(stamp - stamp_ns), default=None)


def _stamp_ns(message: Any, source: SimpleFilter, *, allow_headerless: bool) -> int | None:
    """Return a message's time; None, said once a type, when it has none and needs one."""
    header = getattr(message, "header", None)
    if header is not None:
        return nanoseconds(header.stamp)
    if allow_headerless:
        return source.now_ns()
    kind = type(message).__name__
    text = f"can not use message filters messages without timestamp infomation ({kind})"
    warn_once(f"{text} when 'allow_headerless' is disabled")
    return None
