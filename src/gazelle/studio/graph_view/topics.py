"""``topic.echo``: the messages of a topic as trees."""

from __future__ import annotations

from typing import Any, TypedDict

from gazelle.studio.json_text import message_value
from gazelle.studio.pacing import Pace
from gazelle.studio.request_params import Params
from gazelle.studio.stamps import stamp_s
from gazelle.studio.streams import Channel, OpenStream
from gazelle.studio.subscriptions import Sample, Taps

__all__ = ["EchoedMessage", "open_echo"]


class EchoedMessage(TypedDict):
    """A message of the stream `topic.echo`; its long arrays are cut."""

    type: str
    stamp_s: float
    count: int
    message: Any


def open_echo(taps: Taps, channel: Channel, params: Params) -> OpenStream:
    """Stream ``topic.echo``."""
    echo = _Echo(channel, params.number("rate_hz", 10.0, least=0.01, most=1000.0))
    return OpenStream(taps.listen(params.text("topic"), echo.take))


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
