"""Poses and transforms as lists, as moveit_commander's users write them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.compat.moveit.commander.exception import MoveItCommanderException
from gazelle.compat.rospy.rostime import Time
from gazelle.compat.rospy.state import STATE
from gazelle.geometry import Pose
from gazelle.interfaces import ros1_message_type
from gazelle.interfaces.poses import set_pose

__all__ = [
    "list_to_pose",
    "list_to_pose_stamped",
    "list_to_transform",
    "pose_of_list",
    "pose_to_list",
    "transform_to_list",
]


def pose_of_list(values: Sequence[float]) -> Pose:
    """Return the pose of x, y, z and roll, pitch, yaw or a quaternion x, y, z, w.

    Raises:
        MoveItCommanderException: there are neither 6 nor 7 numbers.
    """
    numbers = [float(value) for value in values]
    if len(numbers) == 7:
        x, y, z, qx, qy, qz, qw = numbers
        return Pose((x, y, z), (qx, qy, qz, qw))
    if len(numbers) == 6:
        x, y, z, roll, pitch, yaw = numbers
        return Pose.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
    raise MoveItCommanderException(
        "Expected either 6 or 7 elements in list: (x,y,z,r,p,y) or (x,y,z,qx,qy,qz,qw)"
    )


def list_to_pose(pose_list: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/Pose``; see `pose_of_list`."""
    return _message(pose_of_list(pose_list))


def list_to_pose_stamped(pose_list: Sequence[float], target_frame: str) -> Any:
    """Return a ``geometry_msgs/PoseStamped`` in a frame, with the time once rospy has one."""
    made: Any = ros1_message_type("geometry_msgs/PoseStamped")()
    made.pose = list_to_pose(pose_list)
    made.header.frame_id = target_frame
    if STATE.node is not None:
        made.header.stamp = Time.now()
    return made


def pose_to_list(pose_msg: Any) -> list[float]:
    """Return x, y, z and the quaternion of a pose."""
    position, orientation = pose_msg.position, pose_msg.orientation
    return [
        position.x,
        position.y,
        position.z,
        orientation.x,
        orientation.y,
        orientation.z,
        orientation.w,
    ]


def transform_to_list(trf_msg: Any) -> list[float]:
    """Return x, y, z and the quaternion of a transform."""
    position, orientation = trf_msg.translation, trf_msg.rotation
    return [
        position.x,
        position.y,
        position.z,
        orientation.x,
        orientation.y,
        orientation.z,
        orientation.w,
    ]


def list_to_transform(trf_list: Sequence[float]) -> Any:
    """Return a ``geometry_msgs/Transform`` of x, y, z and a quaternion."""
    made: Any = ros1_message_type("geometry_msgs/Transform")()
    shift, orientation = made.translation, made.rotation
    shift.x, shift.y, shift.z, orientation.x, orientation.y, orientation.z, orientation.w = map(
        float, trf_list
    )
    return made


def _message(pose: Pose) -> Any:
    made: Any = ros1_message_type("geometry_msgs/Pose")()
    set_pose(made, pose)
    return made
