"""Poses and transforms in messages of either generation ↔ `gazelle.geometry.Pose`."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from gazelle.geometry import Pose, QuatXyzw, Vector3

__all__ = [
    "pose_of",
    "pose_of_transform",
    "quat_xyzw_of",
    "set_plane_pose",
    "set_pose",
    "set_quat_xyzw",
    "set_transform",
    "set_xyz",
    "unit_pose_of",
    "xyz_of",
]


def xyz_of(vector: Any) -> Vector3:
    """Return a ``Point`` or ``Vector3``."""
    return float(vector.x), float(vector.y), float(vector.z)


def quat_xyzw_of(quaternion: Any) -> QuatXyzw:
    """Return a ``Quaternion`` at the length that it has."""
    x, y, z, w = quaternion.x, quaternion.y, quaternion.z, quaternion.w
    return float(x), float(y), float(z), float(w)


def pose_of(message: Any) -> Pose:
    """Return a ``geometry_msgs/Pose``; its quaternion keeps its length."""
    return Pose(xyz_of(message.position), quat_xyzw_of(message.orientation))


def unit_pose_of(message: Any) -> Pose:
    """Return a ``geometry_msgs/Pose`` with a unit quaternion.

    One of zeros, as unset messages have, and one that is not finite mean no rotation.
    """
    pose = pose_of(message)
    is_finite = all(map(math.isfinite, pose.quat_xyzw))
    return pose.normalised() if is_finite else Pose(pose.position_m)


def pose_of_transform(message: Any) -> Pose:
    """Return a ``geometry_msgs/Transform``; its quaternion keeps its length."""
    return Pose(xyz_of(message.translation), quat_xyzw_of(message.rotation))


def set_xyz(vector: Any, values: Iterable[float]) -> None:
    """Write into a ``Point`` or ``Vector3``."""
    vector.x, vector.y, vector.z = map(float, values)


def set_quat_xyzw(quaternion: Any, values: Iterable[float]) -> None:
    """Write into a ``Quaternion``."""
    quaternion.x, quaternion.y, quaternion.z, quaternion.w = map(float, values)


def set_pose(message: Any, pose: Pose) -> None:
    """Write into a ``geometry_msgs/Pose``."""
    set_xyz(message.position, pose.position_m)
    set_quat_xyzw(message.orientation, pose.quat_xyzw)


def set_plane_pose(message: Any, xy_yaw: Vector3) -> None:
    """Write a pose of the ground plane (x, y in metres, yaw in radians) into a ``Pose``."""
    x, y, yaw = map(float, xy_yaw)
    set_pose(message, Pose.from_xy_yaw(x, y, yaw))


def set_transform(message: Any, pose: Pose) -> None:
    """Write into a ``geometry_msgs/Transform``."""
    set_xyz(message.translation, pose.position_m)
    set_quat_xyzw(message.rotation, pose.quat_xyzw)
