"""Methods and streams of bags, and what they work on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypedDict

from gazelle.studio.bags.player import PlayerState, Playing
from gazelle.studio.bags.recorder import RecorderState, Recording
from gazelle.studio.request_params import Params
from gazelle.studio.routing import Method
from gazelle.studio.streams import Channel, OpenStream, StreamKind

__all__ = ["METHODS", "STREAMS", "BagState", "Bags"]

_PERIOD_S = 0.2


@dataclass(frozen=True)
class Bags:
    """The recorder and the player of a graph's pages."""

    recording: Recording
    playing: Playing


class BagState(TypedDict):
    """What is recorded and what is played."""

    recorder: RecorderState | None
    player: PlayerState | None


def _record(bags: Bags, params: Params) -> Any:
    """``bag.record``."""
    topics = params.texts("topics") if "topics" in params else None
    path, kind = params.text("path", ""), params.text("format", "bag")
    return {"path": bags.recording.begin(topics, path, kind)}


def _record_stop(bags: Bags, _params: Params) -> Any:
    """``bag.record_stop``."""
    return {"path": bags.recording.stop()}


def _open(bags: Bags, params: Params) -> Any:
    """``bag.open``."""
    bags.playing.open(params.text("path"))
    return bags.playing.state()


def _play(bags: Bags, params: Params) -> Any:
    """``bag.play``."""
    bags.playing.play(clock=params.flag("clock", False))
    return {}


def _pause(bags: Bags, _params: Params) -> Any:
    """``bag.pause``."""
    bags.playing.pause()
    return {}


def _seek(bags: Bags, params: Params) -> Any:
    """``bag.seek``."""
    bags.playing.seek(params.number("time_s"))
    return {}


def _rate(bags: Bags, params: Params) -> Any:
    """``bag.rate``."""
    bags.playing.set_rate(params.number("factor", least=0.001, most=1000.0))
    return {}


def _close(bags: Bags, _params: Params) -> Any:
    """``bag.close``."""
    bags.playing.close()
    return {}


def _open_states(bags: Bags, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``bag``: recorder and player, five times a second."""

    def value() -> BagState:
        return {"recorder": bags.recording.state(), "player": bags.playing.state()}

    def tick() -> None:
        if not channel.closed:
            channel.offer(value)
            channel.later(_PERIOD_S, tick)

    tick()
    return OpenStream(lambda: None)


METHODS: dict[str, Method[Bags]] = {
    "bag.close": _close,
    "bag.open": _open,
    "bag.pause": _pause,
    "bag.play": _play,
    "bag.rate": _rate,
    "bag.record": _record,
    "bag.record_stop": _record_stop,
    "bag.seek": _seek,
}
STREAMS: dict[str, StreamKind[Bags]] = {"bag": StreamKind(latest=True, open=_open_states)}
