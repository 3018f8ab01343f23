"""``four_wheel_steering_controller/FourWheelSteeringController`` of ROS 1."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.wheels.drive_parameters import frame_rows, limit_rows
from gazelle.control.wheels.kinematics import (
    FourWheelSteering,
    FourWheelValues,
    PlanarTwist,
    virtual_angle,
)
from gazelle.control.wheels.odometry import PlanarOdometry, RollingMean
from gazelle.control.wheels.odometry_publisher import (
    OdometryOutput,
    PublishRate,
    read_frames,
)
from gazelle.control.wheels.speed_limiter import SpeedLimiter, read_limits
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import joint_distance_m, measure, wheel_radius_m
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic, TopicKind

__all__ = ["TABLE", "FourWheelSteeringController"]


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit=unit, ros_versions=(1,))


def _topic(name: str, type_name: str, kind: TopicKind = "publishes", frame: str = "") -> Topic:
    rate = "publish_rate" if kind == "publishes" else ""
    return Topic(name, type_name, kind, rate=rate, frame=frame, ros_versions=(1,))


_PARAMETERS = (
    _row("front_wheel", "texts", None, "driven front joints, left and right"),
    _row("rear_wheel", "texts", None, "driven rear joints, left and right"),
    _row("front_steering", "texts", None, "front steering joints, left and right"),
    _row("rear_steering", "texts", None, "rear steering joints, left and right"),
    _row("track", "number", None, "distance of left and right wheels; from the URDF", "m"),
    _row("wheel_base", "number", None, "distance of front and rear wheels; from the URDF", "m"),
    _row("wheel_radius", "number", None, "radius of the wheels; from the URDF", "m"),
    _row(
        "wheel_steering_y_offset",
        "refused",
        None,
        "the distance of steering joint and wheel joint in the URDF counts, as in the original",
    ),
    _row("publish_rate", "number", 50.0, "rate of odometry and tf", "Hz"),
    _row("open_loop", "refused", False, "read by the original and never used"),
    _row("cmd_vel_timeout", "number", 0.5, "how long a command holds", "s"),
    _row(
        "velocity_rolling_window_size",
        "integer",
        10,
        "number of updates that acceleration, jerk and steering rates are means of",
    ),
)

TABLE = ControllerTable(
    ParameterTable(
        "four_wheel_steering",
        "Drives a base that steers front and rear wheels and publishes odometry.",
        ("four_wheel_steering_controller/FourWheelSteeringController",),
        (
            *_PARAMETERS,
            *frame_rows(diagonals=None),
            *limit_rows("linear.x", "angular.z"),
        ),
    ),
    interfaces="claims and reads velocity of four driven and position of four steering joints",
    topics=(
        _topic("~/cmd_vel", "geometry_msgs/Twist", "listens"),
        _topic(
            "~/cmd_four_wheel_steering", "four_wheel_steering_msgs/FourWheelSteering", "listens"
        ),
        _topic("~/odom", "nav_msgs/Odometry", frame="odom_frame_id"),
        _topic("~/odom_steer", "four_wheel_steering_msgs/FourWheelSteeringStamped"),
        _topic("/tf", "tf2_msgs/TFMessage", frame="odom_frame_id"),
    ),
    behaviour=(
        "The newer of the two commands counts; a twist steers the rear wheels against the front"
        " ones by the same angles.",
        "Below 1 mm/s no wheel is driven.",
        "The wheels' offset from their steering axes is taken off on both sides alike; the"
        " original takes it off with one sign, so its odometry of such robots differs in curves.",
        "Accelerations and steering rates in odom_steer are positive while the value grows; the"
        " original's have the other sign.",
    ),
)


class _Order(NamedTuple):
    """A FourWheelSteering command: m/s and rad."""

    speed: float
    front: float
    rear: float


_STOP = _Order(0.0, 0.0, 0.0)


class FourWheelSteeringController(Controller):
    """Steers front and rear wheels, from a twist or from speed and two angles."""

    TABLE = TABLE

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer the topics."""
        super().__init__(context)
        wheels = (*_pair(context, "front_wheel"), *_pair(context, "rear_wheel"))
        steers = (*_pair(context, "front_steering"), *_pair(context, "rear_steering"))
        self.commands = tuple(
            [f"{name}/velocity" for name in wheels] + [f"{name}/position" for name in steers]
        )
        self.states = self.commands
        self._command_indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
        self._base = _base(context, wheels, steers)
        self._limiters = (
            SpeedLimiter(read_limits(context.parameters, "linear.x", 1)),
            SpeedLimiter(read_limits(context.parameters, "angular.z", 1)),
        )
        self._order = _STOP
        self._order_since_ns = -1
        self._waiting: _Order | None = None
        self._active = False
        self._offer()

    def start(self, time_ns: int) -> None:
        """Stand still and count time from now."""
        self._active = True
        self._order, self._order_since_ns, self._waiting = _STOP, -1, None
        self.robot.interface_values.commands[self._command_indices] = 0.0
        for limiter in self._limiters:
            limiter.reset()
        self._input.open(time_ns)
        self._output.start(time_ns, self._odometry)
        self._state_rate.start(time_ns)
        self._rates.clear()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheels, then command them."""
        period_s = period_ns * 1e-9
        self._follow(time_ns, period_s)
        if self._waiting is not None:
            self._order, self._order_since_ns = self._waiting, time_ns
            self._waiting = None
        twist = self._input.current(time_ns)
        if self._order_since_ns >= self._input.since_ns:
            held = time_ns - self._order_since_ns <= round(self._input.timeout_s * 1e9)
            speeds, angles = self._from_order(self._order if held else _STOP, period_s)
        else:
            speeds, angles = self._from_twist(twist or REST, period_s)
        self.robot.interface_values.commands[self._command_indices] = (*speeds, *angles)

    def stop(self, time_ns: int) -> None:
        """Brake and steer straight."""
        self._active = False
        self._input.close()
        self.robot.interface_values.commands[self._command_indices] = 0.0

    def _offer(self) -> None:
        context, parameters, ports = self.context, self.context.parameters, self.context.ports
        window = parameters.integer("velocity_rolling_window_size")
        self._odometry = PlanarOdometry()
        self._rates = _Rates(window)
        frames = read_frames(context, namespace_prefix=False)
        rate_hz = parameters.number("publish_rate")
        self._output = OdometryOutput(context, frames, rate_hz=rate_hz)
        self._state_rate = PublishRate(rate_hz)
        type_name = "four_wheel_steering_msgs/FourWheelSteeringStamped"
        self._state = ports.publisher("~/odom_steer", type_name)
        timeout_s = parameters.number("cmd_vel_timeout")
        self._input = TwistInput(ports, timeout_s, uses_stamps=False)
        self._input.listen("~/cmd_vel")
        ports.subscription(
            "~/cmd_four_wheel_steering", "four_wheel_steering_msgs/FourWheelSteering", self._take
        )

    def _take(self, message: Any) -> None:
        values = (message.speed, message.front_steering_angle, message.rear_steering_angle)
        if not self._active:
            text = "Can't accept new commands. Controller is not running."
            self.context.ports.log("warn", text)
        elif any(map(math.isnan, values)):
            text = "Received NaN in four_wheel_steering_msgs::FourWheelSteering. Ignoring command."
            self.context.ports.log("warn", text)
        else:
            quarter = math.pi / 2
            speed, front, rear = values
            self._waiting = _Order(
                float(speed),
                min(max(float(front), -quarter), quarter),
                min(max(float(rear), -quarter), quarter),
            )

    def _from_twist(
        self, twist: PlanarTwist, period_s: float
    ) -> tuple[FourWheelValues, FourWheelValues]:
        linear = self._limiters[0].limit(twist.linear_x, period_s)
        angular = self._limiters[1].limit(twist.angular_z, period_s)
        return self._base.from_twist(linear, angular)

    def _from_order(
        self, order: _Order, period_s: float
    ) -> tuple[FourWheelValues, FourWheelValues]:
        speed = self._limiters[0].limit(order.speed, period_s)
        return self._base.from_angles(speed, order.front, order.rear)

    def _follow(self, time_ns: int, period_s: float) -> None:
        values = self.robot.interface_values.states[self._state_indices].tolist()
        if any(map(math.isnan, values)):
            return
        front, rear = virtual_angle(*values[4:6]), virtual_angle(*values[6:8])
        twist = self._base.twist(FourWheelValues(*values[:4]), front, rear)
        self._odometry.drive(*twist, period_s)
        self._rates.add(twist, front, rear, period_s)
        self._output.publish(time_ns, self._odometry)
        if self._state_rate.is_due(time_ns) and self._state.matched:
            self._state.publish(self._state_message(time_ns, front, rear))

    def _state_message(self, time_ns: int, front: float, rear: float) -> Any:
        rates = self._rates
        name = "four_wheel_steering_msgs/FourWheelSteering"
        return message_type(f"{name}Stamped")(
            header=header(time_ns, ""),
            data=message_type(name)(
                front_steering_angle=front,
                rear_steering_angle=rear,
                front_steering_angle_velocity=rates.front,
                rear_steering_angle_velocity=rates.rear,
                speed=rates.speed,
                acceleration=rates.acceleration,
                jerk=rates.jerk,
            ),
        )


class _Rates:
    """Mean rates of what the base does, for the state message.

    The original takes every difference the wrong way round; here growing is positive.
    """

    def __init__(self, window: int) -> None:
        self._means = tuple(RollingMean(window) for _ in range(4))
        self.clear()

    def clear(self) -> None:
        """Begin anew."""
        for mean in self._means:
            mean.clear()
        self.speed = self.acceleration = self.jerk = self.front = self.rear = 0.0
        self._last_angles = (0.0, 0.0)

    def add(self, twist: PlanarTwist, front: float, rear: float, period_s: float) -> None:
        """Take the values of an update."""
        speed = math.copysign(math.hypot(twist.linear_x, twist.linear_y), twist.linear_x)
        acceleration = self._means[0].add((speed - self.speed) / period_s)
        self.jerk = self._means[1].add((acceleration - self.acceleration) / period_s)
        self.front = self._means[2].add((front - self._last_angles[0]) / period_s)
        self.rear = self._means[3].add((rear - self._last_angles[1]) / period_s)
        self.speed, self.acceleration, self._last_angles = speed, acceleration, (front, rear)


def _pair(context: ControllerContext, key: str) -> tuple[str, ...]:
    context.parameters.require(key)
    names = context.parameters.texts(key)
    if len(names) != 2:
        text = f"controller '{context.name}': {key} needs two joints, left and right, and has "
        raise ControllerError(
            f"{text}{len(names)} (#two wheels by axle (left and right) is needed)"
        )
    return names


def _base(
    context: ControllerContext, wheels: tuple[str, ...], steers: tuple[str, ...]
) -> FourWheelSteering:
    model = context.robot.model
    front_left, front_right, rear_left, _ = wheels
    track_m = measure(context, "track", lambda: joint_distance_m(model, front_left, front_right))
    base_m = measure(context, "wheel_base", lambda: joint_distance_m(model, front_left, rear_left))
    radius_m = measure(context, "wheel_radius", lambda: wheel_radius_m(model, front_left))
    offset_m = joint_distance_m(model, steers[0], front_left)
    return FourWheelSteering(track_m - 2 * offset_m, offset_m, radius_m, base_m)
