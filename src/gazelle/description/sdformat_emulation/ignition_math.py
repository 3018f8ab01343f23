"""Ignition Math's poses and rotations: same operations in the same order, so same last digits."""

from __future__ import annotations

import math

from gazelle.description.urdfdom_emulation.values import Origin
from gazelle.geometry import Vector3

__all__ = [
    "chained",
    "composed",
    "composed_by_inverse",
    "euler_from_quat_wxyz",
    "euler_of",
    "quat_wxyz_from_euler",
]

Quaternion = tuple[float, float, float, float]
# Nearer to a pitch of 90 degrees than this, only the sum of roll and yaw is known.
_POLE = 1e-15
# ignition-math takes a norm up to this for zero.
_NO_NORM = 1e-6
# Nearer to a pitch of 90 degrees than this, only the sum of roll and yaw is known.
_POLE = 1e-15


def quat_wxyz_from_euler(roll_rad: float, pitch_rad: float, yaw_rad: float) -> Quaternion:
    """Return (w, x, y, z) of a rotation about fixed axes x, then y, then z."""
    cr, sr = math.cos(roll_rad / 2), math.sin(roll_rad / 2)
    cp, sp = math.cos(pitch_rad / 2), math.sin(pitch_rad / 2)
    cy, sy = math.cos(yaw_rad / 2), math.sin(yaw_rad / 2)
    return _unit_wxyz(
        (
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        )
    )


def euler_from_quat_wxyz(quaternion: Quaternion) -> tuple[float, float, float]:
    """Return roll, pitch, yaw; at a pitch of 90 degrees yaw is 0.

    A rotation without pitch gives −0, which old releases print.
    """
    w, x, y, z = _unit_wxyz(quaternion)
    ww, xx, yy, zz = w * w, x * x, y * y, z * z
    sine = -2 * (x * z - w * y) / (ww + xx + yy + zz)
    pitch = math.copysign(math.pi / 2, sine) if abs(sine) >= 1 else math.asin(sine)
    if abs(abs(sine) - 1) < _POLE:
        roll = math.atan2(math.copysign(2, sine) * (x * y - z * w), ww - xx + yy - zz)
        return roll, pitch, 0.0
    roll = math.atan2(2 * (y * z + w * x), ww - xx - yy + zz)
    return roll, pitch, math.atan2(2 * (x * y + w * z), ww + xx - yy - zz)


def chained(T_parent_joint: Origin, T_joint_part: Origin) -> Origin:
    """Return a part's pose in the parent's frame."""
    moved = _rotated(T_parent_joint.quat_xyzw, T_joint_part.xyz_m)
    xyz = _sum(T_parent_joint.xyz_m, moved)
    return Origin(xyz, _product(T_parent_joint.quat_xyzw, T_joint_part.quat_xyzw))


def composed(left: Origin, right: Origin) -> Origin:
    """Return left · right as ignition-math's product of poses computes it."""
    turned = _turned(left.quat_xyzw, right.xyz_m)
    return Origin(_sum(left.xyz_m, turned), _product(left.quat_xyzw, right.quat_xyzw))


def composed_by_inverse(T_parent_joint: Origin, offset: Origin) -> Origin:
    """Return what sdformat 9 makes of an offset: turned back, then moved by -xyz.

    This is no inverse of a pose, as the translation is not turned; releases from 9.6 on chain
    the poses instead.
    """
    back = _inverse(T_parent_joint.quat_xyzw)
    x, y, z = _rotated(back, offset.xyz_m)
    dx, dy, dz = T_parent_joint.xyz_m
    return Origin((x - dx, y - dy, z - dz), _product(back, offset.quat_xyzw))


def euler_of(quat_xyzw: Quaternion) -> Vector3:
    """Return roll, pitch and yaw in radians as ignition-math gives them; yaw is 0 at the poles.

    urdfdom's own angles differ there: see `gazelle.description.urdfdom_emulation.values`.
    """
    x, y, z, w = _unit(quat_xyzw)
    sine = -2.0 * (x * z - w * y)
    xx, yy, zz, ww = x * x, y * y, z * z, w * w
    if sine <= -1.0:
        pitch = -math.pi / 2.0
    elif sine >= 1.0:
        pitch = math.pi / 2.0
    else:
        pitch = math.asin(sine)
    if abs(sine - 1.0) < _POLE:
        return math.atan2(2.0 * (x * y - z * w), ww - xx + yy - zz), pitch, 0.0
    if abs(sine + 1.0) < _POLE:
        return math.atan2(-2.0 * (x * y - z * w), ww - xx + yy - zz), pitch, 0.0
    roll = math.atan2(2.0 * (y * z + w * x), ww - xx - yy + zz)
    yaw = math.atan2(2.0 * (x * y + w * z), ww + xx - yy - zz)
    return roll, pitch, yaw


def _unit_wxyz(quaternion: Quaternion) -> Quaternion:
    w, x, y, z = quaternion
    length = math.sqrt(w * w + x * x + y * y + z * z)
    if length <= 1e-6:
        return 1.0, 0.0, 0.0, 0.0
    return w / length, x / length, y / length, z / length


def _product(p: Quaternion, q: Quaternion) -> Quaternion:
    px, py, pz, pw = p
    qx, qy, qz, qw = q
    return (
        pw * qx + px * qw + py * qz - pz * qy,
        pw * qy - px * qz + py * qw + pz * qx,
        pw * qz + px * qy - py * qx + pz * qw,
        pw * qw - px * qx - py * qy - pz * qz,
    )


def _inverse(quat_xyzw: Quaternion) -> Quaternion:
    x, y, z, w = quat_xyzw
    norm = w * w + x * x + y * y + z * z
    if abs(norm) <= _NO_NORM:
        return 0.0, 0.0, 0.0, 1.0
    return -x / norm, -y / norm, -z / norm, w / norm


def _unit(quat_xyzw: Quaternion) -> Quaternion:
    x, y, z, w = quat_xyzw
    length = math.sqrt(w * w + x * x + y * y + z * z)
    if abs(length) <= _NO_NORM:
        return 0.0, 0.0, 0.0, 1.0
    return x / length, y / length, z / length, w / length


def _rotated(quat_xyzw: Quaternion, v: Vector3) -> Vector3:
    x, y, z, w = quat_xyzw
    u = _cross((x, y, z), v)
    uu = _cross((x, y, z), u)
    a, b, c = (part * (2.0 * w) for part in u)
    d, e, f = (part * 2.0 for part in uu)
    return v[0] + a + d, v[1] + b + e, v[2] + c + f


def _turned(quat_xyzw: Quaternion, v: Vector3) -> Vector3:
    inner = _product((*v, 0.0), _inverse(quat_xyzw))
    x, y, z, _ = _product(quat_xyzw, inner)
    return x, y, z


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _sum(a: Vector3, b: Vector3) -> Vector3:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]
