"""``diff_drive_controller/DiffDriveController`` of ROS 1 and ROS 2."""

from __future__ import annotations

import math
from typing import Any

from gazelle.control.controller_node import LiveParameter
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.diff_drive_table import TABLE as _TABLE
from gazelle.control.controllers.diff_drive_wheel_state import WheelStateOutput
from gazelle.control.errors import ControllerError
from gazelle.control.wheels.differential import DifferentialDrive
from gazelle.control.wheels.odometry import PlanarOdometry, WheelTravel, offer_set_odometry
from gazelle.control.wheels.odometry_publisher import OdometryOutput, read_frames
from gazelle.control.wheels.speed_limiter import SpeedLimiter, read_limits
from gazelle.control.wheels.urdf_geometry import joint_distance_m, wheel_radius_m
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import measure, report_exchanged, report_misfits
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header

__all__ = ["DiffDriveController"]


class DiffDriveController(Controller):
    """Drives the wheels of both sides from velocity commands."""

    TABLE = _TABLE

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
        self._command_places = context.command_places(self.commands)
        self._state_places = context.state_places(self.states)
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
        values = self.robot.bank.states[self._state_places].tolist()
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
        self.robot.bank.commands[self._command_places[:half]] = left_rad_s
        self.robot.bank.commands[self._command_places[half:]] = right_rad_s

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
