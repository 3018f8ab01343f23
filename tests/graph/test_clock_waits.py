from __future__ import annotations

import pytest

from gazelle.graph import clock
from gazelle.graph.clock import Waits
from gazelle.graph.shared_clock_discovery import _STILL_S

MS = 1_000_000


@pytest.fixture
def wall(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    now_s = [100.0]
    monkeypatch.setattr(clock.time, "monotonic", lambda: now_s[0])
    return now_s


def test_near_time_is_waited_for_whole_and_far_time_by_halves() -> None:
    waits = Waits()
    assert waits.until(10 * MS) == pytest.approx(0.01)
    assert waits.until(100 * MS) == pytest.approx(0.05)
    assert waits.until(3_600_000 * MS) == pytest.approx(0.1)


def test_nobody_looks_all_the_time() -> None:
    assert Waits().until(1) == pytest.approx(0.0005)


def test_fast_time_is_expected_earlier(wall: list[float]) -> None:
    waits = Waits()
    for number in range(4):
        waits.note(number * 1000 * MS)
        wall[0] += 0.2
    assert waits.until(10 * MS) == pytest.approx(0.002)


def test_slow_time_may_run_faster_at_once(wall: list[float]) -> None:
    waits = Waits()
    for number in range(4):
        waits.note(number * MS)
        wall[0] += 0.2
    assert waits.until(10 * MS) == pytest.approx(0.01)


def test_time_that_stands_still_for_long_is_seldom_looked_at() -> None:
    waits = Waits()
    pauses = [waits.still(looks) for looks in range(1, 60)]
    near = [one for one in pauses if one < 0.01]
    assert near[0] == pytest.approx(0.0005)
    assert max(near) == pytest.approx(0.004)
    assert set(pauses[len(near) :]) == {0.05}
    # Till then the publisher is bound to have said that time goes on.
    assert sum(near) > 2 * _STILL_S


def test_who_sleeps_for_moments_wants_messages_until_sleeps_are_longer() -> None:
    waits = Waits()
    assert not any(waits.begin(2 * MS) for _ in range(199))
    assert waits.begin(2 * MS)
    assert all(waits.begin(5 * MS) for _ in range(199))
    assert not waits.begin(5 * MS)


def test_a_short_sleep_now_and_then_changes_nothing() -> None:
    waits = Waits()
    assert not any(waits.begin(length * MS) for _ in range(500) for length in (1, 5, 10))
