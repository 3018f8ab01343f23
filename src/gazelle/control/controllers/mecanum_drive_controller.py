"""``mecanum_drive_controller/MecanumDriveController`` of ROS 2."""

from __future__ import annotations

import math
from typing import Any

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.wheels.drive_parameters import frame_rows, limit_rows
from gazelle.control.wheels.kinematics import MecanumDrive, MecanumSpeeds, PlanarTwist
from gazelle.control.wheels.odometry import PlanarOdometry, offer_set_odometry
from gazelle.control.wheels.odometry_publisher import OdometryOutput, read_frames
from gazelle.control.wheels.speed_limiter import SpeedLimiter, read_limits
from gazelle.control.wheels.velocity_command import TwistInput
from gazelle.control.wheels.wheel_geometry import positive
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["TABLE", "WHEELS", "MecanumDriveController"]


WHEELS = ("front_left", "front_right", "rear_right", "rear_left")

"""The wheels in the original's order."""


def _row(
    key: str,
    kind: ParameterKind,
    default: object,
    meaning: str,
    unit: str = "",
    *,
    live: bool = False,
) -> Parameter:
    return Parameter(key, kind, default, meaning, unit=unit, live=live)


_JOINTS = tuple(
    row
    for wheel in WHEELS
    for row in (
        _row(f"{wheel}_wheel_command_joint_name", "text", None, "joint that is driven"),
        _row(f"{wheel}_wheel_state_joint_name", "text", "", "joint read instead"),
    )
)

_SUM = "kinematics.sum_of_robot_center_projection_on_X_Y_axis"

_OFFSET = "pose of the base frame in the frame of the wheels' centre"

_REST = (
    _row("kinematics.wheels_radius", "number", None, "radius of the wheels", "m"),
    _row(_SUM, "number", None, "half the length plus half the width between the wheels", "m"),
    _row("kinematics.base_frame_offset.x", "number", 0.0, _OFFSET, "m"),
    _row("kinematics.base_frame_offset.y", "number", 0.0, _OFFSET, "m"),
    _row("kinematics.base_frame_offset.theta", "number", 0.0, _OFFSET, "rad"),
    _row(
        "reference_timeout",
        "number",
        0.0,
        "how long a reference holds; with 0 it acts for one update",
        "s",
        live=True,
    ),
    _row(
        "use_stamped_vel",
        "flag",
        True,
        "whether the stamp of a TwistStamped tells its age; both types are taken anyway",
    ),
    _row("tf_frame_prefix_enable", "flag", True, "prefix the frames"),
    _row("tf_frame_prefix", "text", "", "prefix of the frames; the namespace when empty"),
)

TABLE = ControllerTable(
    ParameterTable(
        "mecanum_drive",
        "Drives a base on four mecanum wheels and publishes odometry.",
        ("mecanum_drive_controller/MecanumDriveController",),
        (
            *_JOINTS,
            *_REST,
            *frame_rows(diagonals=(0.1,) * 6),
            *limit_rows("linear.x", "linear.y", "angular.z"),
        ),
    ),
    interfaces="claims and reads velocity of four joints",
    topics=(
        Topic("~/reference", "geometry_msgs/TwistStamped", "listens"),
        Topic("~/reference_unstamped", "geometry_msgs/Twist", "listens"),
        Topic("~/odometry", "nav_msgs/Odometry", rate="every update", frame="odom_frame_id"),
        Topic("~/tf_odometry", "tf2_msgs/TFMessage", rate="every update", frame="odom_frame_id"),
        Topic(
            "~/controller_state", "control_msgs/MecanumDriveControllerState", rate="every update"
        ),
        Topic("~/set_odometry", "control_msgs/SetOdometry", "service"),
    ),
    behaviour=(
        "Without a reference that holds the wheels are commanded 0 at once, without limits.",
        "Odometry integrates arcs exactly; the original takes Euler's first-order step.",
    ),
)


