"""Methods and streams of bags."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypedDict

from gazelle.studio.bags.playing import PlayerState, Playing
from gazelle.studio.bags.recording import RecorderState, Recording
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import Channel, OpenStream, StreamKind

__all__ = ["METHODS", "STREAMS", "BagState"]

_PERIOD_S = 0.2


class BagState(TypedDict):
    """What is recorded and what is played."""

    recorder: RecorderState | None
    player: PlayerState | None


def _record(studio: Studio, params: Params) -> Any:
    """``bag.record``."""
    topics = params.texts("topics") if "topics" in params else None
    recording = studio.shared(Recording)
    return {"path": recording.begin(topics, params.text("path", ""), params.text("format", "bag"))}


def _record_stop(studio: Studio, _params: Params) -> Any:
    """``bag.record_stop``."""
    return {"path": studio.shared(Recording).stop()}


def _open(studio: Studio, params: Params) -> Any:
    """``bag.open``."""
    playing = studio.shared(Playing)
    playing.open(params.text("path"))
    return playing.state()


def _play(studio: Studio, params: Params) -> Any:
    """``bag.play``."""
    studio.shared(Playing).play(clock=params.flag("clock", False))
    return {}


def _pause(studio: Studio, _params: Params) -> Any:
    """``bag.pause``."""
    studio.shared(Playing).pause()
    return {}


def _seek(studio: Studio, params: Params) -> Any:
    """``bag.seek``."""
    studio.shared(Playing).seek(params.number("time_s"))
    return {}


def _rate(studio: Studio, params: Params) -> Any:
    """``bag.rate``."""
    studio.shared(Playing).set_rate(params.number("factor", least=0.001, most=1000.0))
    return {}


def _close(studio: Studio, _params: Params) -> Any:
    """``bag.close``."""
    studio.shared(Playing).close()
    return {}


def _open_states(studio: Studio, channel: Channel, _params: Params) -> OpenStream:
    """Stream ``bag``: recorder and player, five times a second."""

    def value() -> BagState:
        recorder, player = studio.shared(Recording), studio.shared(Playing)
        return {"recorder": recorder.state(), "player": player.state()}

    def tick() -> None:
        if not channel.closed:
            channel.offer(value)
            channel.later(_PERIOD_S, tick)

    tick()
    return OpenStream(lambda: None)


METHODS: dict[str, Callable[[Studio, Params], Any]] = {
    "bag.close": _close,
    "bag.open": _open,
    "bag.pause": _pause,
    "bag.play": _play,
    "bag.rate": _rate,
    "bag.record": _record,
    "bag.record_stop": _record_stop,
    "bag.seek": _seek,
}
STREAMS: dict[str, StreamKind] = {"bag": StreamKind(latest=True, open=_open_states)}
