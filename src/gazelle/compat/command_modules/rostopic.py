"""rostopic's functions: types and lists of topics; rates, delays and sizes of their messages."""

from __future__ import annotations

import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from statistics import fmean, pstdev
from typing import Any

from gazelle.compat.rospy.rostime import get_time
from gazelle.compat.rospy.state import STATE
from gazelle.interfaces import ros1_message_type, ros1_type_of

__all__ = [
    "ROSTopicBandwidth",
    "ROSTopicDelay",
    "ROSTopicException",
    "ROSTopicHz",
    "ROSTopicIOException",
    "find_by_type",
    "get_info_text",
    "get_topic_class",
    "get_topic_list",
    "get_topic_type",
]

_MAX = 50000
_BANDWIDTH_MOST = 100
_PAUSE_S = 0.05
Row = tuple[str, str, list[str]]


class _Series:
    """Arrivals of one topic."""

    def __init__(self, size: int) -> None:
        self.t0 = -1.0
        self.tn = 0.0
        self.last_printed_tn = 0.0
        self.times: deque[float] = deque(maxlen=size)


class ROSTopicHz:
    """Counts messages: give `callback_hz` to a subscriber, ask `get_hz`.

    Args:
        window_size: most messages that count; -1 for very many.
        filter_expr: takes a message, tells whether it counts.
        use_wtime: count by this machine's time, not the node's.
    """

    def __init__(
        self,
        window_size: int,
        filter_expr: Callable[[Any], bool] | None = None,
        use_wtime: bool = False,
    ) -> None:
        self.lock = threading.Lock()
        self.filter_expr = filter_expr
        self.use_wtime = use_wtime
        self.window_size = _MAX if window_size < 0 else window_size
        self._series: dict[str | None, _Series] = {}

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        """Count a message."""
        if self.filter_expr is not None and not self.filter_expr(m):
            return
        now = time.time() if self.use_wtime else get_time()
        with self.lock:
            series = self._of(topic)
            if now == 0.0:
                series.times.clear()
                return
            if series.t0 < 0 or series.t0 > now:
                series.t0 = now
                series.times.clear()
            else:
                series.times.append(now - series.tn)
            series.tn = now

    def get_hz(self, topic: str | None = None) -> tuple[float, float, float, float, int] | None:
        """Return rate (Hz), least and most time between (s), deviation, count; None if not new."""
        with self.lock:
            series = self._of(topic)
            if not series.times or series.tn == series.last_printed_tn:
                return None
            series.last_printed_tn = series.tn
            times = list(series.times)
        mean = fmean(times)
        rate = 1.0 / mean if mean > 0 else 0.0
        return rate, min(times), max(times), pstdev(times), len(times) + 1

    def print_hz(self, topics: Sequence[str | None] = (None,)) -> None:
        """Write the rates."""
        rows = [(topic, found) for topic in topics if (found := self.get_hz(topic)) is not None]
        if not rows:
            _print("no new messages")
        for topic, (rate, least, most, deviation, count) in rows:
            name = f"{topic}: " if len(topics) > 1 else ""
            _print(
                f"{name}average rate: {rate:.3f}\n\tmin: {least:.3f}s max: {most:.3f}s"
                f" std dev: {deviation:.5f}s window: {count}"
            )

    def get_times(self, topic: str | None = None) -> list[float]:
        """Return the times between messages."""
        return list(self._of(topic).times)

    def get_msg_t0(self, topic: str | None = None) -> float:
        """Return when the first message came, -1 before."""
        return self._of(topic).t0

    def get_msg_tn(self, topic: str | None = None) -> float:
        """Return when the last message came."""
        return self._of(topic).tn

    def get_last_printed_tn(self, topic: str | None = None) -> float:
        """Return the last message's time when the rate was last asked for."""
        return self._of(topic).last_printed_tn

    def _of(self, topic: str | None) -> _Series:
        return self._series.setdefault(topic, _Series(max(1, self.window_size - 1)))


class ROSTopicDelay:
    """Measures how late messages with a header come: `callback_delay`, then `get_delay`."""

    def __init__(self, window_size: int) -> None:
        self.lock = threading.Lock()
        self.window_size = _MAX if window_size < 0 else window_size
        self._delays: deque[float] = deque(maxlen=max(1, self.window_size))
        self._is_new = False

    def callback_delay(self, msg: Any) -> None:
        """Measure a message; one without header is told and not measured."""
        if not msg._has_header:
            _print("msg does not have header")
            return
        with self.lock:
            self._delays.append(get_time() - msg.header.stamp.to_sec())
            self._is_new = True

    def get_delay(self) -> tuple[float, float, float, float, int] | None:
        """Return mean, least and most delay (s), deviation and count; None if nothing is new."""
        with self.lock:
            if not self._is_new:
                return None
            self._is_new = False
            found = list(self._delays)
        return fmean(found), min(found), max(found), pstdev(found), len(found)

    def print_delay(self) -> None:
        """Write the delays."""
        found = self.get_delay()
        if found is None:
            _print("no new messages")
            return
        mean, least, most, deviation, count = found
        _print(
            f"average delay: {mean:.3f}\n\tmin: {least:.3f}s max: {most:.3f}s"
            f" std dev: {deviation:.5f}s window: {count}"
        )


