"""Builds ROS messages (ROS 2 canonical classes) from poses, vectors and simulated time."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.interfaces.poses import pose_of
from gazelle.interfaces.stamps import stamp_message

__all__ = [
    "header",
    "message_class",
    "pose_from_message",
    "pose_message",
    "service_class",
    "transform_stamped",
    "twist_message",
    "vector_message",
]

Vector = tuple[float, ...] | NDArray[np.floating[Any]]


@cache
def message_class(name: str) -> Any:
    """Return the class of a type such as ``sensor_msgs/LaserScan``; imported on first use."""
    from gazelle.interfaces import message_type

    return message_type(name)


@cache
def service_class(name: str) -> Any:
    """Return the service type of a name such as ``std_srvs/Empty``."""
    from gazelle.interfaces import service_type

    return service_type(name)


def header(time_ns: int, frame_id: str) -> Any:
    """Return a ``std_msgs/Header``."""
    return message_class("std_msgs/Header")(stamp=stamp_message(time_ns), frame_id=frame_id)


def vector_message(xyz: Vector) -> Any:
    """Return a ``geometry_msgs/Vector3``."""
    return message_class("geometry_msgs/Vector3")(x=float(xyz[0]), y=float(xyz[1]), z=float(xyz[2]))


def pose_message(pose: Pose) -> Any:
    """Return a ``geometry_msgs/Pose``."""
    return message_class("geometry_msgs/Pose")(
        position=_point(pose.position_m), orientation=_quaternion(pose.quat_xyzw)
    )


def twist_message(linear: Vector, angular: Vector) -> Any:
    """Return a ``geometry_msgs/Twist``, m/s and rad/s."""
    return message_class("geometry_msgs/Twist")(
        linear=vector_message(linear), angular=vector_message(angular)
    )


def transform_stamped(time_ns: int, parent: str, child: str, T_parent_child: Pose) -> Any:
    """Return a ``geometry_msgs/TransformStamped``."""
    transform = message_class("geometry_msgs/Transform")(
        translation=vector_message(T_parent_child.position_m),
        rotation=_quaternion(T_parent_child.quat_xyzw),
    )
    return message_class("geometry_msgs/TransformStamped")(
        header=header(time_ns, parent), child_frame_id=child, transform=transform
    )


def pose_from_message(message: Any) -> Pose:
    """Read a ``geometry_msgs/Pose``; a quaternion of zeros, as unset messages have, is identity."""
    return pose_of(message).normalised()


def _point(xyz: Vector) -> Any:
    return message_class("geometry_msgs/Point")(x=float(xyz[0]), y=float(xyz[1]), z=float(xyz[2]))


def _quaternion(xyzw: Vector) -> Any:
    x, y, z, w = xyzw
    return message_class("geometry_msgs/Quaternion")(x=float(x), y=float(y), z=float(z), w=float(w))
