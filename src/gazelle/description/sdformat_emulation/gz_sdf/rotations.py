"""Ignition Math's way from roll, pitch and yaw to a quaternion and back, to the last digit."""

from __future__ import annotations

import math

__all__ = ["euler_of", "quaternion_of"]

_Quaternion = tuple[float, float, float, float]
_TOLERANCE = 1e-15


def quaternion_of(roll_rad: float, pitch_rad: float, yaw_rad: float) -> _Quaternion:
    """Return (w, x, y, z) of a rotation about fixed axes x, then y, then z."""
    cr, sr = math.cos(roll_rad / 2), math.sin(roll_rad / 2)
    cp, sp = math.cos(pitch_rad / 2), math.sin(pitch_rad / 2)
    cy, sy = math.cos(yaw_rad / 2), math.sin(yaw_rad / 2)
    return _unit(
        (
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        )
    )


def euler_of(quaternion: _Quaternion) -> tuple[float, float, float]:
    """Return roll, pitch, yaw; at a pitch of 90 degrees yaw is 0.

    A rotation without pitch gives −0, which old releases print.
    """
    w, x, y, z = _unit(quaternion)
    ww, xx, yy, zz = w * w, x * x, y * y, z * z
    sine = -2 * (x * z - w * y) / (ww + xx + yy + zz)
    pitch = math.copysign(math.pi / 2, sine) if abs(sine) >= 1 else math.asin(sine)
    if abs(abs(sine) - 1) < _TOLERANCE:
        roll = math.atan2(math.copysign(2, sine) * (x * y - z * w), ww - xx + yy - zz)
        return roll, pitch, 0.0
    roll = math.atan2(2 * (y * z + w * x), ww - xx - yy + zz)
    return roll, pitch, math.atan2(2 * (x * y + w * z), ww + xx - yy - zz)


def _unit(quaternion: _Quaternion) -> _Quaternion:
    w, x, y, z = quaternion
    length = math.sqrt(w * w + x * x + y * y + z * z)
    if length <= 1e-6:
        return 1.0, 0.0, 0.0, 0.0
    return w / length, x / length, y / length, z / length
