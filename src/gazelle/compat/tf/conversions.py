"""Times, poses and transforms of either generation of ROS."""

from __future__ import annotations

import sys
from typing import Any, Literal

from gazelle.compat.rospy.rostime import Time
from gazelle.compat.rospy.state import STATE
from gazelle.geometry import Pose
from gazelle.graph import tf as graph_tf
from gazelle.graph.actions.stamps import set_stamp, stamp_ns
from gazelle.interfaces import message_type, ros1_message_type

__all__ = ["generation", "nanoseconds", "pose_of", "stamped", "time_of"]

Generation = Literal[1, 2]


def generation(node: Any = None) -> Generation:
    """Return 2 for a node of rclpy or a program that imports it and not rospy, 1 otherwise."""
    if hasattr(node, "graph_node"):
        return 2
    return 2 if "rclpy" in sys.modules and STATE.node is None else 1


def nanoseconds(value: Any) -> int:
    """Return a time or duration in nanoseconds: rospy's, rclpy's, a message's or seconds."""
    if hasattr(value, "to_nsec"):
        return int(value.to_nsec())
    if hasattr(value, "nanoseconds"):
        return int(value.nanoseconds)
    return stamp_ns(value) if hasattr(value, "nanosec") else int(float(value) * 1e9)


def stamped(found: graph_tf.StampedPose, made_for: Generation = 1) -> Any:
    """Return a ``geometry_msgs/TransformStamped`` in the form of ROS 1 or 2."""
    make = ros1_message_type if made_for == 1 else message_type
    message: Any = make("geometry_msgs/TransformStamped")()
    message.header.frame_id = found.frame_id
    message.child_frame_id = found.child_frame_id
    if made_for == 1:
        message.header.stamp = Time(*divmod(found.stamp_ns, 1_000_000_000))
    else:
        set_stamp(message.header.stamp, found.stamp_ns)
    move, turn = message.transform.translation, message.transform.rotation
    move.x, move.y, move.z = found.pose.position_m
    turn.x, turn.y, turn.z, turn.w = found.pose.quat_xyzw
    return message


def time_of(stamp: int, made_for: Generation) -> Any:
    """Return a time in nanoseconds as rospy's or rclpy's class."""
    if made_for == 1:
        return Time(*divmod(stamp, 1_000_000_000))
    from gazelle.compat.rclpy.time import ClockType
    from gazelle.compat.rclpy.time import Time as Rclpy

    return Rclpy(nanoseconds=stamp, clock_type=ClockType.ROS_TIME)


def pose_of(transform: Any) -> Pose:
    """Return the pose of a ``geometry_msgs/Transform``."""
    move, turn = transform.translation, transform.rotation
    return Pose((move.x, move.y, move.z), (turn.x, turn.y, turn.z, turn.w))
