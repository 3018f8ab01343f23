from __future__ import annotations

import math

import pytest

from gazelle.control.angles import (
    shortest_angular_distance,
    shortest_angular_distance_with_limits,
)


@pytest.mark.parametrize(
    ("start", "end", "way"),
    [(0.0, 1.0, 1.0), (3.0, -3.0, 2 * math.pi - 6.0), (0.0, 7.0, 7.0 - 2 * math.pi)],
)
def test_the_shortest_way_crosses_the_seam(start: float, end: float, way: float) -> None:
    assert shortest_angular_distance(start, end) == pytest.approx(way)
    assert shortest_angular_distance(end, start) == pytest.approx(-way)


def test_half_a_turn_is_positive() -> None:
    assert shortest_angular_distance(0.0, math.pi) == pytest.approx(math.pi)
    assert shortest_angular_distance(0.0, -math.pi) == pytest.approx(math.pi)


def test_the_way_stays_between_the_limits() -> None:
    way = shortest_angular_distance_with_limits
    assert way(-2.9, 2.9, -3.0, 3.0) == pytest.approx(5.8)
    assert way(-2.9, 2.9, -4.0, 4.0) == pytest.approx(5.8 - 2 * math.pi)
    # Beyond a limit already, and where no way fits: the shorter one.
    assert way(3.2, 2.9, -3.0, 3.0) == pytest.approx(-0.3)
    assert way(0.0, 2.0, -1.0, 1.0) == pytest.approx(2.0)