class ROSTopicBandwidth:
    """Measures bytes a second of `rospy.AnyMsg` messages: `callback`, then `print_bw`."""

    def __init__(self, window_size: int = 100) -> None:
        self.lock = threading.Lock()
        self.window_size = _BANDWIDTH_MOST if window_size < 0 else window_size
        self._rows: deque[tuple[float, int]] = deque(maxlen=max(2, self.window_size))

    def callback(self, data: Any) -> None:
        """Measure a message."""
        with self.lock:
            self._rows.append((time.time(), len(data._buff)))

    def print_bw(self) -> None:
        """Write bytes a second, and the sizes."""
        with self.lock:
            rows = list(self._rows)
        if len(rows) < 2:
            return
        sizes = [size for _, size in rows]
        elapsed = max(time.time() - rows[0][0], 1e-9)
        texts = map(_bytes, (sum(sizes) / elapsed, fmean(sizes), min(sizes), max(sizes)))
        rate, mean, least, most = texts
        _print(f"average: {rate}/s\n\tmean: {mean} min: {least} max: {most} window: {len(rows)}")


class ROSTopicException(Exception):  # noqa: N818 - rostopic's name
    """A question about a topic has no answer."""


class ROSTopicIOException(ROSTopicException):
    """The graph cannot be reached."""


def get_topic_type(
    topic: str, blocking: bool = False
) -> tuple[str | None, str | None, Callable[[Any], Any] | None]:
    """Return a topic's type, its real name, and a function that takes a field of it.

    Args:
        topic: a topic, or a topic with fields behind it, such as ``/odom/pose/pose``.
        blocking: wait until somebody offers it.
    """
    from gazelle.compat.rospy.client import is_shutdown

    plain, bracket, index = topic.partition("[")
    wanted = STATE.resolved(plain) + bracket + index
    while True:
        known = {one.name: one.type_name for one in STATE.open_graph().topics()}
        found = max((name for name in known if _covers(name, wanted)), key=len, default=None)
        if found is not None and known[found] != "*":
            return ros1_type_of(known[found]), found, _field_getter(wanted.removeprefix(found))
        if not blocking or is_shutdown():
            return None, None, None
        time.sleep(_PAUSE_S)


def get_topic_class(
    topic: str, blocking: bool = False
) -> tuple[Any, str | None, Callable[[Any], Any] | None]:
    """Return a topic's class, its real name, and a function that takes a field of it.

    Raises:
        ROSTopicException: nothing defines the type.
    """
    from gazelle.errors import GazelleError

    name, real, take = get_topic_type(topic, blocking)
    if name is None:
        return None, None, None
    try:
        return ros1_message_type(name), real, take
    except GazelleError as error:
        raise ROSTopicException(f"Cannot load message class for [{name}]: {error}") from error


def get_topic_list(master: Any = None) -> tuple[list[Row], list[Row]]:
    """Return name, type and nodes of published and of subscribed topics.

    Args:
        master: without effect: a `rosgraph.Master` answers from the same graph, and has said so
            where it was made for another one.
    """
    topics = STATE.open_graph().topics()
    rows = [(one, ros1_type_of(one.type_name)) for one in topics]
    publishers = [(one.name, kind, list(one.publishers)) for one, kind in rows if one.publishers]
    subscribers = [
        (one.name, kind, list(one.subscriptions)) for one, kind in rows if one.subscriptions
    ]
    return publishers, subscribers


def find_by_type(topic_type: str) -> list[str]:
    """Return the topics of a type."""
    topics = STATE.open_graph().topics()
    return [one.name for one in topics if ros1_type_of(one.type_name) == topic_type]


def get_info_text(topic: str) -> str:
    """Return type, publishers and subscribers as text.

    Raises:
        ROSTopicException: nobody offers the topic.
    """
    name = STATE.resolved(topic)
    found = next((one for one in STATE.open_graph().topics() if one.name == name), None)
    if found is None:
        raise ROSTopicException(f"Unknown topic {topic}")
    parts = [f"Type: {ros1_type_of(found.type_name)}\n\n"]
    for heading, nodes in (("Publishers", found.publishers), ("Subscribers", found.subscriptions)):
        rows = "".join(f" * {node}\n" for node in nodes)
        parts.append(f"{heading}: \n{rows}\n" if rows else f"{heading}: None\n\n")
    return "".join(parts)


def _bytes(count: float) -> str:
    if count < 1000:
        return f"{count:.2f}B"
    return f"{count / 1e3:.2f}KB" if count < 1e6 else f"{count / 1e6:.2f}MB"


def _print(text: str) -> None:
    sys.stdout.write(f"{text}\n")


def _covers(name: str, wanted: str) -> bool:
    return wanted == name or wanted.startswith((f"{name}/", f"{name}["))


def _field_getter(path: str) -> Callable[[Any], Any] | None:
    """Return what takes ``/pose/position`` or ``/ranges[0]`` of a message; None for all of it."""
    steps = [step for step in path.replace("[", "/[").split("/") if step]
    if not steps:
        return None

    def take(message: Any) -> Any:
        for step in steps:
            index = step[1:-1] if step.startswith("[") else None
            message = getattr(message, step) if index is None else message[int(index)]
        return message

    return take
