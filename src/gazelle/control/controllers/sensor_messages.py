"""Messages of sensors, from values of state interfaces; NaN where there is none."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.interface_values import Array, Indices
from gazelle.interfaces.poses import set_quat_xyzw, set_xyz

__all__ = [
    "IMU_INTERFACES",
    "POSE_INTERFACES",
    "WRENCH_INTERFACES",
    "fill_imu",
    "fill_wrench",
    "sensor_indices",
]

IMU_INTERFACES = (
    *(f"orientation.{axis}" for axis in "xyzw"),
    *(f"angular_velocity.{axis}" for axis in "xyz"),
    *(f"linear_acceleration.{axis}" for axis in "xyz"),
)
WRENCH_INTERFACES = (*(f"force.{axis}" for axis in "xyz"), *(f"torque.{axis}" for axis in "xyz"))
POSE_INTERFACES = (
    *(f"position.{axis}" for axis in "xyz"),
    *(f"orientation.{axis}" for axis in "xyzw"),
)
_SHARES = (slice(0, 4), slice(4, 7), slice(7, 10))


def sensor_indices(context: ControllerContext, sensor: str, interfaces: tuple[str, ...]) -> Indices:
    """Return the indices, (n,), of a sensor's n interfaces.

    Raises:
        ControllerError: the hardware has no such sensor, or it lacks one of them.
    """
    return context.state_indices([f"{sensor}/{interface}" for interface in interfaces])


def fill_wrench(message: Any, values: Array) -> None:
    """Put force (N) and torque (N·m), (6,), into a ``geometry_msgs/WrenchStamped``."""
    set_xyz(message.wrench.force, values[:3])
    set_xyz(message.wrench.torque, values[3:])


def fill_imu(message: Any, values: Array) -> None:
    """Put values (10,) in the order of `IMU_INTERFACES` into a ``sensor_msgs/Imu``.

    What is NaN is not measured: it is 0 and its covariance begins with -1 (REP-145).
    """
    for name, share, put in zip(
        ("orientation", "angular_velocity", "linear_acceleration"),
        _SHARES,
        (set_quat_xyzw, set_xyz, set_xyz),
        strict=True,
    ):
        part = values[share]
        if np.isnan(part).any():
            covariance = np.zeros(9)
            covariance[0] = -1.0
            setattr(message, f"{name}_covariance", covariance)
            part = np.zeros(len(part))
        put(getattr(message, name), part)
