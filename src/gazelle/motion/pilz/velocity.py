"""Speed that rises, holds and falls in straight lines."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.motion.space import FloatArray

__all__ = ["Trapezoid"]


@dataclass(frozen=True)
class Trapezoid:
    """The fastest way along a distance from rest to rest.

    Attributes:
        distance: above zero.
        velocity: largest speed.
        acceleration: while the speed rises.
        deceleration: while it falls, above zero.
    """

    distance: float
    velocity: float
    acceleration: float
    deceleration: float

    @property
    def peak(self) -> float:
        """The speed that is reached."""
        a, d = self.acceleration, self.deceleration
        return min(self.velocity, math.sqrt(2.0 * self.distance * a * d / (a + d)))

    @property
    def phases_s(self) -> tuple[float, float, float]:
        """How long speed rises, holds and falls."""
        rise, fall = self.peak / self.acceleration, self.peak / self.deceleration
        return rise, max(0.0, self.distance / self.peak - 0.5 * (rise + fall)), fall

    @property
    def duration_s(self) -> float:
        """The time from rest to rest."""
        return sum(self.phases_s)

    def at(self, times_s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return distances, speeds and accelerations at times (k,); in the end all is at rest."""
        rise, hold, _ = self.phases_s
        end, peak = self.duration_s, self.peak
        t = np.clip(times_s, 0.0, end)
        rising, falling = t < rise, t > rise + hold
        left = end - t
        gone = np.where(
            rising,
            0.5 * self.acceleration * t**2,
            np.where(
                falling,
                self.distance - 0.5 * self.deceleration * left**2,
                peak * (t - 0.5 * rise),
            ),
        )
        speed = np.where(rising, self.acceleration * t, peak)
        speed = np.where(falling, self.deceleration * left, speed)
        change = np.where(rising, self.acceleration, 0.0)
        change = np.where(falling & (left > 0.0), -self.deceleration, change)
        return gone, speed, change
