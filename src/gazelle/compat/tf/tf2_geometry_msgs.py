"""tf2_geometry_msgs: points, vectors, poses and wrenches into other frames, of ROS 1 and ROS 2."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.compat.tf.buffer_interface import TransformRegistration
from gazelle.geometry import Pose
from gazelle.interfaces import message_type, ros1_message_type
from gazelle.interfaces.poses import pose_of, pose_of_transform, set_pose, set_xyz, xyz_of

__all__ = [
    "do_transform_point",
    "do_transform_pose",
    "do_transform_pose_stamped",
    "do_transform_pose_with_covariance_stamped",
    "do_transform_vector3",
    "do_transform_wrench",
    "register",
]


def do_transform_point(point: Any, transform: Any) -> Any:
    """Return a ``PointStamped`` in the transform's frame."""
    found = _copied(point, transform)
    pose = pose_of_transform(transform.transform) @ Pose(xyz_of(point.point))
    set_xyz(found.point, pose.position_m)
    return found


def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """Return a ``Vector3Stamped``, turned and not moved."""
    found = _copied(vector3, transform)
    _rotate(found.vector, pose_of_transform(transform.transform))
    return found


def do_transform_pose(pose: Any, transform: Any) -> Any:
    """Return a ``PoseStamped``, or a ``Pose`` as since Humble, in the transform's frame."""
    if not hasattr(pose, "header"):
        found = copy.deepcopy(pose)
        _move(found, transform)
        return found
    return do_transform_pose_stamped(pose, transform)


def do_transform_pose_stamped(pose: Any, transform: Any) -> Any:
    """Return a ``PoseStamped`` in the transform's frame."""
    found = _copied(pose, transform)
    _move(found.pose, transform)
    return found


def do_transform_pose_with_covariance_stamped(pose: Any, transform: Any) -> Any:
    """Return a ``PoseWithCovarianceStamped`` in the transform's frame, covariance turned too."""
    found = _copied(pose, transform)
    _move(found.pose.pose, transform)
    turn = np.zeros((6, 6))
    turn[:3, :3] = turn[3:, 3:] = pose_of_transform(transform.transform).matrix()[:3, :3]
    covariance = np.array(pose.pose.covariance, float).reshape(6, 6)
    found.pose.covariance = (turn @ covariance @ turn.T).ravel().tolist()
    return found


def do_transform_wrench(wrench: Any, transform: Any) -> Any:
    """Return a ``WrenchStamped``, force and torque turned."""
    found = _copied(wrench, transform)
    pose = pose_of_transform(transform.transform)
    _rotate(found.wrench.force, pose)
    _rotate(found.wrench.torque, pose)
    return found


_FUNCTIONS: dict[str, Callable[[Any, Any], Any]] = {
    "PointStamped": do_transform_point,
    "PoseStamped": do_transform_pose_stamped,
    "PoseWithCovarianceStamped": do_transform_pose_with_covariance_stamped,
    "Vector3Stamped": do_transform_vector3,
    "WrenchStamped": do_transform_wrench,
}


def register() -> None:
    """Let buffers transform these messages."""
    registration = TransformRegistration()
    for name, function in _FUNCTIONS.items():
        for make in (ros1_message_type, message_type):
            registration.add(make(f"geometry_msgs/{name}"), function)


def _copied(message: Any, transform: Any) -> Any:
    found = copy.deepcopy(message)
    found.header = copy.deepcopy(transform.header)
    return found


def _move(pose: Any, transform: Any) -> None:
    set_pose(pose, pose_of_transform(transform.transform) @ pose_of(pose))


def _rotate(vector: Any, pose: Pose) -> None:
    set_xyz(vector, pose.rotate(xyz_of(vector)))
