"""What messages measure of an `Ekf`'s state."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose, unit_quat_xyzw
from gazelle.interfaces.poses import quat_xyzw_of, unit_pose_of
from gazelle.navigation.filters.ekf import rotation_of

__all__ = ["Measurement", "differential", "measure_imu", "measure_pose", "measure_twist"]

GRAVITY_M_S2 = 9.80665


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """Values of all states, and which of them are measured.

    Attributes:
        stamp_ns: when.
        values: (15,).
        covariance: (15, 15).
        measured: (15,), those that the message has.
    """

    stamp_ns: int
    values: NDArray[np.float64]
    covariance: NDArray[np.float64]
    measured: NDArray[np.bool_]


def measure_pose(message: Any, stamp_ns: int) -> Measurement:
    """Read a ``PoseWithCovariance``."""
    pose = unit_pose_of(message.pose)
    values, covariance = np.zeros(15), np.zeros((15, 15))
    values[:3], values[3:6] = pose.position_m, pose.rpy_rad
    covariance[:6, :6] = np.asarray(message.covariance, float).reshape(6, 6)
    return Measurement(stamp_ns, values, covariance, np.arange(15) < 6)


def measure_twist(message: Any, stamp_ns: int) -> Measurement:
    """Read a ``TwistWithCovariance``."""
    linear, angular = message.twist.linear, message.twist.angular
    values, covariance = np.zeros(15), np.zeros((15, 15))
    values[6:12] = linear.x, linear.y, linear.z, angular.x, angular.y, angular.z
    covariance[6:12, 6:12] = np.asarray(message.covariance, float).reshape(6, 6)
    k = np.arange(15)
    return Measurement(stamp_ns, values, covariance, (k >= 6) & (k < 12))


def measure_imu(
    message: Any, stamp_ns: int, T_base_imu: Pose, *, without_gravity: bool = False
) -> Measurement:
    """Read a ``sensor_msgs/Imu`` whose sensor may be turned on the robot.

    A covariance that begins with −1 says that the sensor does not measure that.
    """
    turn = rotation_of(*T_base_imu.rpy_rad)
    world_imu = Pose(quat_xyzw=unit_quat_xyzw(quat_xyzw_of(message.orientation)))
    base = world_imu @ Pose((0.0, 0.0, 0.0), T_base_imu.quat_xyzw).inverse()
    values, covariance = np.zeros(15), np.zeros((15, 15))
    values[3:6] = base.rpy_rad
    w, a = message.angular_velocity, message.linear_acceleration
    values[9:12] = turn @ np.array([w.x, w.y, w.z])
    values[12:15] = turn @ np.array([a.x, a.y, a.z])
    if without_gravity:
        values[12:15] -= rotation_of(*base.rpy_rad).T @ np.array([0.0, 0.0, GRAVITY_M_S2])
    measured = np.zeros(15, bool)
    for first, block in (
        (3, message.orientation_covariance),
        (9, message.angular_velocity_covariance),
        (12, message.linear_acceleration_covariance),
    ):
        held = np.asarray(block, float).reshape(3, 3)
        measured[first : first + 3] = held[0, 0] >= 0
        covariance[first : first + 3, first : first + 3] = turn @ held @ turn.T
    return Measurement(stamp_ns, values, covariance, measured)


def differential(before: Measurement, after: Measurement) -> Measurement | None:
    """Return the velocities that lead from one pose to the next; None without time between."""
    dt_s = (after.stamp_ns - before.stamp_ns) * 1e-9
    if dt_s <= 1e-6:
        return None
    values, covariance = np.zeros(15), np.zeros((15, 15))
    turn = rotation_of(*before.values[3:6])
    values[6:9] = turn.T @ (after.values[:3] - before.values[:3]) / dt_s
    turned = after.values[3:6] - before.values[3:6]
    values[9:12] = [math.remainder(float(angle), math.tau) / dt_s for angle in turned]
    spread = (before.covariance[:6, :6] + after.covariance[:6, :6]) / dt_s**2
    covariance[6:12, 6:12] = spread
    measured = np.zeros(15, bool)
    measured[6:12] = before.measured[:6] & after.measured[:6]
    return Measurement(after.stamp_ns, values, covariance, measured)
