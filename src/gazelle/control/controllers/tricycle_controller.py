"""``tricycle_controller/TricycleController`` of ROS 2: one wheel that drives and steers."""

from __future__ import annotations

import math
from typing import Any

from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.tricycle_table import TABLE as _TABLE
from gazelle.control.controllers.tricycle_table import read_steering_limits, read_traction_limits
from gazelle.control.wheels.mecanum import PlanarTwist
from gazelle.control.wheels.odometry import PlanarOdometry, offer_reset_odometry
from gazelle.control.wheels.odometry_publisher import OdometryOutput, read_frames
from gazelle.control.wheels.speed_limiter import TractionLimiter
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import positive
from gazelle.interfaces import message_type

__all__ = ["TricycleController"]


class TricycleController(Controller):
    """Turns the front wheel into the direction of the command and drives it."""

    TABLE = _TABLE

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer the topics."""
        super().__init__(context)
        parameters = context.parameters
        for key in ("traction_joint_name", "steering_joint_name"):
            parameters.require(key)
        traction = parameters.text("traction_joint_name")
        steering = parameters.text("steering_joint_name")
        self.commands = (f"{traction}/velocity", f"{steering}/position")
        self.states = self.commands
        self._command_places = context.command_places(self.commands)
        self._state_places = context.state_places(self.states)
        self._wheelbase_m = positive(context, "wheelbase")
        self._radius_m = positive(context, "wheel_radius")
        self._open_loop = parameters.flag("open_loop")
        self._traction = TractionLimiter(read_traction_limits(parameters))
        self._steering = TractionLimiter(read_steering_limits(parameters))
        self._offer()

    def start(self, time_ns: int) -> None:
        """Wait for a command."""
        self._traction.reset()
        self._steering.reset()
        self._input.open(time_ns)
        self._output.start(time_ns, self._odometry)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheel, then command it."""
        period_s = period_ns * 1e-9
        twist = self._input.current(time_ns) or REST
        wheel_rad_s, angle = self.robot.bank.states[self._state_places].tolist()
        if self._open_loop:
            self._odometry.drive_open_loop(twist.linear_x, 0.0, twist.angular_z, period_s)
        elif math.isfinite(wheel_rad_s) and math.isfinite(angle):
            rim = wheel_rad_s * self._radius_m
            turn = rim * math.sin(angle) / self._wheelbase_m
            self._odometry.drive(rim * math.cos(angle), 0.0, turn, period_s)
        self._output.publish(time_ns, self._odometry)
        target, speed = self._wheel(twist)
        speed = self._traction.limit(speed * _eagerness(abs(target - angle)), period_s)
        target = self._steering.limit(target, period_s)
        self.robot.bank.commands[self._command_places] = (speed, target)
        if self._ackermann is not None and self._ackermann.matched:
            # The original puts the wheel's rad/s where the message has m/s.
            message = message_type("ackermann_msgs/AckermannDrive")
            self._ackermann.publish(message(speed=speed, steering_angle=target))

    def stop(self, time_ns: int) -> None:
        """Brake and steer straight."""
        self._input.close()
        self.robot.bank.commands[self._command_places] = 0.0

    def changed(self, values: dict[str, Any]) -> str:
        """Take over whether to send tf."""
        self._output.changed(values)
        return ""

    def _offer(self) -> None:
        context, parameters, ports = self.context, self.context.parameters, self.context.ports
        self._odometry = PlanarOdometry(parameters.integer("velocity_rolling_window_size"))
        self._output = OdometryOutput(context, read_frames(context, namespace_prefix=False))
        self._output.sends_pose = not parameters.flag("odom_only_twist")
        self._ackermann = None
        if parameters.flag("publish_ackermann_command"):
            self._ackermann = ports.publisher("~/cmd_ackermann", "ackermann_msgs/AckermannDrive")
        timeout_s = parameters.integer("cmd_vel_timeout") * 1e-3
        uses_stamps = parameters.flag("use_stamped_vel")
        self._input = TwistInput(ports, timeout_s, uses_stamps=uses_stamps)
        # Of one name in both cases, unlike the topics of the other wheeled bases.
        self._input.listen("~/cmd_vel", stamped_first=uses_stamps)
        offer_reset_odometry(ports, self._odometry)

    def _wheel(self, twist: PlanarTwist) -> tuple[float, float]:
        """Return angle and speed (rad/s) of the wheel for a twist."""
        linear, angular = twist.linear_x, twist.angular_z
        if linear == 0 and angular != 0:
            spin = abs(angular) * self._wheelbase_m / self._radius_m
            return math.copysign(math.pi / 2, angular), spin
        angle = math.atan(angular * self._wheelbase_m / linear) if linear else 0.0
        return angle, linear / (self._radius_m * math.cos(angle))


def _eagerness(error_rad: float) -> float:
    """Return how much of its speed the wheel gets while its steering is on the way."""
    if not error_rad >= math.pi / 6:
        return 1.0
    return 0.01 if error_rad > math.pi / 2 else math.cos(error_rad)
