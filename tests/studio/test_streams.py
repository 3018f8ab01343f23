"""The order in which a channel's frames go out, and how many the page has room for."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.studio.streams import Channel


class Workers:
    """Does at once what is to be done."""

    def submit(self, work: Callable[[], Any]) -> None:
        work()


class FrameSink:
    """A page that takes frames.

    Attributes:
        frames: what came, the numbers that were sent.
    """

    def __init__(self) -> None:
        self.frames: list[int] = []

    def post(self, data: str | bytes, on_sent: Callable[[], None] | None = None) -> None:
        value = json.loads(data)
        if value["op"] == "data":
            self.frames.append(value["value"])

    def later(self, delay_s: float, call: Callable[[], None]) -> None:
        call()


@pytest.fixture
def frame_sink() -> FrameSink:
    return FrameSink()


@pytest.fixture
def channel(frame_sink: FrameSink) -> Channel:
    made = Channel(1, latest=True, frame_sink=frame_sink, workers=Workers())  # type: ignore[arg-type]
    made.begin(None)
    return made


def test_a_page_that_draws_at_once_gets_every_frame_and_keeps_its_room(
    frame_sink: FrameSink, channel: Channel, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It answers before the worker that sent goes on."""
    send = channel._send_frames
    monkeypatch.setattr(
        channel, "_send_frames", lambda frames: (send(frames), channel.acknowledge())
    )
    for number in range(20):
        channel.offer(lambda number=number: number)
    monkeypatch.undo()
    for number in (20, 21, 22):
        channel.offer(lambda number=number: number)
    assert frame_sink.frames == list(range(22))


def test_a_page_that_draws_nothing_gets_what_it_has_room_for_and_then_the_newest(
    frame_sink: FrameSink, channel: Channel
) -> None:
    for number in range(20):
        channel.offer(lambda number=number: number)
    assert frame_sink.frames == [0, 1]
    channel.acknowledge()
    assert frame_sink.frames == [0, 1, 19]


def test_the_newest_frame_goes_out_last(
    frame_sink: FrameSink, channel: Channel, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One that is offered while another is on its way out does not overtake it."""
    send = channel._send_frames

    def late(frames: tuple[Any, ...]) -> None:
        if frames == (1,):
            channel.offer(lambda: 2)
        send(frames)

    monkeypatch.setattr(channel, "_send_frames", late)
    channel.offer(lambda: 1)
    assert frame_sink.frames == [1, 2]
