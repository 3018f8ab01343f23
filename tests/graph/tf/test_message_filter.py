"""Messages that wait for tf."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.graph.tf import MessageFilter, TransformBuffer, TransformError

_S = 1_000_000_000


def _message(stamp_s: int, frame: str = "base") -> Any:
    stamp = SimpleNamespace(sec=stamp_s, nanosec=0)
    return SimpleNamespace(header=SimpleNamespace(frame_id=frame, stamp=stamp))


class Bench:
    """A filter of messages that are little but their stamps."""

    def __init__(self, size: int = 3) -> None:
        self.buffer = TransformBuffer()
        self.dropped: list[tuple[int, str]] = []
        self.tried = 0
        self.filter: MessageFilter[tuple[int, float]] = MessageFilter(
            self._place, self._drop, size=size
        )

    def know(self, *stamps_s: int) -> None:
        for at in stamps_s:
            self.buffer.set_transform("odom", "base", at * _S, Pose((float(at), 0.0, 0.0)))

    def add(self, stamp_s: int, frame: str = "base") -> list[tuple[int, float]]:
        return self.filter.add(_message(stamp_s, frame))

    def _place(self, message: Any) -> tuple[int, float]:
        self.tried += 1
        header = message.header
        stamp_s: int = header.stamp.sec
        pose = self.buffer.lookup_transform("odom", header.frame_id, stamp_s * _S).pose
        return stamp_s, pose.position_m[0]

    def _drop(self, message: Any, why: TransformError) -> None:
        self.dropped.append((message.header.stamp.sec, str(why)))


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_message_waits_until_tf_knows_its_time(bench: Bench) -> None:
    bench.know(1, 2)
    assert bench.add(4) == []
    bench.know(3)
    assert bench.filter.ready() == []
    bench.know(5)
    assert bench.filter.ready() == [(4, 4.0)]
    assert bench.filter.ready() == []
    assert not bench.dropped


def test_message_waits_for_a_frame_that_nobody_knows_yet(bench: Bench) -> None:
    assert bench.add(2) == []
    assert "does not exist" in str(bench.filter.oldest[1] if bench.filter.oldest else "")
    bench.know(1, 3)
    assert bench.add(3) == [(2, 2.0), (3, 3.0)]
    assert bench.filter.oldest is None


def test_message_that_waits_does_not_stop_others(bench: Bench) -> None:
    bench.know(1, 3)
    assert bench.add(9) == []
    assert bench.add(2) == [(2, 2.0)]


def test_message_from_before_tf_is_dropped_at_once(bench: Bench) -> None:
    bench.know(5, 6)
    assert bench.add(2) == []
    assert [stamp for stamp, _why in bench.dropped] == [2]
    assert "into the past" in bench.dropped[0][1]


def test_oldest_message_is_dropped_when_too_many_wait(bench: Bench) -> None:
    bench.know(1, 2)
    for stamp_s in (3, 4, 5, 6):
        assert bench.add(stamp_s) == []
    assert [stamp for stamp, _why in bench.dropped] == [3]
    assert "into the future" in bench.dropped[0][1]


def test_given_up_messages_are_told_of_and_forgotten_ones_are_not(bench: Bench) -> None:
    bench.know(1, 2)
    bench.add(3)
    bench.filter.give_up()
    bench.add(4)
    bench.filter.clear()
    assert [stamp for stamp, _why in bench.dropped] == [3]
    bench.know(9)
    assert bench.filter.ready() == []


def test_later_messages_of_a_frame_are_not_tried_while_an_earlier_one_waits() -> None:
    bench = Bench(size=50)
    bench.know(1, 2)
    for stamp_s in range(3, 40):
        assert bench.add(stamp_s) == []
    bench.tried = 0
    assert bench.filter.ready() == []
    assert bench.tried == 1
    assert bench.add(41, "elsewhere") == []
    assert bench.tried == 3
    bench.know(5)
    assert bench.filter.ready() == [(stamp_s, float(stamp_s)) for stamp_s in (3, 4, 5)]
