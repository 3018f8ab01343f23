"""Paths as straight lines joined by circular arcs, by length travelled.

The arcs are those of Kunz and Stilman (2012): each touches both lines of a corner and passes the
corner at no more than the tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.motion.joint_space import FloatArray

__all__ = ["Arc", "Line", "Piece", "corner_arc", "distinct", "pieces"]

_ALMOST_STRAIGHT = 1e-6
_ALMOST_BACK = math.pi - 1e-3
_MIN_LENGTH = 1e-9


@dataclass(frozen=True, eq=False)
class Line:
    """A straight line from `start` (n,); `direction` (n,) has length 1."""

    start: FloatArray
    direction: FloatArray
    length: float

    def states(self, along: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return positions and their first two derivatives by length, shape (m, n) each."""
        points = self.start + along[:, None] * self.direction
        return points, np.broadcast_to(self.direction, points.shape), np.zeros_like(points)


@dataclass(frozen=True, eq=False)
class Arc:
    """A circular arc from ``center + radius x`` towards y; x and y, (n,), have length 1."""

    center: FloatArray
    x: FloatArray
    y: FloatArray
    radius: float
    length: float

    def states(self, along: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return positions and their first two derivatives by length, shape (m, n) each."""
        angles = along / self.radius
        cosine, sine = np.cos(angles)[:, None], np.sin(angles)[:, None]
        outward = cosine * self.x + sine * self.y
        forward = cosine * self.y - sine * self.x
        return self.center + self.radius * outward, forward, -outward / self.radius


Piece = list[Line | Arc]
"""Lines and arcs that are passed without a stop."""


def distinct(waypoints: FloatArray) -> FloatArray:
    """Return the waypoints (k, n) without those that repeat the one before."""
    kept = [waypoints[0]]
    for q in waypoints[1:]:
        if float(np.linalg.norm(q - kept[-1])) > _MIN_LENGTH:
            kept.append(q)
    return np.array(kept)


def corner_arc(
    before: FloatArray, corner: FloatArray, after: FloatArray, tolerance: float
) -> Arc | None:
    """Return the arc that rounds a corner between points, (n,) each.

    None where the corner is straight, too sharp or to be hit.

    An arc takes at most half of either line, so that arcs of neighbouring corners never meet.
    """
    incoming, outgoing = corner - before, after - corner
    lengths = float(np.linalg.norm(incoming)), float(np.linalg.norm(outgoing))
    incoming, outgoing = incoming / lengths[0], outgoing / lengths[1]
    angle = _angle(incoming, outgoing)
    if angle < _ALMOST_STRAIGHT or angle > _ALMOST_BACK or tolerance <= 0.0:
        return None
    half = angle / 2.0
    cut = min(*(0.5 * length for length in lengths), tolerance / math.tan(half / 2.0))
    radius = cut / math.tan(half)
    inward = outgoing - incoming
    inward /= np.linalg.norm(inward)
    center = corner + inward * (radius / math.cos(half))
    x = corner - incoming * cut - center
    return Arc(center, x / np.linalg.norm(x), incoming, radius, angle * radius)


def pieces(waypoints: FloatArray, tolerances: Sequence[float]) -> list[Piece]:
    """Return a path as lines and arcs, split where it must stop.

    Args:
        waypoints: shape (m, n), no two neighbours alike.
        tolerances: how far each of the m - 2 corners may be missed; 0 asks for a stop.
    """
    found: list[Piece] = [[]]
    here = waypoints[0]
    for index in range(1, len(waypoints)):
        corner = waypoints[index]
        arc, is_stop = None, False
        if index < len(waypoints) - 1:
            ends = waypoints[index - 1], corner, waypoints[index + 1]
            arc = corner_arc(*ends, tolerances[index - 1])
            is_stop = arc is None and not _is_straight(*ends)
        end = corner if arc is None else arc.center + arc.radius * arc.x
        _add_line(found[-1], here, end)
        here = end
        if arc is not None:
            found[-1].append(arc)
            here = arc.states(np.array([arc.length]))[0][0]
        if is_stop:
            found.append([])
    return [piece for piece in found if piece]


def _add_line(piece: Piece, start: FloatArray, end: FloatArray) -> None:
    length = float(np.linalg.norm(end - start))
    if length > _MIN_LENGTH:
        piece.append(Line(start, (end - start) / length, length))


def _is_straight(before: FloatArray, corner: FloatArray, after: FloatArray) -> bool:
    incoming, outgoing = corner - before, after - corner
    incoming = incoming / np.linalg.norm(incoming)
    return _angle(incoming, outgoing / np.linalg.norm(outgoing)) < _ALMOST_STRAIGHT


def _angle(first: FloatArray, second: FloatArray) -> float:
    # Kahan's formula: exact where the cosine is not.
    return 2.0 * math.atan2(
        float(np.linalg.norm(first - second)), float(np.linalg.norm(first + second))
    )
