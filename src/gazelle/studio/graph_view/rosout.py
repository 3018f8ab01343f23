"""``rosout``: what nodes say."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Any, TypedDict

from gazelle.errors import GazelleError
from gazelle.graph.console import Level, level_of
from gazelle.interfaces.stamps import seconds_of
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream
from gazelle.studio.subscriptions import Sample, Subscriptions

__all__ = ["Console", "LogLine", "open_rosout"]

_KEPT = 200
_TOPIC = "/rosout"
_LEVELS = (10, 20, 30, 40, 50)
_WORDS = tuple(level.name.lower() for level in Level)


class LogLine(TypedDict):
    """What a node said, of the stream `rosout`.

    Attributes:
        name: of the node.
    """

    stamp_s: float
    level: str
    name: str
    message: str
    file: str
    function: str
    line: int


def open_rosout(console: Console, channel: Channel, params: Params) -> OpenStream:
    """Stream ``rosout``: the last 200 first."""
    word = params.text("level", "debug").lower()
    try:
        least = list(Level).index(level_of(word))
    except KeyError:
        raise StudioError(f"there is no level '{word}'", known=_WORDS) from None
    return OpenStream(console.follow(channel, least))


class Console:
    """Keeps what nodes said last, from the first look on.

    Attributes:
        close: listens no more.
    """

    def __init__(self, subscriptions: Subscriptions) -> None:
        """Listen to ``/rosout``."""
        self._kept: deque[LogLine] = deque(maxlen=_KEPT)
        self._followers: list[tuple[Channel, int]] = []
        self._lock = threading.Lock()
        self.close: Callable[[], None] = subscriptions.listen(_TOPIC, self._take)

    def follow(self, channel: Channel, least: int) -> Callable[[], None]:
        """Send a channel what was kept and what comes, of this level's number and above."""
        follower = (channel, least)
        with self._lock:
            for record in self._kept:
                _add(follower, record)
            self._followers.append(follower)

        def leave() -> None:
            with self._lock:
                self._followers.remove(follower)

        return leave

    def _take(self, sample: Sample) -> None:
        try:
            record = _record(sample.message())
        except (GazelleError, AttributeError) as error:
            record = _unreadable(sample, error)
        with self._lock:
            self._kept.append(record)
            for follower in self._followers:
                _add(follower, record)


def _add(follower: tuple[Channel, int], record: LogLine) -> None:
    channel, least = follower
    if _WORDS.index(record["level"]) >= least:
        channel.add(record)


def _unreadable(sample: Sample, error: Exception) -> LogLine:
    return {
        "stamp_s": sample.time_s,
        "level": "error",
        "name": sample.info.publisher,
        "message": f"this message on {_TOPIC} cannot be read: {error}",
        "file": "",
        "function": "",
        "line": 0,
    }


def _record(message: Any) -> LogLine:
    index = max((number for number in range(5) if _LEVELS[number] <= message.level), default=0)
    return {
        "stamp_s": seconds_of(message.stamp),
        "level": _WORDS[index],
        "name": message.name,
        "message": message.msg,
        "file": message.file,
        "function": message.function,
        "line": message.line,
    }
