"""Codes of the controllers of wheeled bases."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.limit-without-value",
        "warning",
        "A limit is switched on and has no value",
        "ROS 1's controllers take 0 for it, so the robot does not move at all; ROS 2's refuse to"
        " configure or go without a limit.",
        "give the max_… of the limit",
    ),
    Entry(
        "control.limit-of-nothing",
        "warning",
        "A limit of 0 is left out",
        "Files of ROS 2 Humble have max_jerk: 0.0 where no limit was meant, since nothing switched"
        " it on. From Jazzy on such a robot does not move; here it does.",
        "write .NAN for no limit",
    ),
    Entry(
        "control.no-covariance",
        "info",
        "A base's controller has no covariances",
        "Odometry is published with covariances of 0. ROS 1's controllers end their program when"
        " pose_covariance_diagonal or twist_covariance_diagonal is missing.",
        "give six variances: x, y, z, roll, pitch, yaw",
        "ROS_ASSERT(pose_cov_list.getType() == XmlRpc::XmlRpcValue::TypeArray)",
    ),
    Entry(
        "control.wheel-measure",
        "warning",
        "A wheel's measure is taken from the robot's description",
        "ROS 2's controllers need wheel_separation and wheel_radius as parameters.",
        "give the parameter",
        "Invalid value set during initialization for parameter",
    ),
    Entry(
        "control.wheels-exchanged",
        "warning",
        "Left and right wheels are exchanged",
        "The joint named as a left wheel stands on the right side, so turns go the wrong way.",
        "exchange the names",
    ),
)
