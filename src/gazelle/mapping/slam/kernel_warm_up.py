"""The engine's loops, compiled before the first scan counts."""

from __future__ import annotations

import math

import numpy as np

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.slam.slam_engine import Slam

__all__ = ["warm_up"]

_BEAMS, _SCANS, _STEP_M = 180, 6, 0.6
# Odometry that is off makes the engine look farther.
_OFF_M = 0.7
_HALF_WIDTH_M, _HALF_HEIGHT_M = 4.0, 3.0


def warm_up() -> None:
    """Map a room that is not there, so that the first scans of a real one are not waited for."""
    engine = Slam()
    for k in range(_SCANS):
        engine.add(_seen(k * _STEP_M - 1.5, k), (k * _STEP_M + _OFF_M * (k % 2), 0.0, 0.0))
    engine.finish()


def _seen(x_m: float, number: int) -> Scan:
    """Return what a lidar sees at a place of the room's middle line."""
    angles = math.tau / _BEAMS * np.arange(_BEAMS)
    cos, sin = np.cos(angles), np.sin(angles)
    with np.errstate(divide="ignore"):
        across = np.where(cos > 0, _HALF_WIDTH_M - x_m, -_HALF_WIDTH_M - x_m) / cos
        along = np.where(sin > 0, _HALF_HEIGHT_M, -_HALF_HEIGHT_M) / sin
    ranges = np.minimum(np.abs(across), np.abs(along)).astype(np.float32)
    return Scan(number * 100_000_000, 0.0, math.tau / _BEAMS, ranges, 0.1, 20.0)
