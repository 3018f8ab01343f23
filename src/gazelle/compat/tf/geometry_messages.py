"""tf2_geometry_msgs: points, vectors, poses and wrenches into other frames."""

from __future__ import annotations

import copy
from typing import Any

from gazelle.compat.tf.tf2_ros import TransformRegistration, pose_of
from gazelle.geometry import Pose
from gazelle.interfaces import ros1_message_type

__all__ = [
    "do_transform_point",
    "do_transform_pose",
    "do_transform_vector3",
    "do_transform_wrench",
    "register",
]


def do_transform_point(point: Any, transform: Any) -> Any:
    """Return a ``PointStamped`` in the transform's frame."""
    found = _copied(point, transform)
    pose = pose_of(transform.transform) @ Pose((point.point.x, point.point.y, point.point.z))
    found.point.x, found.point.y, found.point.z = pose.position_m
    return found


def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """Return a ``Vector3Stamped``, turned and not moved."""
    found = _copied(vector3, transform)
    _rotate(found.vector, pose_of(transform.transform))
    return found


def do_transform_pose(pose: Any, transform: Any) -> Any:
    """Return a ``PoseStamped`` in the transform's frame."""
    found = _copied(pose, transform)
    at, turn = pose.pose.position, pose.pose.orientation
    inner = Pose((at.x, at.y, at.z), (turn.x, turn.y, turn.z, turn.w))
    result = pose_of(transform.transform) @ inner
    to, onto = found.pose.position, found.pose.orientation
    to.x, to.y, to.z = result.position_m
    onto.x, onto.y, onto.z, onto.w = result.quat_xyzw
    return found


def do_transform_wrench(wrench: Any, transform: Any) -> Any:
    """Return a ``WrenchStamped``, force and torque turned."""
    found = _copied(wrench, transform)
    pose = pose_of(transform.transform)
    _rotate(found.wrench.force, pose)
    _rotate(found.wrench.torque, pose)
    return found


def register() -> None:
    """Let buffers transform these messages."""
    registration = TransformRegistration()
    for name, function in (
        ("PointStamped", do_transform_point),
        ("PoseStamped", do_transform_pose),
        ("Vector3Stamped", do_transform_vector3),
        ("WrenchStamped", do_transform_wrench),
    ):
        registration.add(ros1_message_type(f"geometry_msgs/{name}"), function)


def _copied(message: Any, transform: Any) -> Any:
    found = copy.deepcopy(message)
    found.header = copy.deepcopy(transform.header)
    return found


def _rotate(vector: Any, pose: Pose) -> None:
    vector.x, vector.y, vector.z = pose.rotate((vector.x, vector.y, vector.z))
