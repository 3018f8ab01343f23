"""The fastest way along lines and arcs within limits of velocity and acceleration.

With x the squared speed along the path and u the acceleration, a joint's limits are
``|q' u + q'' x| ≤ a`` and ``q'² x ≤ v²``. A pass backwards finds the largest x at each place from
which one can still stop in time, a pass forwards takes the largest u that stays below it
(reachability analysis: Pham and Pham, TOPP-RA, 2018). Lines are solved exactly; arcs are cut into
intervals whose limits hold at both ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.timing.totg_path import Arc, Line, Piece

__all__ = ["Span", "fastest"]

_ARC_STEP = 0.05
"""Angle of an interval of an arc; between its ends limits are missed by less than 0.04 %."""
_SAFETY = 0.9995
_TINY = 1e-12


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of a piece with one acceleration.

    Attributes:
        segment: the line or arc.
        start: where it begins on the segment, in length.
        length: how long it is.
        speed: speed along the path at its start.
        acceleration: along the path.
        duration_s: how long it takes.
    """

    segment: Line | Arc
    start: float
    length: float
    speed: float
    acceleration: float
    duration_s: float


def fastest(piece: Piece, velocity: FloatArray, acceleration: FloatArray) -> list[Span]:
    """Return the fastest motion along a piece, from rest to rest.

    Args:
        piece: lines and arcs that join smoothly.
        velocity: finite limits of the joints, shape (n,).
        acceleration: finite limits of the joints, shape (n,).
    """
    steps: list[_OnLine | _OnArc] = []
    for segment in piece:
        if isinstance(segment, Line):
            steps.append(_OnLine(segment, velocity, acceleration))
        else:
            steps.extend(_arc_steps(segment, velocity, acceleration))
    reachable = [0.0] * (len(steps) + 1)
    for index in range(len(steps) - 1, 0, -1):
        reachable[index] = min(
            steps[index].backward(reachable[index + 1]), steps[index - 1].highest_at_end
        )
    spans: list[Span] = []
    x = 0.0
    for index, step in enumerate(steps):
        x = step.forward(x, reachable[index + 1], spans)
    return spans


class _OnLine:
    """A whole line: its limits are the same everywhere."""

    def __init__(self, line: Line, velocity: FloatArray, acceleration: FloatArray) -> None:
        share = np.maximum(np.abs(line.direction), _TINY)
        self._line = line
        self._most = float((acceleration / share).min())
        self.highest_at_end = float((velocity / share).min()) ** 2

    def backward(self, reachable: float) -> float:
        return min(self.highest_at_end, reachable + 2.0 * self._most * self._line.length)

    def forward(self, x: float, reachable: float, spans: list[Span]) -> float:
        most, length = self._most, self._line.length
        end = min(reachable, x + 2.0 * most * length)
        peak = min(self.highest_at_end, 0.5 * (x + end) + most * length)
        peak = max(peak, x, end)
        rise, fall = (peak - x) / (2.0 * most), (peak - end) / (2.0 * most)
        cruise = max(0.0, length - rise - fall)
        for start, part, here, u in (
            (0.0, rise, x, most),
            (rise, cruise, peak, 0.0),
            (length - fall, fall, peak, -most),
        ):
            _add(spans, self._line, start, part, here, u)
        return end


class _OnArc:
    """An interval of an arc, with the bands ``p x - h ≤ u ≤ p x + h`` of its limits."""

    def __init__(
        self,
        arc: Arc,
        place: tuple[float, float],
        bands: tuple[FloatArray, FloatArray],
        highest: tuple[float, float],
    ) -> None:
        self._arc, (self._start, self._length) = arc, place
        self._slope, self._half = bands
        self._highest, self.highest_at_end = highest
        self._rate = 1.0 / (2.0 * self._length)

    def backward(self, reachable: float) -> float:
        down = self._slope + self._rate
        limits = (self._half + reachable * self._rate) / np.where(down > 0.0, down, _TINY)
        return max(0.0, min(self._highest, float(limits.min())))

    def forward(self, x: float, reachable: float, spans: list[Span]) -> float:
        u = min(float((self._half + self._slope * x).min()), (reachable - x) * self._rate)
        end = max(0.0, x + 2.0 * u * self._length)
        _add(spans, self._arc, self._start, self._length, x, (end - x) * self._rate)
        return end


def _arc_steps(arc: Arc, velocity: FloatArray, acceleration: FloatArray) -> list[_OnArc]:
    count = max(1, math.ceil(arc.length / arc.radius / _ARC_STEP))
    marks = np.linspace(0.0, arc.length, count + 1)
    length = arc.length / count
    _, first, second = arc.states(marks)
    speeds = (velocity / np.maximum(np.abs(first), _TINY)).min(axis=1) ** 2
    # The limits at an interval's start, and at its end, where x has become x + 2 length u.
    of_u = np.hstack([first[:-1], first[1:] + 2.0 * length * second[1:]])
    of_x = np.hstack([second[:-1], second[1:]])
    of_u = np.where(np.abs(of_u) < _TINY, _TINY, of_u)
    slopes = -of_x / of_u
    halves = np.tile(acceleration, 2) * _SAFETY / np.abs(of_u)
    highest = _highest(slopes, halves, 1.0 / (2.0 * length))
    highest = np.minimum(highest, np.minimum(speeds[:-1], speeds[1:]))
    return [
        _OnArc(
            arc,
            (float(marks[i]), length),
            (slopes[i], halves[i]),
            (float(highest[i]), float(min(speeds[i], speeds[i + 1]))),
        )
        for i in range(count)
    ]


def _highest(slopes: FloatArray, halves: FloatArray, rate: float) -> FloatArray:
    """Return the largest x for which some u keeps to all bands, and to x + 2 length u ≥ 0."""
    gaps = slopes[:, :, None] - slopes[:, None, :]
    sums = halves[:, :, None] + halves[:, None, :]
    pairs = np.where(gaps > 0.0, sums / np.where(gaps > 0.0, gaps, 1.0), np.inf).min(axis=(1, 2))
    down = -rate - slopes
    ends = np.where(down > 0.0, halves / np.where(down > 0.0, down, 1.0), np.inf).min(axis=1)
    highest: FloatArray = np.minimum(pairs, ends)
    return highest


def _add(
    spans: list[Span], segment: Line | Arc, start: float, length: float, x: float, u: float
) -> None:
    if length <= _TINY:
        return
    speed = math.sqrt(max(0.0, x))
    end = math.sqrt(max(0.0, x + 2.0 * u * length))
    spans.append(Span(segment, start, length, speed, u, 2.0 * length / (speed + end)))
