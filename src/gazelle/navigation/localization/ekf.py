"""An extended Kalman filter over pose, velocity and acceleration, as robot_localization's.

The state is x, y, z, roll, pitch, yaw in the world's frame, their velocities and x, y, z
accelerations in the robot's frame; the model keeps the acceleration (Moore and Stouch 2014).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["PROCESS_NOISE", "STATES", "Ekf", "rotation_of"]

Vector = NDArray[np.float64]

STATES = (
    "x", "y", "z", "roll", "pitch", "yaw", "vx", "vy", "vz", "vroll", "vpitch", "vyaw",
    "ax", "ay", "az",
)  # fmt: skip
"""Names of the 15 states, in the order of ``odom0_config``."""

PROCESS_NOISE = (
    0.05, 0.05, 0.06, 0.03, 0.03, 0.06, 0.025, 0.025, 0.04, 0.01, 0.01, 0.02, 0.01, 0.01, 0.015,
)  # fmt: skip
"""Variances per second that robot_localization adds by default."""

_ANGLES = (3, 4, 5)
_OFF_THE_PLANE = (2, 3, 4, 8, 9, 10, 14)
_STEP = 1e-6
_SMALL = 1e-9


def rotation_of(roll: float, pitch: float, yaw: float) -> Vector:
    """Return the rotation from the robot's frame to the world's, (3, 3)."""
    cr, sr = math.cos(roll), math.sin(roll)
    cp, sp = math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


class Ekf:
    """State and covariance.

    Attributes:
        state: (15,).
        covariance: (15, 15).
    """

    def __init__(
        self,
        process_noise: Vector | None = None,
        initial_covariance: Vector | None = None,
        *,
        planar: bool = False,
    ) -> None:
        """Begin at rest in the origin.

        Args:
            process_noise: per second, (15, 15).
            initial_covariance: (15, 15).
            planar: the robot stays on the ground (``two_d_mode``).
        """
        self.state = np.zeros(15)
        self._noise = np.diag(PROCESS_NOISE) if process_noise is None else process_noise
        start = np.eye(15) * _SMALL if initial_covariance is None else initial_covariance
        self.covariance = start.copy()
        self._planar = planar

    def predict(self, dt_s: float) -> None:
        """Go on for a time; 0 and less does nothing."""
        if dt_s <= 0:
            return
        jacobian = np.empty((15, 15))
        for k in range(15):
            off = np.zeros(15)
            off[k] = _STEP
            change = _moved(self.state + off, dt_s) - _moved(self.state - off, dt_s)
            jacobian[:, k] = change / (2 * _STEP)
        self.state = _moved(self.state, dt_s)
        noise = self._noise * dt_s
        self.covariance = jacobian @ self.covariance @ jacobian.T + noise
        self._tidy()

    def update(
        self,
        indices: Sequence[int],
        values: Vector,
        covariance: Vector,
        threshold: float = math.inf,
    ) -> bool:
        """Take in measurements of states.

        Args:
            indices: which states, see `STATES`.
            values: as many; angles in rad.
            covariance: (m, m); variances of 0 count as very small.
            threshold: Mahalanobis distance above which the measurement is not taken.

        Returns:
            Whether it was taken.
        """
        rows = list(indices)
        noise = np.asarray(covariance, float).copy()
        diagonal = np.diag_indices(len(rows))
        noise[diagonal] = np.maximum(np.abs(noise[diagonal]), _SMALL)
        off = np.asarray(values, float) - self.state[rows]
        for k, row in enumerate(rows):
            if row in _ANGLES:
                off[k] = math.remainder(off[k], math.tau)
        spread = self.covariance[np.ix_(rows, rows)] + noise
        weighted = np.linalg.solve(spread, off)
        if float(off @ weighted) > threshold * threshold:
            return False
        gain = np.linalg.solve(spread, self.covariance[rows]).T
        self.state = self.state + gain @ off
        keep = np.eye(15)
        keep[:, rows] -= gain
        # Joseph's form stays symmetric and positive.
        self.covariance = keep @ self.covariance @ keep.T + gain @ noise @ gain.T
        self._tidy()
        return True

    def _tidy(self) -> None:
        for k in _ANGLES:
            self.state[k] = math.remainder(self.state[k], math.tau)
        if self._planar:
            rows = list(_OFF_THE_PLANE)
            self.state[rows] = 0.0
            self.covariance[rows] = 0.0
            self.covariance[:, rows] = 0.0
            self.covariance[rows, rows] = _SMALL


def _moved(state: Vector, dt_s: float) -> Vector:
    """Return the state after a time of constant acceleration and constant turning."""
    roll, pitch, yaw = state[3:6]
    turn = rotation_of(roll, pitch, yaw)
    after = state.copy()
    after[:3] += turn @ (state[6:9] * dt_s + state[12:15] * (0.5 * dt_s * dt_s))
    after[3:6] += _angle_rates(float(roll), float(pitch), state[9:12]) * dt_s
    after[6:9] += state[12:15] * dt_s
    return after


def _angle_rates(roll: float, pitch: float, rates: Vector) -> Vector:
    """Return how fast roll, pitch and yaw change for angular velocities of the robot's frame."""
    cosine = math.cos(pitch)
    cosine = math.copysign(max(abs(cosine), 1e-6), cosine)
    about = math.sin(roll) * rates[1] + math.cos(roll) * rates[2]
    return np.array(
        [
            rates[0] + math.tan(pitch) * about if abs(cosine) > 1e-6 else rates[0],
            math.cos(roll) * rates[1] - math.sin(roll) * rates[2],
            about / cosine,
        ]
    )
