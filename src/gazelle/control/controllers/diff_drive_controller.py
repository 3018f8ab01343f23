"""``diff_drive_controller/DiffDriveController`` of ROS 1 and ROS 2."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.control.controller_node_interface import LiveParameter
from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array, Indices
from gazelle.control.wheels.drive_parameters import command_rows, frame_rows, limit_rows
from gazelle.control.wheels.kinematics import DifferentialDrive
from gazelle.control.wheels.odometry import PlanarOdometry, WheelTravel, offer_set_odometry
from gazelle.control.wheels.odometry_publisher import OdometryOutput, read_frames
from gazelle.control.wheels.speed_limiter import SpeedLimiter, read_limits
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import (
    joint_distance_m,
    measure,
    report_exchanged,
    report_misfits,
    wheel_radius_m,
)
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["TABLE", "DiffDriveController", "WheelStateOutput"]


_SUMMARY = (
    "Drives a base with one or more wheels a side from a velocity command and publishes odometry."
    " The wheels of a side get the same command; odometry takes their mean."
)

_WHEELS = (
    Parameter(
        "left_wheel_names", "texts", None, "joints of the left wheels", aliases=("left_wheel",)
    ),
    Parameter(
        "right_wheel_names", "texts", None, "joints of the right wheels", aliases=("right_wheel",)
    ),
    Parameter(
        "wheel_separation",
        "number",
        None,
        "distance of left and right wheels; from the URDF when absent",
        unit="m",
    ),
    Parameter(
        "wheel_radius",
        "number",
        None,
        "radius of the wheels; from the first left wheel's collision when absent",
        unit="m",
    ),
    Parameter("wheel_separation_multiplier", "number", 1.0, "corrects the separation", live=True),
    Parameter("wheel_radius_multiplier", "number", None, "corrects both radii", ros_versions=(1,)),
    Parameter("left_wheel_radius_multiplier", "number", 1.0, "corrects the left radius", live=True),
    Parameter(
        "right_wheel_radius_multiplier", "number", 1.0, "corrects the right radius", live=True
    ),
    Parameter(
        "wheels_per_side",
        "refused",
        0,
        "the number of wheels is that of the names, as in the original",
        ros_versions=(2,),
    ),
)

_COMMANDS = (
    Parameter("cmd_vel_timeout", "number", 0.5, "how long a command holds", unit="s", live=True),
    Parameter(
        "allow_multiple_cmd_vel_publishers",
        "refused",
        True,
        "senders are not counted; all of them are heard",
        ros_versions=(1,),
    ),
    Parameter(
        "use_stamped_vel",
        "flag",
        True,
        "whether the stamp of a TwistStamped tells its age; Twist and TwistStamped are both"
        " taken on both topics anyway",
        ros_versions=(2,),
    ),
    Parameter(
        "publish_limited_velocity",
        "flag",
        False,
        "publish the command after the limits",
        aliases=("publish_cmd",),
    ),
    Parameter(
        "publish_wheel_joint_controller_state",
        "flag",
        False,
        "publish desired and actual wheel states",
        ros_versions=(1,),
    ),
    Parameter(
        "position_feedback",
        "flag",
        True,
        "odometry from positions, else from velocities",
        ros_versions=(2,),
    ),
    Parameter("publish_rate", "number", 50.0, "rate of odometry and tf", unit="Hz", live=True),
    Parameter("tf_frame_prefix_enable", "flag", True, "prefix the frames", ros_versions=(2,)),
    Parameter(
        "tf_frame_prefix",
        "text",
        "",
        "prefix of the frames; the namespace when empty, ~ stands for it",
        ros_versions=(2,),
    ),
)

TABLE = ControllerTable(
    ParameterTable(
        "diff_drive",
        _SUMMARY,
        ("diff_drive_controller/DiffDriveController",),
        (
            *_WHEELS,
            *_COMMANDS,
            *command_rows(),
            *frame_rows(diagonals=None),
            *limit_rows("linear.x", "angular.z"),
        ),
    ),
    interfaces="claims velocity of every wheel; reads position (velocity with"
    " position_feedback: false)",
    topics=(
        Topic("~/cmd_vel", "geometry_msgs/Twist", "listens", ros_versions=(1,)),
        Topic("~/cmd_vel", "geometry_msgs/TwistStamped", "listens", ros_versions=(2,)),
        Topic("~/cmd_vel_unstamped", "geometry_msgs/Twist", "listens", ros_versions=(2,)),
        Topic("~/odom", "nav_msgs/Odometry", rate="publish_rate", frame="odom_frame_id"),
        Topic("/tf", "tf2_msgs/TFMessage", rate="publish_rate", frame="odom_frame_id"),
        Topic("~/cmd_vel_out", "geometry_msgs/TwistStamped", rate="every update"),
        Topic(
            "~/wheel_joint_controller_state",
            "control_msgs/JointTrajectoryControllerState",
            rate="every update",
            ros_versions=(1,),
        ),
        Topic("~/set_parameters", "dynamic_reconfigure/Reconfigure", "service", ros_versions=(1,)),
        Topic("~/set_odometry", "control_msgs/SetOdometry", "service", ros_versions=(2,)),
    ),
    behaviour=(
        "A command older than cmd_vel_timeout counts as 0; the limits bound the braking, too."
        " In ROS 2 a timeout of 0 means that a command holds for ever.",
        "Limits act in the order jerk, acceleration, velocity. ROS 1's jerk limit lets"
        " acceleration change by 2·jerk·dt a period, so measured jerk reaches twice the parameter,"
        " and the speed swings about its target (diff_drive_controller::SpeedLimiter;"
        " control_toolbox#240).",
        "Odometry integrates arcs exactly; its velocities are means over"
        " velocity_rolling_window_size updates.",
        "Without wheel_separation or wheel_radius ROS 1 takes them from the URDF; real ROS 2"
        " would refuse to configure.",
    ),
)


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
        self._interface_values = context.robot.interface_values
        self._indices = [self._found(interface) for interface in ("position", "velocity", "effort")]
        zeros = np.zeros(len(self._names))
        self._target, self._last_desired, self._last_actual = zeros, zeros, zeros
        topic = "~/wheel_joint_controller_state"
        type_name = "control_msgs/JointTrajectoryControllerState"
        self._publisher = context.ports.publisher(topic, type_name)

    def update(self, time_ns: int, period_s: float, desired_rad_s: tuple[float, float]) -> None:
        """Go on by a period with the desired speeds of the left and right wheels."""
        speeds = np.repeat(desired_rad_s, self._half)
        self._target = self._target + speeds * period_s
        position, velocity, effort = (self._read(indices) for indices in self._indices)
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
        index = self._interface_values.state_index
        return (
            self._interface_values.state_indices(names)
            if all(name in index for name in names)
            else None
        )

    def _read(self, indices: Indices | None) -> Array:
        if indices is None:
            return np.full(len(self._names), np.nan)
        return self._interface_values.states[indices]


def _point(position: Array, velocity: Array, acceleration: Array, effort: Array) -> Any:
    return message_type("trajectory_msgs/JointTrajectoryPoint")(
        positions=position, velocities=velocity, accelerations=acceleration, effort=effort
    )


class DiffDriveController(Controller):
    """Drives the wheels of both sides from velocity commands."""

    TABLE = TABLE

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer the topics."""
        super().__init__(context)
        self._left, self._right = _wheel_names(context)
        wheels = (*self._left, *self._right)
        self.commands = tuple(f"{name}/velocity" for name in wheels)
        parameters = context.parameters
        self._open_loop = parameters.flag("open_loop")
        self._feedback = "velocity"
        if context.ros_version == 1 or parameters.flag("position_feedback"):
            self._feedback = "position"
        self.states = tuple(f"{name}/{self._feedback}" for name in wheels)
        self._command_indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
        self._active = False
        self._read_geometry()
        self._limiters = (
            SpeedLimiter(read_limits(parameters, "linear.x", context.ros_version)),
            SpeedLimiter(read_limits(parameters, "angular.z", context.ros_version)),
        )
        self._applied = (0.0, 0.0)
        self._offer()

    def start(self, time_ns: int) -> None:
        """Stand still and count time from now."""
        self._active = True
        self._command(0.0, 0.0)
        self._applied = (0.0, 0.0)
        for limiter in self._limiters:
            limiter.reset()
        self._input.open(time_ns)
        self._output.start(time_ns, self._odometry)
        self._travel.clear()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheels, then command them."""
        period_s = period_ns * 1e-9
        if not self._follow(period_s):
            return
        self._output.publish(time_ns, self._odometry)
        twist = self._input.current(time_ns) or REST
        linear = self._limiters[0].limit(twist.linear_x, period_s)
        angular = self._limiters[1].limit(twist.angular_z, period_s)
        self._applied = (linear, angular)
        if self._limited is not None and self._limited.matched:
            self._publish_limited(time_ns, linear, angular)
        self._command(*self._drive.wheel_speeds(linear, angular))
        if self._wheel_state is not None:
            desired = self._drive.wheel_speeds(twist.linear_x, twist.angular_z)
            self._wheel_state.update(time_ns, period_s, desired)

    def stop(self, time_ns: int) -> None:
        """Brake."""
        self._active = False
        self._input.close()
        self._command(0.0, 0.0)

    def changed(self, values: dict[str, Any]) -> str:
        """Take over multipliers, rate, timeout and whether to send tf."""
        for key in ("wheel_separation", "left_wheel_radius", "right_wheel_radius"):
            value = values.get(f"{key}_multiplier")
            if value is not None and not float(value) > 0:
                return f"{key}_multiplier must be above 0"
        self._multipliers.update({k: float(v) for k, v in values.items() if "multiplier" in k})
        self._apply_multipliers()
        if "publish_rate" in values:
            self._output.rate.set_rate(float(values["publish_rate"]))
        self._output.changed(values)
        if "cmd_vel_timeout" in values:
            self._input.timeout_s = float(values["cmd_vel_timeout"])
        return ""

    def _read_geometry(self) -> None:
        parameters, model = self.context.parameters, self.robot.model
        left, right = self._left[0], self._right[0]
        self._separation_m = measure(
            self.context, "wheel_separation", lambda: joint_distance_m(model, left, right)
        )
        self._radius_m = measure(self.context, "wheel_radius", lambda: wheel_radius_m(model, left))
        both = parameters.has("wheel_radius_multiplier")
        keys = ("left_wheel_radius_multiplier", "right_wheel_radius_multiplier")
        self._multipliers = {
            key: parameters.number("wheel_radius_multiplier" if both else key) for key in keys
        }
        key = "wheel_separation_multiplier"
        self._multipliers[key] = parameters.number(key)
        self._apply_multipliers()
        report_exchanged(self.context, left, right)
        report_misfits(self.context, left, right)

    def _apply_multipliers(self) -> None:
        multipliers = self._multipliers
        self._drive = DifferentialDrive(
            self._separation_m * multipliers["wheel_separation_multiplier"],
            self._radius_m * multipliers["left_wheel_radius_multiplier"],
            self._radius_m * multipliers["right_wheel_radius_multiplier"],
        )

    def _offer(self) -> None:
        context, parameters, ports = self.context, self.context.parameters, self.context.ports
        self._odometry = PlanarOdometry(parameters.integer("velocity_rolling_window_size"))
        self._travel = WheelTravel()
        frames = read_frames(context, namespace_prefix=True)
        rate_hz = parameters.number("publish_rate")
        self._output = OdometryOutput(context, frames, rate_hz=rate_hz)
        self._limited = None
        if parameters.flag("publish_limited_velocity"):
            self._limited = ports.publisher("~/cmd_vel_out", "geometry_msgs/TwistStamped")
        self._wheel_state = None
        if parameters.flag("publish_wheel_joint_controller_state"):
            self._wheel_state = WheelStateOutput(context, self._left, self._right)
        is_ros2 = context.ros_version == 2
        self._input = TwistInput(
            ports,
            parameters.number("cmd_vel_timeout"),
            uses_stamps=is_ros2 and parameters.flag("use_stamped_vel"),
            endless=is_ros2,
        )
        self._input.listen("~/cmd_vel", stamped_first=is_ros2)
        if is_ros2:
            self._input.listen("~/cmd_vel_unstamped")
            offer_set_odometry(ports, self._odometry, lambda: self._active)
        else:
            self._offer_live(rate_hz)

    def _offer_live(self, rate_hz: float) -> None:
        def row(key: str, text: str) -> LiveParameter:
            return LiveParameter(key, "double", self._multipliers[key], text, 0.5, 1.5)

        parameters = (
            row("left_wheel_radius_multiplier", "Left wheel radius multiplier."),
            row("right_wheel_radius_multiplier", "Right wheel radius multiplier."),
            row("wheel_separation_multiplier", "Wheel separation multiplier."),
            LiveParameter("publish_rate", "double", rate_hz, "Publish rate of odom.", 0.0, 2000.0),
            LiveParameter(
                "enable_odom_tf", "bool", self._output.sends_tf, "Publish odom frame to tf"
            ),
        )
        self.context.ports.live_parameters("", parameters, self._take)

    def _take(self, values: dict[str, Any]) -> None:
        reason = self.changed(values)
        if reason:
            self.context.ports.log("error", reason)

    def _follow(self, period_s: float) -> bool:
        if self._open_loop:
            linear, angular = self._applied
            self._odometry.drive_open_loop(linear, 0.0, angular, period_s)
            return True
        values = self.robot.interface_values.states[self._state_indices].tolist()
        if any(map(math.isnan, values)):
            return False
        half = len(self._left)
        means = (math.fsum(values[:half]) / half, math.fsum(values[half:]) / half)
        if self._feedback == "position":
            left, right = self._travel.step(means)
            means = (left / period_s, right / period_s)
        linear, angular = self._drive.twist(*means)
        self._odometry.drive(linear, 0.0, angular, period_s)
        return True

    def _command(self, left_rad_s: float, right_rad_s: float) -> None:
        half = len(self._left)
        self.robot.interface_values.commands[self._command_indices[:half]] = left_rad_s
        self.robot.interface_values.commands[self._command_indices[half:]] = right_rad_s

    def _publish_limited(self, time_ns: int, linear: float, angular: float) -> None:
        message = message_type("geometry_msgs/TwistStamped")(
            header=header(time_ns, self._output.frames.base)
        )
        message.twist.linear.x, message.twist.angular.z = linear, angular
        assert self._limited is not None
        self._limited.publish(message)


def _wheel_names(context: ControllerContext) -> tuple[tuple[str, ...], tuple[str, ...]]:
    parameters = context.parameters
    for key in ("left_wheel_names", "right_wheel_names"):
        parameters.require(key)
    left = parameters.texts("left_wheel_names")
    right = parameters.texts("right_wheel_names")
    if not left or not right:
        text = f"controller '{context.name}': left_wheel and right_wheel name at least one joint"
        raise ControllerError(text + " each (Wheel names parameters are empty!)")
    if len(left) != len(right):
        text = f"controller '{context.name}': {len(left)} left wheels and {len(right)} right ones;"
        text += f" both sides need as many (#left wheels ({len(left)}) != #right wheels"
        raise ControllerError(f"{text} ({len(right)}))")
    return left, right
