"""``topic.stats``: how often, how much and how late."""

from __future__ import annotations

import time
from typing import TypedDict

from gazelle.studio.pacing import every
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream
from gazelle.studio.subscriptions import Arrival, Sample, Taps, topic_name

__all__ = ["TopicStats", "open_stats"]

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


def open_stats(taps: Taps, channel: Channel, params: Params) -> OpenStream:
    """Stream ``topic.stats``; named topics are subscribed to, else those shown are counted."""
    named = params.texts("topics") if "topics" in params else None
    ends = [taps.listen(topic, _ignore) for topic in named or ()]
    shown = None if named is None else [topic_name(taps.node, topic) for topic in named]

    def rows() -> list[TopicStats]:
        topics = taps.topics if shown is None else shown
        return [_row(topic, *taps.arrivals(topic)) for topic in topics]

    def close() -> None:
        for end in ends:
            end()

    every(channel, _PERIOD_S, lambda: channel.offer(rows))
    return OpenStream(close)


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
