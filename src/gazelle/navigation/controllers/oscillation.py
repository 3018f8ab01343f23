"""Not going to and fro, as ``OscillationCostFunction``."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

__all__ = ["Oscillation"]

Pose = tuple[float, float, float]
_AXES = range(3)


@dataclass
class Oscillation:
    """Remembers which way the robot went along x, along y and around z.

    A direction that was reversed is kept until the robot has moved away from where that happened.

    Attributes:
        reset_m: how far that is.
        reset_rad: or how far the robot has to turn.
    """

    reset_m: float
    reset_rad: float
    _direction: list[int] = field(default_factory=lambda: [0, 0, 0])
    _only: list[int] = field(default_factory=lambda: [0, 0, 0])
    _place: Pose = (0.0, 0.0, 0.0)

    def reset(self) -> None:
        """Allow every direction again."""
        self._direction, self._only = [0, 0, 0], [0, 0, 0]

    def allowed(self, samples: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which velocities do not go back on a reversal, shape (n,)."""
        only = np.array(self._only)
        return np.asarray(((samples * only >= 0) | (only == 0)).all(axis=1))

    def remember(self, pose: Pose, velocity: tuple[float, float, float], slow_m_s: float) -> None:
        """Take in what is driven now; turning and strafing count at low speed only."""
        reversed_now = False
        for axis in _AXES:
            if axis > 0 and abs(velocity[0]) > slow_m_s:
                break
            sign = int(np.sign(velocity[axis]))
            if sign and self._direction[axis] == -sign:
                self._only[axis] = sign
                reversed_now = True
            if sign:
                self._direction[axis] = sign
        if reversed_now:
            self._place = pose
        away = math.hypot(pose[0] - self._place[0], pose[1] - self._place[1])
        turned = abs(math.remainder(pose[2] - self._place[2], math.tau))
        if any(self._only) and (away > self.reset_m or turned > self.reset_rad):
            self.reset()
