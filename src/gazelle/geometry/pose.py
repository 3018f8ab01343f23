"""Rigid transforms SE(3): position in metres, unit quaternion in x, y, z, w order."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "IDENTITY_POSE",
    "Pose",
    "QuatXyzw",
    "Vector3",
    "cross",
    "quat_xyzw_about_axis",
    "quat_xyzw_from_rpy",
    "quat_xyzw_from_yaw",
    "rpy_from_quat_xyzw",
    "unit_quat_xyzw",
    "yaw_from_quat_xyzw",
]

Vector = Sequence[float] | NDArray[np.float64]
Vector3 = tuple[float, float, float]
QuatXyzw = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Pose:
    """A rigid transform ``T_a_b``: takes coordinates in frame b to coordinates in frame a.

    Attributes:
        position_m: origin of b in a, metres.
        quat_xyzw: orientation of b in a, unit quaternion, scalar last (REP-103).
    """

    position_m: Vector3 = (0.0, 0.0, 0.0)
    quat_xyzw: QuatXyzw = (0.0, 0.0, 0.0, 1.0)

    @classmethod
    def from_xyz_rpy(cls, xyz_m: Vector3, rpy_rad: Vector3 = (0.0, 0.0, 0.0)) -> Pose:
        """Build from metres and fixed-axis roll, pitch, yaw in radians (URDF, SDF ``<pose>``)."""
        return cls(xyz_m, quat_xyzw_from_rpy(rpy_rad))

    @classmethod
    def from_xy_yaw(cls, x_m: float, y_m: float, yaw_rad: float) -> Pose:
        """Build from a place in the ground plane, metres, and a direction in radians."""
        return cls((x_m, y_m, 0.0), quat_xyzw_from_yaw(yaw_rad))

    @classmethod
    def from_matrix(cls, matrix: NDArray[np.float64]) -> Pose:
        """Build from a 4×4 (or 3×4) homogeneous matrix."""
        position = tuple(float(value) for value in matrix[:3, 3])
        return cls(position, _quat_from_rotation(matrix[:3, :3]))  # type: ignore[arg-type]

    def __matmul__(self, other: Pose) -> Pose:
        """Compose: ``T_a_c = T_a_b @ T_b_c``."""
        turned = _rotate(self.quat_xyzw, other.position_m)
        x, y, z = (a + b for a, b in zip(self.position_m, turned, strict=True))
        return Pose((x, y, z), unit_quat_xyzw(_multiply(self.quat_xyzw, other.quat_xyzw)))

    def normalised(self) -> Pose:
        """Return it with a unit quaternion: see `unit_quat_xyzw`."""
        return Pose(self.position_m, unit_quat_xyzw(self.quat_xyzw))

    def inverse(self) -> Pose:
        """Return ``T_b_a``."""
        x, y, z, w = self.quat_xyzw
        conjugate = (-x, -y, -z, w)
        px, py, pz = _rotate(conjugate, self.position_m)
        return Pose((-px, -py, -pz), conjugate)

    def rotate(self, vector: Vector3) -> Vector3:
        """Rotate a free vector from frame b to frame a."""
        return _rotate(self.quat_xyzw, vector)

    def transform(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Transform points of shape (..., 3) from frame b to frame a."""
        matrix = self.matrix()
        return np.asarray(points_m @ matrix[:3, :3].T + matrix[:3, 3])

    def matrix(self) -> NDArray[np.float64]:
        """Return the 4×4 homogeneous matrix."""
        x, y, z, w = self.quat_xyzw
        matrix = np.eye(4)
        matrix[0, :3] = 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)
        matrix[1, :3] = 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)
        matrix[2, :3] = 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)
        matrix[:3, 3] = self.position_m
        return matrix

    @property
    def rpy_rad(self) -> Vector3:
        """Fixed-axis roll, pitch, yaw in radians."""
        return rpy_from_quat_xyzw(self.quat_xyzw)

    @property
    def xy_yaw(self) -> Vector3:
        """The pose seen from above: x and y in metres, yaw in radians."""
        x, y, _ = self.position_m
        return float(x), float(y), yaw_from_quat_xyzw(self.quat_xyzw)

    @property
    def quat_wxyz(self) -> QuatXyzw:
        """The quaternion scalar first, as MuJoCo wants it."""
        x, y, z, w = self.quat_xyzw
        return (w, x, y, z)


IDENTITY_POSE = Pose()


def cross(a: Vector, b: Vector) -> NDArray[np.float64]:
    """Return ``a × b`` (3,), some twenty times as fast as `numpy.cross`."""
    ax, ay, az = a
    bx, by, bz = b
    return np.array((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), dtype=np.float64)


def quat_xyzw_from_rpy(rpy_rad: Vector3) -> QuatXyzw:
    """Return the quaternion of fixed-axis roll, pitch, yaw (``Rz(yaw) Ry(pitch) Rx(roll)``)."""
    roll, pitch, yaw = (value / 2 for value in rpy_rad)
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def quat_xyzw_from_yaw(yaw_rad: float) -> QuatXyzw:
    """Return the quaternion of a turn about z."""
    return (0.0, 0.0, math.sin(yaw_rad / 2), math.cos(yaw_rad / 2))


def quat_xyzw_about_axis(axis: Vector3, angle_rad: float) -> QuatXyzw:
    """Return the quaternion of a turn about an axis of length 1."""
    x, y, z = axis
    sine = math.sin(angle_rad / 2)
    return (x * sine, y * sine, z * sine, math.cos(angle_rad / 2))


def rpy_from_quat_xyzw(quat_xyzw: QuatXyzw) -> Vector3:
    """Return fixed-axis roll, pitch, yaw in radians; pitch is clamped at the poles."""
    x, y, z, w = unit_quat_xyzw(quat_xyzw)
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    return (roll, pitch, yaw_from_quat_xyzw((x, y, z, w)))


def yaw_from_quat_xyzw(quat_xyzw: QuatXyzw) -> float:
    """Return the turn about z of a unit quaternion in radians, as `rpy_from_quat_xyzw` has it."""
    x, y, z, w = quat_xyzw
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def unit_quat_xyzw(quat_xyzw: QuatXyzw) -> QuatXyzw:
    """Return a quaternion at length 1; no turn for one of zeros, as messages are made with."""
    x, y, z, w = quat_xyzw
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    return (x / norm, y / norm, z / norm, w / norm) if norm > 0 else (0.0, 0.0, 0.0, 1.0)


def _multiply(a: QuatXyzw, b: QuatXyzw) -> QuatXyzw:
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def _rotate(quat: QuatXyzw, vector: Vector3) -> Vector3:
    x, y, z, w = quat
    vx, vy, vz = vector
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )


def _quat_from_rotation(rotation: NDArray[np.float64]) -> QuatXyzw:
    """Shepperd's method: divide by the largest component."""
    m = rotation.tolist()
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0:
        s = 2 * math.sqrt(trace + 1)
        quat = ((m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4)
        return unit_quat_xyzw(quat)
    i = max(range(3), key=lambda axis: float(m[axis][axis]))
    j, k = (i + 1) % 3, (i + 2) % 3
    s = 2 * math.sqrt(1 + m[i][i] - m[j][j] - m[k][k])
    parts = [0.0, 0.0, 0.0, (m[k][j] - m[j][k]) / s]
    parts[i], parts[j], parts[k] = s / 4, (m[j][i] + m[i][j]) / s, (m[k][i] + m[i][k]) / s
    return unit_quat_xyzw((parts[0], parts[1], parts[2], parts[3]))
