"""Messages that wait for tf."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.graph.tf import MessageFilter, TransformBuffer, TransformError

_S = 1_000_000_000


class Bench:
    """A filter of messages that are their own stamps."""

    def __init__(self, size: int = 3) -> None:
        self.buffer = TransformBuffer()
        self.dropped: list[tuple[int, str]] = []
        self.filter: MessageFilter[tuple[int, float]] = MessageFilter(
            self._place, self._drop, size=size
        )

    def know(self, *stamps_s: int) -> None:
        for at in stamps_s:
            self.buffer.set_transform("odom", "base", at * _S, Pose((float(at), 0.0, 0.0)))

    def _place(self, stamp_s: Any) -> tuple[int, float]:
        pose = self.buffer.lookup_transform("odom", "base", stamp_s * _S).pose
        return stamp_s, pose.position_m[0]

    def _drop(self, stamp_s: Any, why: TransformError) -> None:
        self.dropped.append((stamp_s, str(why)))


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_message_waits_until_tf_knows_its_time(bench: Bench) -> None:
    bench.know(1, 2)
    assert bench.filter.add(4) == []
    bench.know(3)
    assert bench.filter.ready() == []
    bench.know(5)
    assert bench.filter.ready() == [(4, 4.0)]
    assert bench.filter.ready() == []
    assert not bench.dropped


def test_message_waits_for_a_frame_that_nobody_knows_yet(bench: Bench) -> None:
    assert bench.filter.add(2) == []
    assert "does not exist" in str(bench.filter.oldest[1] if bench.filter.oldest else "")
    bench.know(1, 3)
    assert bench.filter.add(3) == [(2, 2.0), (3, 3.0)]
    assert bench.filter.oldest is None


def test_message_that_waits_does_not_stop_others(bench: Bench) -> None:
    bench.know(1, 3)
    assert bench.filter.add(9) == []
    assert bench.filter.add(2) == [(2, 2.0)]


def test_message_from_before_tf_is_dropped_at_once(bench: Bench) -> None:
    bench.know(5, 6)
    assert bench.filter.add(2) == []
    assert [stamp for stamp, _why in bench.dropped] == [2]
    assert "into the past" in bench.dropped[0][1]


def test_oldest_message_is_dropped_when_too_many_wait(bench: Bench) -> None:
    bench.know(1, 2)
    for stamp_s in (3, 4, 5, 6):
        assert bench.filter.add(stamp_s) == []
    assert [stamp for stamp, _why in bench.dropped] == [3]
    assert "into the future" in bench.dropped[0][1]


def test_given_up_messages_are_told_of_and_forgotten_ones_are_not(bench: Bench) -> None:
    bench.know(1, 2)
    bench.filter.add(3)
    bench.filter.give_up()
    bench.filter.add(4)
    bench.filter.clear()
    assert [stamp for stamp, _why in bench.dropped] == [3]
    bench.know(9)
    assert bench.filter.ready() == []
