"""The functions of the angles package."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.compat.tf import angles

_ANGLE = st.floats(-50, 50)


@given(_ANGLE)
def test_normal_angle_points_the_same_way(angle: float) -> None:
    for found, low, high in (
        (angles.normalize_angle(angle), -math.pi, math.pi),
        (angles.normalize_angle_positive(angle), 0.0, 2 * math.pi),
    ):
        assert low <= found <= high
        assert math.cos(found) == pytest.approx(math.cos(angle), abs=1e-9)
        assert math.sin(found) == pytest.approx(math.sin(angle), abs=1e-9)


@given(_ANGLE, _ANGLE)
def test_shortest_turn_ends_where_it_should(start: float, end: float) -> None:
    turn = angles.shortest_angular_distance(start, end)
    assert abs(turn) <= math.pi
    assert math.cos(start + turn) == pytest.approx(math.cos(end), abs=1e-9)


def test_limits_send_the_turn_the_other_way_round() -> None:
    limited = angles.shortest_angular_distance_with_limits
    assert limited(-2.5, 2.5, -3, 3) == (True, pytest.approx(5.0))
    assert limited(-2.5, 2.5, -4, 4) == (True, pytest.approx(5 - 2 * math.pi))
    assert limited(0.0, 2.0, -1, 1) == (False, pytest.approx(2.0))
    assert angles.two_pi_complement(0.5) == pytest.approx(0.5 - 2 * math.pi)
    assert angles.two_pi_complement(0.0) == pytest.approx(2 * math.pi)
    assert angles.to_degrees(angles.from_degrees(90)) == pytest.approx(90)
