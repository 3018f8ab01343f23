"""What `message_filters` is in Gazelle: messages of several topics that belong together."""

from __future__ import annotations

import bisect
import threading
from collections.abc import Callable, Sequence
from typing import Any

from gazelle.compat.rospy.rostime import get_rostime
from gazelle.compat.rospy.topics import Subscriber as _Subscriber

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

    def signalMessage(self, *msg: Any) -> None:
        """Pass messages on."""
        for callback, args in self._callbacks:
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """A topic as a filter; takes the arguments of `rospy.Subscriber`."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.topic = args[0]
        kwargs["callback"] = self.signalMessage
        self.sub = _Subscriber(*args, **kwargs)

    def unregister(self) -> None:
        """Stop receiving."""
        self.sub.unregister()

    def getTopic(self) -> str:
        """Return the topic."""
        return str(self.topic)


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
        f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Keep a message."""
        stamp = msg.header.stamp if hasattr(msg, "header") else get_rostime()
        if not hasattr(msg, "header") and not self._allow_headerless:
            return
        index = bisect.bisect(self._times, stamp.to_nsec())
        self._times.insert(index, stamp.to_nsec())
        self._messages.insert(index, msg)
        del self._times[: -self._size], self._messages[: -self._size]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Any, to_stamp: Any) -> list[Any]:
        """Return the messages between two times."""
        low = bisect.bisect_left(self._times, from_stamp.to_nsec())
        return self._messages[low : bisect.bisect(self._times, to_stamp.to_nsec())]

    def getElemBeforeTime(self, stamp: Any) -> Any:
        """Return the last message before a time, or None."""
        index = bisect.bisect(self._times, stamp.to_nsec())
        return self._messages[index - 1] if index else None

    def getElemAfterTime(self, stamp: Any) -> Any:
        """Return the first message after a time, or None."""
        index = bisect.bisect_left(self._times, stamp.to_nsec())
        return self._messages[index] if index < len(self._messages) else None


class TimeSynchronizer(SimpleFilter):
    """Passes on messages of equal time stamps together."""

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        super().__init__()
        self._size = queue_size
        self._queues: list[dict[int, Any]] = [{} for _ in fs]
        self._lock = threading.Lock()
        for index, item in enumerate(fs):
            item.registerCallback(self.add, index)

    def add(self, msg: Any, index: int) -> None:
        """Take a message of one filter."""
        with self._lock:
            queue = self._queues[index]
            stamp_ns = msg.header.stamp.to_nsec()
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
        del allow_headerless
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
