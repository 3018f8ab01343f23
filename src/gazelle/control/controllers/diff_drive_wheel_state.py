"""Desired and actual states of the wheels, ``~/wheel_joint_controller_state`` of ROS 1."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.interface_values import Array, Indices
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header

__all__ = ["WheelStateOutput"]


class WheelStateOutput:
    """Publishes what the wheels should do, before limits, and what they do.

    The desired position is the integral of the desired speed. Accelerations are differences of
    two updates; the original multiplies the desired one by the period where it should divide.

    Args:
        context: of the controller.
        left, right: the wheels.
    """

    def __init__(
        self, context: ControllerContext, left: tuple[str, ...], right: tuple[str, ...]
    ) -> None:
        self._names = [*left, *right]
        self._half = len(left)
        self._bank = context.robot.bank
        self._places = [self._found(interface) for interface in ("position", "velocity", "effort")]
        zeros = np.zeros(len(self._names))
        self._target, self._last_desired, self._last_actual = zeros, zeros, zeros
        topic = "~/wheel_joint_controller_state"
        type_name = "control_msgs/JointTrajectoryControllerState"
        self._publisher = context.ports.publisher(topic, type_name)

    def update(self, time_ns: int, period_s: float, desired_rad_s: tuple[float, float]) -> None:
        """Go on by a period with the desired speeds of the left and right wheels."""
        speeds = np.repeat(desired_rad_s, self._half)
        self._target = self._target + speeds * period_s
        position, velocity, effort = (self._read(places) for places in self._places)
        last_desired, self._last_desired = self._last_desired, speeds
        last_actual, self._last_actual = self._last_actual, velocity
        if not self._publisher.matched:
            return
        wanted = (self._target, speeds, (speeds - last_desired) / period_s, speeds * np.nan)
        actual = (position, velocity, (velocity - last_actual) / period_s, effort)
        error = tuple(one - other for one, other in zip(wanted, actual, strict=True))
        message = message_type("control_msgs/JointTrajectoryControllerState")(
            header=header(time_ns, ""),
            joint_names=self._names,
            reference=_point(*wanted),
            feedback=_point(*actual),
            error=_point(*error),
        )
        self._publisher.publish(message)

    def _found(self, interface: str) -> Indices | None:
        names = [f"{name}/{interface}" for name in self._names]
        index = self._bank.state_index
        return self._bank.state_places(names) if all(name in index for name in names) else None

    def _read(self, places: Indices | None) -> Array:
        if places is None:
            return np.full(len(self._names), np.nan)
        return self._bank.states[places]


def _point(position: Array, velocity: Array, acceleration: Array, effort: Array) -> Any:
    return message_type("trajectory_msgs/JointTrajectoryPoint")(
        positions=position, velocities=velocity, accelerations=acceleration, effort=effort
    )
