"""Positions of large clouds in half the bytes: 16 bits for each axis of the cloud's own cube."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["PackedPositions", "pack"]

_MIN_COUNT = 4096
_LEVELS = 65_535
_COARSEST_M = 0.002


class PackedPositions(NamedTuple):
    """Positions as whole numbers: ``origin_m + step_m * levels``.

    Attributes:
        origin_m: x, y and z of the cube's lowest corner.
        step_m: metres per level.
        levels: (N, 3) uint16.
    """

    origin_m: float
    step_m: float
    levels: NDArray[np.uint16]


def pack(xyz: NDArray[np.float32]) -> PackedPositions | None:
    """Return positions packed; None where that saves little or would move points by millimetres.

    Args:
        xyz: (N, 3) finite positions, metres.
    """
    if len(xyz) < _MIN_COUNT:
        return None
    values = np.ravel(xyz)
    low, high = float(values.min()), float(values.max())
    step = (high - low) / _LEVELS
    if not step <= _COARSEST_M:
        return None
    if step == 0.0:
        step = 1.0
    # One step for all axes: passes over plain arrays are much faster than over rows of three.
    levels = values * np.float32(1.0 / step)
    levels += np.float32(0.5 - low / step)
    np.clip(levels, 0.0, _LEVELS, out=levels)
    return PackedPositions(low, step, levels.astype(np.uint16).reshape(xyz.shape))
