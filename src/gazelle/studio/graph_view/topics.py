"""``topic.echo`` and ``topic.stats``: messages as trees; how often and how late they come."""

from __future__ import annotations

import time
from typing import Any, TypedDict

from gazelle.studio.json_text import message_value
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream, Pace, every
from gazelle.studio.subscriptions import Arrival, Sample, Subscriptions, stamp_s, topic_name

__all__ = ["EchoedMessage", "TopicStats", "open_echo", "open_stats"]

_PERIOD_S = 1.0
_WINDOW_S = 5.0


class TopicStats(TypedDict):
    """What came on a topic in the last seconds.

    Attributes:
        delay_s: null where messages have no header.
        count: since somebody looks.
    """

    topic: str
    hz: float
    bytes_per_s: float
    delay_s: float | None
    count: int


def open_stats(subscriptions: Subscriptions, channel: Channel, params: Params) -> OpenStream:
    """Stream ``topic.stats``; named topics are subscribed to, else those shown are counted."""
    named = params.texts("topics") if "topics" in params else None
    ends = [subscriptions.listen(topic, _ignore) for topic in named or ()]
    shown = None if named is None else [topic_name(subscriptions.node, topic) for topic in named]

    def rows() -> list[TopicStats]:
        topics = subscriptions.topics if shown is None else shown
        return [_row(topic, *subscriptions.arrivals(topic)) for topic in topics]

    def close() -> None:
        for end in ends:
            end()

    every(channel, _PERIOD_S, lambda: channel.offer(rows))
    return OpenStream(close)


class EchoedMessage(TypedDict):
    """A message of the stream `topic.echo`; its long arrays are cut."""

    type: str
    stamp_s: float
    count: int
    message: Any


def open_echo(subscriptions: Subscriptions, channel: Channel, params: Params) -> OpenStream:
    """Stream ``topic.echo``."""
    echo = _Echo(channel, params.number("rate_hz", 10.0, least=0.01, most=1000.0))
    return OpenStream(subscriptions.listen(params.text("topic"), echo.take))


class _Echo:
    def __init__(self, channel: Channel, rate_hz: float) -> None:
        self._channel = channel
        self._pace = Pace(channel, self._offer, rate_hz)
        self._count = 0
        self._last: Sample | None = None

    def take(self, sample: Sample) -> None:
        """Runs in the transport's thread."""
        self._count += 1
        self._last = sample
        self._pace()

    def _offer(self) -> None:
        self._channel.offer(self._value)

    def _value(self) -> EchoedMessage | None:
        sample = self._last
        if sample is None:
            return None
        message = sample.message()
        return {
            "type": sample.raw.type_name,
            "stamp_s": stamp_s(message, sample.time_s),
            "count": self._count,
            "message": message_value(message),
        }


def _ignore(_sample: Sample) -> None:
    """The tap itself counts."""


def _row(topic: str, count: int, arrivals: tuple[Arrival, ...]) -> TopicStats:
    since_s = time.monotonic() - _WINDOW_S
    recent = [one for one in arrivals if one.wall_s >= since_s]
    span_s = recent[-1].wall_s - recent[0].wall_s if len(recent) > 1 else 0.0
    delays = [one.delay_s for one in recent if one.delay_s is not None]
    return {
        "topic": topic,
        "hz": (len(recent) - 1) / span_s if span_s > 0 else 0.0,
        # The first message of the window belongs to the time before it.
        "bytes_per_s": sum(one.size_bytes for one in recent[1:]) / span_s if span_s > 0 else 0.0,
        "delay_s": sum(delays) / len(delays) if delays else None,
        "count": count,
    }