class MecanumDriveController(Controller):
    """Drives four mecanum wheels in any direction."""

    TABLE = TABLE

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer the topics."""
        super().__init__(context)
        parameters = context.parameters
        joints, read = [], []
        if context.ros_version == 1 and not parameters.has("front_left_wheel_command_joint_name"):
            raise ControllerError(
                "ROS 1's mecanum_drive_controller is compiled code with parameters of its own, "
                "which is not here; ROS 2's is, with other parameters"
            )
        for wheel in WHEELS:
            parameters.require(f"{wheel}_wheel_command_joint_name")
            joints.append(parameters.text(f"{wheel}_wheel_command_joint_name"))
            read.append(parameters.text(f"{wheel}_wheel_state_joint_name") or joints[-1])
        self.commands = tuple(f"{name}/velocity" for name in joints)
        self.states = tuple(f"{name}/velocity" for name in read)
        self._command_indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
        self._drive = MecanumDrive(
            positive(context, "kinematics.wheels_radius"),
            positive(context, "kinematics.sum_of_robot_center_projection_on_X_Y_axis"),
            *(parameters.number(f"kinematics.base_frame_offset.{k}") for k in ("x", "y", "theta")),
        )
        axes = ("linear.x", "linear.y", "angular.z")
        self._limiters = tuple(SpeedLimiter(read_limits(parameters, axis, 2)) for axis in axes)
        self._active = False
        self._offer()

    def start(self, time_ns: int) -> None:
        """Wait for a reference."""
        self._active = True
        self._input.open(time_ns)
        self._output.start(time_ns, self._odometry)
        for limiter in self._limiters:
            limiter.reset()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheels, then command them."""
        period_s = period_ns * 1e-9
        speeds = MecanumSpeeds(*self.robot.interface_values.states[self._state_indices].tolist())
        if not any(map(math.isnan, speeds)):
            self._odometry.drive(*self._drive.twist(speeds), period_s)
        twist = self._input.current(time_ns)
        values = (0.0,) * 4
        if twist is None:
            for limiter in self._limiters:
                limiter.reset()
        else:
            pairs = zip(self._limiters, twist, strict=True)
            twist = PlanarTwist(*(limiter.limit(value, period_s) for limiter, value in pairs))
            values = self._drive.wheel_speeds(twist)
        self.robot.interface_values.commands[self._command_indices] = values
        self._output.publish(time_ns, self._odometry)
        if self._state.matched:
            self._publish_state(time_ns, speeds, twist)

    def stop(self, time_ns: int) -> None:
        """Stop the wheels."""
        self._active = False
        self._input.close()
        self.robot.interface_values.commands[self._command_indices] = 0.0

    def changed(self, values: dict[str, Any]) -> str:
        """Take over the timeout and whether to send tf."""
        if "reference_timeout" in values:
            self._input.timeout_s = float(values["reference_timeout"])
        self._output.changed(values)
        return ""

    def _offer(self) -> None:
        context, ports = self.context, self.context.ports
        self._odometry = PlanarOdometry()
        self._output = OdometryOutput(
            context,
            read_frames(context, namespace_prefix=True),
            odom_topic="~/odometry",
            tf_topic="~/tf_odometry",
        )
        type_name = "control_msgs/MecanumDriveControllerState"
        self._state = ports.publisher("~/controller_state", type_name)
        timeout_s = context.parameters.number("reference_timeout")
        uses_stamps = context.parameters.flag("use_stamped_vel")
        self._input = TwistInput(ports, timeout_s, uses_stamps=uses_stamps)
        self._input.listen("~/reference", stamped_first=True)
        self._input.listen("~/reference_unstamped")
        offer_set_odometry(ports, self._odometry, lambda: self._active)

    def _publish_state(
        self, time_ns: int, speeds: MecanumSpeeds, twist: PlanarTwist | None
    ) -> None:
        message = message_type("control_msgs/MecanumDriveControllerState")(
            header=header(time_ns, self._output.frames.odom),
            front_left_wheel_velocity=speeds.front_left,
            front_right_wheel_velocity=speeds.front_right,
            back_right_wheel_velocity=speeds.rear_right,
            back_left_wheel_velocity=speeds.rear_left,
        )
        reference = message.reference_velocity
        values = twist or (math.nan,) * 3
        reference.linear.x, reference.linear.y, reference.angular.z = values
        self._state.publish(message)
