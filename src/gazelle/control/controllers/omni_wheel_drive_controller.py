"""``omni_wheel_drive_controller/OmniWheelDriveController`` of ROS 2."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.wheels.drive_parameters import frame_rows
from gazelle.control.wheels.kinematics import OmniDrive
from gazelle.control.wheels.odometry import PlanarOdometry, WheelTravel, offer_set_odometry
from gazelle.control.wheels.odometry_publisher import OdometryOutput, read_covariance, read_frames
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import positive
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["OmniWheelDriveController"]

_VARIANCES = "variances of x, y, z, roll, pitch, yaw"
_ROWS = (
    Parameter("wheel_names", "texts", None, "joints, counter-clockwise"),
    Parameter("wheel_offset", "number", None, "angle of the first wheel from x", unit="rad"),
    Parameter("robot_radius", "number", None, "distance of the wheels from the centre", unit="m"),
    Parameter("wheel_radius", "number", None, "radius of a wheel", unit="m"),
    Parameter("open_loop", "flag", False, "odometry from commands, not from the wheels"),
    Parameter("position_feedback", "flag", True, "odometry from positions, else velocities"),
    Parameter("cmd_vel_timeout", "number", 0.5, "how long a command holds", unit="s"),
    Parameter("tf_frame_prefix_enable", "flag", True, "prefix the frames"),
    Parameter("tf_frame_prefix", "text", "", "prefix of the frames; the namespace when empty"),
    Parameter("diagonal_covariance.pose", "numbers", (0.0,) * 6, f"{_VARIANCES} of the pose"),
    Parameter("diagonal_covariance.twist", "numbers", (0.0,) * 6, f"{_VARIANCES} of the twist"),
)


class OmniWheelDriveController(Controller):
    """Drives three or more omnidirectional wheels on a circle."""

    TABLE = ControllerTable(
        ParameterTable(
            "omni_wheel_drive",
            "Drives a base on three or more omnidirectional wheels and publishes odometry.",
            ("omni_wheel_drive_controller/OmniWheelDriveController",),
            (
                *_ROWS,
                *(row for row in frame_rows(diagonals=None) if "covariance" not in row.key),
            ),
        ),
        interfaces="claims velocity of every wheel; reads position (velocity with"
        " position_feedback: false)",
        topics=(
            Topic("~/cmd_vel", "geometry_msgs/TwistStamped", "listens"),
            Topic("~/odom", "nav_msgs/Odometry", rate="every update", frame="odom_frame_id"),
            Topic("/tf", "tf2_msgs/TFMessage", rate="every update", frame="odom_frame_id"),
            Topic("~/set_odometry", "control_msgs/SetOdometry", "service"),
        ),
        behaviour=(
            "Wheels stand at equal angles; a positive speed drives the base clockwise about its"
            " centre (OmniWheelDriveController).",
            "Odometry takes the velocity that fits all wheels best in the sense of squares.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer the topics."""
        super().__init__(context)
        parameters = context.parameters
        for key in ("wheel_names", "wheel_offset"):
            parameters.require(key)
        wheels = parameters.texts("wheel_names")
        if len(wheels) < 3:
            text = f"controller '{context.name}': wheel_names has {len(wheels)} joints, three are"
            raise ControllerError(text + " needed (The number of wheels is less than 3)")
        self._feedback = "position" if parameters.flag("position_feedback") else "velocity"
        self.commands = tuple(f"{name}/velocity" for name in wheels)
        self.states = tuple(f"{name}/{self._feedback}" for name in wheels)
        self._command_indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
        self._drive = OmniDrive(
            len(wheels),
            positive(context, "robot_radius"),
            positive(context, "wheel_radius"),
            parameters.number("wheel_offset"),
        )
        self._open_loop = parameters.flag("open_loop")
        self._active = False
        self._offer()

    def start(self, time_ns: int) -> None:
        """Wait for a command."""
        self._active = True
        self._input.open(time_ns)
        self._output.start(time_ns, self._odometry)
        self._travel.clear()
        self.robot.interface_values.commands[self._command_indices] = 0.0

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheels, then command them."""
        period_s = period_ns * 1e-9
        twist = self._input.current(time_ns) or REST
        if self._open_loop:
            self._odometry.drive_open_loop(*twist, period_s)
        else:
            self._follow(period_s)
        self._output.publish(time_ns, self._odometry)
        self.robot.interface_values.commands[self._command_indices] = self._drive.wheel_speeds(
            twist
        )

    def stop(self, time_ns: int) -> None:
        """Stop the wheels."""
        self._active = False
        self._input.close()
        self.robot.interface_values.commands[self._command_indices] = 0.0

    def changed(self, values: dict[str, Any]) -> str:
        """Take over whether to send tf."""
        self._output.changed(values)
        return ""

    def _offer(self) -> None:
        context, parameters, ports = self.context, self.context.parameters, self.context.ports
        self._odometry = PlanarOdometry()
        self._travel = WheelTravel()
        self._output = OdometryOutput(
            context,
            read_frames(context, namespace_prefix=True),
            covariances=(
                read_covariance(parameters, "diagonal_covariance.pose"),
                read_covariance(parameters, "diagonal_covariance.twist"),
            ),
        )
        timeout_s = parameters.number("cmd_vel_timeout")
        self._input = TwistInput(ports, timeout_s, uses_stamps=True)
        self._input.listen("~/cmd_vel", stamped_first=True)
        offer_set_odometry(ports, self._odometry, lambda: self._active)

    def _follow(self, period_s: float) -> None:
        values = tuple(self.robot.interface_values.states[self._state_indices].tolist())
        if any(map(math.isnan, values)):
            return
        if self._feedback == "position":
            values = tuple(turned / period_s for turned in self._travel.step(values))
        self._odometry.drive(*self._drive.twist(np.array(values)), period_s)
