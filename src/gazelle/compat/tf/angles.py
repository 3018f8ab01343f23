"""The functions of the ``angles`` package; radians."""

from __future__ import annotations

import math

__all__ = [
    "from_degrees",
    "normalize_angle",
    "normalize_angle_positive",
    "shortest_angular_distance",
    "shortest_angular_distance_with_limits",
    "to_degrees",
    "two_pi_complement",
]

_TURN = 2.0 * math.pi


def normalize_angle_positive(angle: float) -> float:
    """Return an angle from 0 to 2π, the end not included."""
    return math.fmod(math.fmod(angle, _TURN) + _TURN, _TURN)


def normalize_angle(angle: float) -> float:
    """Return an angle from -π to π, the start not included."""
    found = normalize_angle_positive(angle)
    return found - _TURN if found > math.pi else found


def shortest_angular_distance(from_angle: float, to_angle: float) -> float:
    """Return the shortest turn from one angle to another."""
    return normalize_angle(to_angle - from_angle)


def two_pi_complement(angle: float) -> float:
    """Return the turn to the same place the other way round."""
    angle = math.fmod(angle, _TURN)
    if angle == 0.0:
        return _TURN
    return angle - math.copysign(_TURN, angle)


def shortest_angular_distance_with_limits(
    from_angle: float, to_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float]:
    """Return whether a turn stays between limits all the way, and the turn.

    Args:
        from_angle: where it starts.
        to_angle: where it ends.
        left_limit: the lower limit.
        right_limit: the upper limit.
    """
    start = normalize_angle(from_angle)
    short = shortest_angular_distance(from_angle, to_angle)
    turns = (short, two_pi_complement(short))
    for turn in turns:
        if left_limit <= start <= right_limit and left_limit <= start + turn <= right_limit:
            return True, turn
    return False, short


def from_degrees(degrees: float) -> float:
    """Return degrees in radians."""
    return math.radians(degrees)


def to_degrees(radians: float) -> float:
    """Return radians in degrees."""
    return math.degrees(radians)
