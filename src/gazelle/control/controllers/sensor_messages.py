"""Messages of sensors, from values of state interfaces; NaN where there is none."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.bank import Array, Indices
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.messages import message_class

__all__ = [
    "IMU_INTERFACES",
    "POSE_INTERFACES",
    "WRENCH_INTERFACES",
    "fill_imu",
    "fill_wrench",
    "point",
    "quaternion",
    "sensor_places",
    "vector",
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


def sensor_places(context: ControllerContext, sensor: str, interfaces: tuple[str, ...]) -> Indices:
    """Return the places of a sensor's interfaces.

    Raises:
        ControllerError: the hardware has no such sensor, or it lacks one of them.
    """
    return context.state_places([f"{sensor}/{interface}" for interface in interfaces])


def vector(values: Array) -> Any:
    """Return a ``geometry_msgs/Vector3``."""
    x, y, z = values.tolist()
    return message_class("geometry_msgs/Vector3")(x=x, y=y, z=z)


def point(values: Array) -> Any:
    """Return a ``geometry_msgs/Point``."""
    x, y, z = values.tolist()
    return message_class("geometry_msgs/Point")(x=x, y=y, z=z)


def quaternion(values: Array) -> Any:
    """Return a ``geometry_msgs/Quaternion`` of x, y, z, w."""
    x, y, z, w = values.tolist()
    return message_class("geometry_msgs/Quaternion")(x=x, y=y, z=z, w=w)


def fill_wrench(message: Any, values: Array) -> None:
    """Put force (N) and torque (N·m) into a ``geometry_msgs/WrenchStamped``."""
    message.wrench.force, message.wrench.torque = vector(values[:3]), vector(values[3:])


def fill_imu(message: Any, values: Array) -> None:
    """Put values in the order of `IMU_INTERFACES` into a ``sensor_msgs/Imu``.

    What is NaN is not measured: it is 0 and its covariance begins with -1 (REP-145).
    """
    for name, share, make in zip(
        ("orientation", "angular_velocity", "linear_acceleration"),
        _SHARES,
        (quaternion, vector, vector),
        strict=True,
    ):
        part = values[share]
        if np.isnan(part).any():
            covariance = np.zeros(9)
            covariance[0] = -1.0
            setattr(message, f"{name}_covariance", covariance)
            part = np.zeros(len(part))
        setattr(message, name, make(part))
