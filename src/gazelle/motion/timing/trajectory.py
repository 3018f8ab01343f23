"""Where the joints are at which time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.timing.totg_velocity_profile import Span
from gazelle.rich_display import shown_by

__all__ = ["States", "Trajectory", "states_at", "times_of"]


@dataclass(frozen=True, eq=False)
class States:
    """Positions, velocities and accelerations of joints, shape (m, n) each."""

    positions: FloatArray
    velocities: FloatArray
    accelerations: FloatArray


def times_of(stops_s: FloatArray, period_s: float) -> FloatArray:
    """Return the times of samples: a period apart as MoveIt takes them, and one at every stop.

    A sample of the period that lies less than a thousandth of it from a stop is left out.

    Args:
        stops_s: (m,), increasing; the last one is the end.
        period_s: above zero.
    """
    regular = np.arange(math.ceil(float(stops_s[-1]) / period_s)) * period_s
    nearest = np.abs(regular[:, None] - stops_s).min(axis=1)
    return np.sort(np.concatenate([regular[nearest > 1e-3 * period_s], stops_s]))


def states_at(spans: Sequence[Span], times_s: FloatArray) -> States:
    """Return the states (k, n) along spans at times (k,); times beyond its end give its end."""
    ends = np.cumsum([span.duration_s for span in spans])
    chosen = np.minimum(np.searchsorted(ends, times_s, side="right"), len(spans) - 1)
    size = len(spans[0].segment.states(np.zeros(1))[0][0])
    found = States(*(np.empty((len(times_s), size)) for _ in range(3)))
    for index in np.unique(chosen):
        span, rows = spans[index], np.flatnonzero(chosen == index)
        since = np.clip(times_s[rows] - (ends[index] - span.duration_s), 0.0, span.duration_s)
        speed = np.maximum(0.0, span.speed + span.acceleration * since)
        gone = (span.speed + 0.5 * span.acceleration * since) * since
        q, first, second = span.segment.states(span.start + gone)
        found.positions[rows] = q
        found.velocities[rows] = first * speed[:, None]
        found.accelerations[rows] = first * span.acceleration + second * speed[:, None] ** 2
    return found


@shown_by("joint_motions:trajectory_bundle")
@dataclass(frozen=True, eq=False)
class Trajectory:
    """Samples of a motion that begins and ends at rest.

    Attributes:
        names: names of the joints.
        times_s: shape (m,), from 0, increasing.
        positions: shape (m, n), rad or m.
        velocities: shape (m, n), rad/s or m/s.
        accelerations: shape (m, n), rad/s² or m/s².
        notes: what was done otherwise than asked, one sentence each.
    """

    names: tuple[str, ...]
    times_s: FloatArray
    positions: FloatArray
    velocities: FloatArray
    accelerations: FloatArray
    notes: tuple[str, ...] = ()

    @property
    def duration_s(self) -> float:
        """The time from the first to the last sample."""
        return float(self.times_s[-1])

    def at(self, time_s: float) -> FloatArray:
        """Return the positions (n,) at a time, by the quintic spline that controllers use.

        Times before the first and after the last sample give these.
        """
        index = int(np.searchsorted(self.times_s, time_s, side="right")) - 1
        if index < 0 or index >= len(self.times_s) - 1:
            rest: FloatArray = self.positions[0 if index < 0 else -1].copy()
            return rest
        span = float(self.times_s[index + 1] - self.times_s[index])
        t = (time_s - float(self.times_s[index])) / span
        p0, p1 = self.positions[index], self.positions[index + 1]
        v0, v1 = self.velocities[index] * span, self.velocities[index + 1] * span
        a0, a1 = self.accelerations[index] * span**2, self.accelerations[index + 1] * span**2
        gap = p1 - p0
        cubic = 10.0 * gap - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1
        quartic = -15.0 * gap + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1
        quintic = 6.0 * gap - 3.0 * (v0 + v1) + 0.5 * (a1 - a0)
        value: FloatArray = (
            p0 + v0 * t + 0.5 * a0 * t**2 + cubic * t**3 + quartic * t**4 + quintic * t**5
        )
        return value
