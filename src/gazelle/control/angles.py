"""Differences of angles as ROS' ``angles`` package computes them."""

from __future__ import annotations

import math

__all__ = ["shortest_angular_distance", "shortest_angular_distance_with_limits"]

_TURN = 2.0 * math.pi


def shortest_angular_distance(start_rad: float, end_rad: float) -> float:
    """Return the way from one angle to another, in (-π, π]."""
    way = math.fmod(end_rad - start_rad, _TURN)
    if way > math.pi:
        return way - _TURN
    return way + _TURN if way <= -math.pi else way


def shortest_angular_distance_with_limits(
    start_rad: float, end_rad: float, lower_rad: float, upper_rad: float
) -> float:
    """Return the shorter way that stays between the limits, the longer one when it does not.

    When neither fits, or the start is outside, it is the shorter way
    (``angles::shortest_angular_distance_with_limits``).
    """
    short = shortest_angular_distance(start_rad, end_rad)
    if not lower_rad <= start_rad <= upper_rad or lower_rad <= start_rad + short <= upper_rad:
        return short
    long = short - math.copysign(_TURN, short)
    return long if lower_rad <= start_rad + long <= upper_rad else short
