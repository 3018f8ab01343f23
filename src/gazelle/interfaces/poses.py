"""Poses, transforms and twists in messages ↔ `gazelle.geometry.Pose` and numbers.

What is read or written may be of either generation, what is made is of ROS 2.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from gazelle.geometry import Pose, QuatXyzw, Vector3
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import stamped

__all__ = [
    "pose_message",
    "pose_of",
    "pose_of_transform",
    "quat_xyzw_of",
    "set_plane_pose",
    "set_pose",
    "set_quat_xyzw",
    "set_transform",
    "set_xyz",
    "transform_stamped",
    "twist_message",
    "unit_pose_of",
    "vector_message",
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


def vector_message(xyz: Iterable[float]) -> Any:
    """Return a ``geometry_msgs/Vector3`` of ROS 2."""
    return message_type("geometry_msgs/msg/Vector3")(*map(float, xyz))


def pose_message(pose: Pose) -> Any:
    """Return a ``geometry_msgs/Pose`` of ROS 2."""
    message = message_type("geometry_msgs/msg/Pose")()
    set_pose(message, pose)
    return message


def twist_message(linear: Iterable[float], angular: Iterable[float]) -> Any:
    """Return a ``geometry_msgs/Twist`` of ROS 2, m/s and rad/s."""
    twist = message_type("geometry_msgs/msg/Twist")
    return twist(linear=vector_message(linear), angular=vector_message(angular))


def transform_stamped(time_ns: int, parent: str, child: str, T_parent_child: Pose) -> Any:
    """Return a ``geometry_msgs/TransformStamped`` of ROS 2."""
    message = stamped("geometry_msgs/msg/TransformStamped", time_ns, parent)
    message.child_frame_id = child
    set_transform(message.transform, T_parent_child)
    return message
