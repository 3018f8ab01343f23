"""Motions of joints on a fine grid of times, and the check of their limits."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.motion.joint_space import FloatArray, JointSpace
from gazelle.motion.planning.error_codes import ErrorCode, PlanningError
from gazelle.motion.timing.trajectory import Trajectory

__all__ = ["GRID_S", "Motion", "Trapezoid", "check_limits", "grid", "joined", "measured", "thinned"]


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


GRID_S = 0.01

"""Longest time between two configurations that are computed; Pilz computes one per sample."""

_TOLERANCE = 1.01


@dataclass(frozen=True, eq=False)
class Motion:
    """States of n joints at k times, (k, n) each; times, (k,), from 0, increasing."""

    times_s: FloatArray
    positions: FloatArray
    velocities: FloatArray
    accelerations: FloatArray

    @property
    def duration_s(self) -> float:
        """The time of the last state."""
        return float(self.times_s[-1])

    def position_at(self, time_s: float) -> FloatArray:
        """Return the positions (n,) at a time; before the start and after the end those there."""
        position: FloatArray = _at(self.times_s, self.positions, np.array([time_s]))[0]
        return position


def grid(duration_s: float) -> FloatArray:
    """Return evenly spaced times (k,) from 0 to a duration, `GRID_S` apart at most."""
    return np.linspace(0.0, duration_s, max(1, math.ceil(duration_s / GRID_S - 1e-9)) + 1)


def measured(times_s: FloatArray, positions: FloatArray) -> Motion:
    """Return the motion through positions (k, n) at times (k,); it is at rest at both ends."""
    if len(times_s) < 3:
        still = np.zeros_like(positions)
        return Motion(times_s, positions, still, still.copy())
    velocities = np.gradient(positions, times_s, axis=0)
    velocities[[0, -1]] = 0.0
    accelerations = np.gradient(velocities, times_s, axis=0)
    return Motion(times_s, positions, velocities, accelerations)


def joined(parts: list[Motion]) -> Motion:
    """Return motions one after the other; each begins where the one before ends."""
    times, rows = [parts[0].times_s], [slice(None)]
    for before, part in zip(
        np.cumsum([part.duration_s for part in parts]), parts[1:], strict=False
    ):
        times.append(part.times_s[1:] + before)
        rows.append(slice(1, None))
    pairs = list(zip(parts, rows, strict=True))
    return Motion(
        np.concatenate(times),
        np.concatenate([part.positions[row] for part, row in pairs]),
        np.concatenate([part.velocities[row] for part, row in pairs]),
        np.concatenate([part.accelerations[row] for part, row in pairs]),
    )


def thinned(space: JointSpace, motion: Motion, period_s: float) -> Trajectory:
    """Return the samples of a motion that are a period apart, and its end."""
    count = max(1, math.ceil(motion.duration_s / period_s - 1e-3))
    times = np.append(np.arange(count) * period_s, motion.duration_s)
    if motion.duration_s <= 0.0:
        times = np.zeros(1)
    positions = motion.positions[:1] if len(motion.times_s) == 1 else _cubic(motion, times)
    values = (motion.velocities, motion.accelerations)
    velocities, accelerations = (_at(motion.times_s, item, times) for item in values)
    velocities[-1] = 0.0
    accelerations[-1] = 0.0
    return Trajectory(space.names, times, positions, velocities, accelerations)


def check_limits(space: JointSpace, motion: Motion, deceleration: FloatArray) -> None:
    """Refuse a motion that is faster than a joint may move or decelerate, (n,).

    Raises:
        PlanningError: PLANNING_FAILED, with the joint and the time.
    """
    speed, change = np.abs(motion.velocities), np.abs(motion.accelerations)
    slowing = motion.velocities * motion.accelerations < 0.0
    most = np.where(slowing, deceleration, space.acceleration)
    for kind, values, limits, unit in (
        ("velocity", speed, np.broadcast_to(space.velocity, speed.shape), "/s"),
        ("acceleration", change, most, "/s²"),
    ):
        excess = values / limits
        row, joint = np.unravel_index(int(excess.argmax()), excess.shape)
        if excess[row, joint] > _TOLERANCE:
            raise PlanningError(
                ErrorCode.PLANNING_FAILED,
                f"joint '{space.names[joint]}' would need a {kind} of {values[row, joint]:.3g}"
                f"{unit} at {motion.times_s[row]:.2f} s, its limit is {limits[row, joint]:.3g}; "
                f"set the {kind} scaling factor lower or keep away from singular poses",
            )


def _cubic(motion: Motion, wanted: FloatArray) -> FloatArray:
    """Return positions between states by the cubic through positions and velocities."""
    rows = np.clip(np.searchsorted(motion.times_s, wanted) - 1, 0, len(motion.times_s) - 2)
    span = (motion.times_s[rows + 1] - motion.times_s[rows])[:, None]
    t = (wanted - motion.times_s[rows])[:, None] / span
    p0, p1 = motion.positions[rows], motion.positions[rows + 1]
    v0, v1 = motion.velocities[rows] * span, motion.velocities[rows + 1] * span
    rise = t * t * (3.0 - 2.0 * t)
    positions: FloatArray = p0 + rise * (p1 - p0) + t * (1.0 - t) * ((1.0 - t) * v0 - t * v1)
    return positions


def _at(times: FloatArray, values: FloatArray, wanted: FloatArray) -> FloatArray:
    return np.column_stack([np.interp(wanted, times, column) for column in values.T])
