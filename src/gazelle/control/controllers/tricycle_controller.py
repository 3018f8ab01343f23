"""``tricycle_controller/TricycleController`` of ROS 2: one wheel that drives and steers."""

from __future__ import annotations

import math
from typing import Any

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.wheels.drive_parameters import command_rows, frame_rows
from gazelle.control.wheels.kinematics import PlanarTwist
from gazelle.control.wheels.odometry import PlanarOdometry, offer_reset_odometry
from gazelle.control.wheels.odometry_publisher import OdometryOutput, read_frames
from gazelle.control.wheels.speed_limiter import TractionLimiter, TractionLimits
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import positive
from gazelle.interfaces import message_type
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic
from gazelle.parameters.reader import ParameterReader

__all__ = ["TABLE", "TricycleController", "read_steering_limits", "read_traction_limits"]


# The original's bound where only the lower one is given.
_MAX = 1000.0


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit=unit, ros_versions=(2,))


def _bounds(group: str, units: dict[str, str]) -> tuple[Parameter, ...]:
    meaning = "limit of the magnitude, in both directions; none when absent or NaN"
    return tuple(
        _row(f"{group}.{side}_{word}", "number", None, meaning, unit)
        for word, unit in units.items()
        for side in ("max", "min")
    )


_PARAMETERS = (
    _row("traction_joint_name", "text", None, "joint that drives"),
    _row("steering_joint_name", "text", None, "joint that steers"),
    _row("wheelbase", "number", None, "distance of the wheel from the rear axle", "m"),
    _row("wheel_radius", "number", None, "radius of the wheel", "m"),
    _row("odom_only_twist", "flag", False, "leave the pose in odometry at its default"),
    _row("cmd_vel_timeout", "integer", 500, "how long a command holds", "ms"),
    _row("publish_ackermann_command", "flag", False, "publish the wheel's command"),
    _row(
        "use_stamped_vel",
        "flag",
        True,
        "whether ~/cmd_vel is announced as TwistStamped, not Twist, and a stamp tells the age;"
        " both types are taken anyway",
    ),
    _row("tf_frame_prefix", "text", "", "prefix of the frames, ~ stands for the namespace"),
)

_TRACTION_UNITS = {
    "velocity": "rad/s",
    "acceleration": "rad/s²",
    "deceleration": "rad/s²",
    "jerk": "rad/s³",
}

_STEERING_UNITS = {"position": "rad", "velocity": "rad/s", "acceleration": "rad/s²"}

TABLE = ControllerTable(
    ParameterTable(
        "tricycle",
        "Drives a base with one wheel that is driven and steered, and publishes odometry.",
        ("tricycle_controller/TricycleController",),
        (
            *_PARAMETERS,
            *command_rows(),
            *frame_rows(diagonals=(0.0,) * 6, enable_tf=False),
            *_bounds("traction", _TRACTION_UNITS),
            *_bounds("steering", _STEERING_UNITS),
        ),
    ),
    interfaces="claims and reads velocity of the driven and position of the steered joint",
    topics=(
        Topic("~/cmd_vel", "geometry_msgs/TwistStamped", "listens", ros_versions=(2,)),
        Topic("~/odom", "nav_msgs/Odometry", rate="every update", frame="odom_frame_id"),
        Topic("/tf", "tf2_msgs/TFMessage", rate="every update", frame="odom_frame_id"),
        Topic("~/cmd_ackermann", "ackermann_msgs/AckermannDrive", rate="every update"),
        Topic("~/reset_odometry", "std_srvs/Empty", "service"),
    ),
    behaviour=(
        "A command without linear.x steers to ±90° and turns about the middle of the rear axle.",
        "While the steering is more than 30° from its target the wheel gets the cosine of the"
        " error of its speed, and a hundredth beyond 90° (TricycleController::update).",
        "Jerk and steering acceleration may reach twice their limits, as the original's"
        " 2·limit·dt² allows.",
    ),
)


def read_traction_limits(parameters: ParameterReader) -> TractionLimits:
    """Read the limits of the driven joint.

    Raises:
        ControllerError: a limit is negative or a lower one above its upper one.
    """
    keys = ("velocity", "acceleration", "deceleration", "jerk")
    velocity, increase, decrease, bend = (_read(parameters, f"traction.{w}") for w in keys)
    # The original does not limit braking unless acceleration is limited.
    if increase is None:
        return TractionLimits(velocity, None, None, bend)
    return TractionLimits(velocity, increase, decrease, bend)


def read_steering_limits(parameters: ParameterReader) -> TractionLimits:
    """Read the limits of the steered joint.

    Raises:
        ControllerError: a limit is negative or a lower one above its upper one.
    """
    lowest, highest = _ends(parameters, "steering.position")
    between = None
    if not (math.isnan(lowest) and math.isnan(highest)):
        lowest = -highest if math.isnan(lowest) else lowest
        between = (lowest, -lowest if math.isnan(highest) else highest)
    rate, bend = (_read(parameters, f"steering.{word}") for word in ("velocity", "acceleration"))
    return TractionLimits(increase=rate, decrease=rate, bend=bend, between=between)


def _ends(parameters: ParameterReader, name: str) -> tuple[float, float]:
    group, _, word = name.partition(".")
    return (
        parameters.number(f"{group}.min_{word}", math.nan),
        parameters.number(f"{group}.max_{word}", math.nan),
    )


def _read(parameters: ParameterReader, name: str) -> tuple[float, float] | None:
    lowest, highest = _ends(parameters, name)
    if math.isnan(lowest) and math.isnan(highest):
        return None
    lowest = 0.0 if math.isnan(lowest) else lowest
    highest = _MAX if math.isnan(highest) else highest
    if lowest < 0 or highest < 0 or lowest > highest:
        text = f"controller '{parameters.name}': limits of {name} are {lowest:g} and {highest:g};"
        text += " they bound a magnitude in both directions, so 0 ≤ min ≤ max"
        raise ControllerError(
            text + " (Setting different limits for positive and negative"
            " directions is not supported)"
        )
    return lowest, highest


class TricycleController(Controller):
    """Turns the front wheel into the direction of the command and drives it."""

    TABLE = TABLE

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
        self._command_indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
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
        wheel_rad_s, angle = self.robot.interface_values.states[self._state_indices].tolist()
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
        self.robot.interface_values.commands[self._command_indices] = (speed, target)
        if self._ackermann is not None and self._ackermann.matched:
            # The original puts the wheel's rad/s where the message has m/s.
            message = message_type("ackermann_msgs/AckermannDrive")
            self._ackermann.publish(message(speed=speed, steering_angle=target))

    def stop(self, time_ns: int) -> None:
        """Brake and steer straight."""
        self._input.close()
        self.robot.interface_values.commands[self._command_indices] = 0.0

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
