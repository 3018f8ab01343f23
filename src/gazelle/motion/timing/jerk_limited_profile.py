"""Motions whose acceleration changes no faster than the limits of jerk.

Along a straight line from rest to rest the fastest one has seven phases and is known in closed
form. Where corners are rounded, the fastest motion without limits of jerk is averaged over a
window of time: averages of velocities and accelerations keep to the limits that these keep to, and
the jerk is the change of acceleration over the window divided by its width.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.timing.limits import Limits
from gazelle.motion.timing.totg_path import Line
from gazelle.motion.timing.totg_velocity_profile import Span
from gazelle.motion.timing.trajectory import States, states_at

__all__ = ["Smoothed", "seven_phases"]

_TINY = 1e-12
_FINE_S = 0.001
_CANDIDATES = 24


class Smoothed:
    """The fastest motion along spans, averaged over the narrowest window that does."""

    def __init__(self, spans: Sequence[Span], limits: Limits) -> None:
        """Find the window."""
        self._duration_s = sum(span.duration_s for span in spans)
        count = max(64, math.ceil(self._duration_s / _FINE_S))
        self._times = np.linspace(0.0, self._duration_s, count + 1)
        self._states = states_at(spans, self._times)
        self._area = self._integral(self._states.positions)
        self._window_s = self._narrowest(limits)

    @property
    def duration_s(self) -> float:
        """The time from rest to rest."""
        return self._duration_s + self._window_s

    def at(self, times_s: FloatArray) -> States:
        """Return positions, velocities and accelerations, (k, n) each, at times (k,)."""
        before = times_s - self._window_s
        window = self._window_s
        return States(
            (self._area_at(times_s) - self._area_at(before)) / window,
            (
                self._value(self._states.positions, times_s)
                - self._value(self._states.positions, before)
            )
            / window,
            (
                self._value(self._states.velocities, times_s)
                - self._value(self._states.velocities, before)
            )
            / window,
        )

    def _narrowest(self, limits: Limits) -> float:
        """Return the narrowest of some windows within the limits; the widest always is."""
        widest = float((2.0 * limits.acceleration / limits.jerk).max())
        for window in np.geomspace(widest / 4.0, widest, _CANDIDATES):
            if self._jerk_within(float(window), limits.jerk):
                return float(window)
        return widest

    def _jerk_within(self, window: float, jerk: FloatArray) -> bool:
        step = float(self._times[1])
        shift = max(1, math.floor(window / step))
        rest = np.zeros((shift, self._states.accelerations.shape[1]))
        padded = np.vstack([rest, self._states.accelerations, rest])
        change = np.abs(padded[shift:] - padded[:-shift]).max(axis=0)
        return bool((change <= jerk * window).all())

    def _integral(self, values: FloatArray) -> FloatArray:
        """Integrate positions from 0 to each time; Hermite's rule with the velocities."""
        step = float(self._times[1])
        speed = self._states.velocities
        parts = 0.5 * step * (values[1:] + values[:-1]) + step**2 / 12.0 * (speed[:-1] - speed[1:])
        area: FloatArray = np.vstack([np.zeros((1, values.shape[1])), np.cumsum(parts, axis=0)])
        return area

    def _area_at(self, times: FloatArray) -> FloatArray:
        """Return the integral of the positions, which are at rest before and after."""
        first, last = self._states.positions[0], self._states.positions[-1]
        beyond = np.maximum(times - self._duration_s, 0.0)[:, None] * last
        below = np.minimum(times, 0.0)[:, None] * first
        area: FloatArray = self._value(self._area, times) + beyond + below
        return area

    def _value(self, values: FloatArray, times: FloatArray) -> FloatArray:
        inside = np.clip(times, 0.0, self._duration_s)
        columns = [np.interp(inside, self._times, column) for column in values.T]
        return np.column_stack(columns)


def seven_phases(line: Line, limits: Limits, times_s: FloatArray) -> tuple[States, float]:
    """Return the fastest motion along a line, (k, n) at times (k,), and how long it takes."""
    share = np.maximum(np.abs(line.direction), _TINY)
    most = [
        float((limit / share).min())
        for limit in (limits.velocity, limits.acceleration, limits.jerk)
    ]
    phases = _phases(line.length, *most)
    duration = sum(part for part, _ in phases)
    rows = np.array([_along(phases, min(float(t), duration)) for t in times_s])
    s, v, a = rows.T
    positions = line.start + np.minimum(s, line.length)[:, None] * line.direction
    return States(positions, v[:, None] * line.direction, a[:, None] * line.direction), duration


def _phases(
    length: float, velocity: float, acceleration: float, jerk: float
) -> list[tuple[float, float]]:
    """Return durations and jerks of the seven phases."""
    peak = _peak(length, velocity, acceleration, jerk)
    top = min(acceleration, math.sqrt(peak * jerk))
    change = top / jerk
    hold = max(0.0, peak / top - change)
    cruise = max(0.0, length / peak - (2.0 * change + hold))
    rise = [(change, jerk), (hold, 0.0), (change, -jerk)]
    return [*rise, (cruise, 0.0), *((part, -j) for part, j in rise)]


def _peak(length: float, velocity: float, acceleration: float, jerk: float) -> float:
    """Return the largest speed: the limit, or what the distance allows."""
    ratio = acceleration**2 / jerk
    if length >= 2.0 * acceleration * ratio / jerk:
        reached = 0.5 * (math.sqrt(ratio**2 + 4.0 * acceleration * length) - ratio)
    else:
        reached = (length**2 * jerk / 4.0) ** (1.0 / 3.0)
    return min(velocity, reached)


def _along(phases: Sequence[tuple[float, float]], time_s: float) -> tuple[float, float, float]:
    s = v = a = 0.0
    for part, jerk in phases:
        t = min(part, time_s)
        s += v * t + a * t**2 / 2.0 + jerk * t**3 / 6.0
        v += a * t + jerk * t**2 / 2.0
        a += jerk * t
        time_s -= t
        if time_s <= 0.0:
            break
    return s, v, a
