"""Times, poses and transforms of either generation of ROS."""

from __future__ import annotations

import sys
from typing import Any, Literal

from gazelle.compat.rospy.rostime import Time
from gazelle.compat.rospy.state import STATE
from gazelle.graph import tf as graph_tf
from gazelle.interfaces import message_type, ros1_message_type
from gazelle.interfaces.poses import set_transform
from gazelle.interfaces.stamps import ns_of, set_stamp

__all__ = ["nanoseconds", "ros_version", "stamped", "time_of"]

RosVersion = Literal[1, 2]


def ros_version(node: Any = None) -> RosVersion:
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
    return ns_of(value) if hasattr(value, "nanosec") else int(float(value) * 1e9)


def stamped(found: graph_tf.StampedPose, made_for: RosVersion = 1) -> Any:
    """Return a ``geometry_msgs/TransformStamped`` in the form of ROS 1 or 2."""
    make = ros1_message_type if made_for == 1 else message_type
    message: Any = make("geometry_msgs/TransformStamped")()
    message.header.frame_id = found.frame_id
    message.child_frame_id = found.child_frame_id
    if made_for == 1:
        message.header.stamp = Time(nsecs=found.stamp_ns)
    else:
        set_stamp(message.header.stamp, found.stamp_ns)
    set_transform(message.transform, found.pose)
    return message


def time_of(stamp: int, made_for: RosVersion) -> Any:
    """Return a time in nanoseconds as rospy's or rclpy's class."""
    if made_for == 1:
        return Time(nsecs=stamp)
    from gazelle.compat.rclpy.time import ClockType
    from gazelle.compat.rclpy.time import Time as Rclpy

    return Rclpy(nanoseconds=stamp, clock_type=ClockType.ROS_TIME)
