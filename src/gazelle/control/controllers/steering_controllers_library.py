"""What ackermann, bicycle and tricycle_steering_controller of ROS 2 have in common."""

from __future__ import annotations

import math
from enum import Enum
from typing import Any

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.wheels.drive_parameters import command_rows, frame_rows
from gazelle.control.wheels.kinematics import AxlePair, SteeringGeometry, reduced_until_steered
from gazelle.control.wheels.odometry import PlanarOdometry, WheelTravel, offer_set_odometry
from gazelle.control.wheels.odometry_publisher import (
    OdometryOutput,
    read_covariance,
    read_frames,
)
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import positive
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, Topic

__all__ = [
    "LIBRARY_BEHAVIOUR",
    "LIBRARY_DIAGONAL",
    "SteeringDrive",
    "SteeringKind",
    "library_rows",
    "library_topics",
]


LIBRARY_DIAGONAL = (0.0, 7.0, 14.0, 21.0, 28.0, 35.0)

"""The original's default, which looks like places in the matrix rather than variances."""

LIBRARY_BEHAVIOUR = (
    "A reference older than reference_timeout stops the driven wheels and leaves the steering;"
    " with a timeout of 0 a reference acts for one update (steering_controllers_library).",
    "The speeds of two driven wheels fit the steering angle that is measured, or the commanded one"
    " with open_loop.",
)


def library_rows(radius_key: str) -> tuple[Parameter, ...]:
    """Return the rows of the library; `radius_key` is ``traction_wheels_radius`` or singular."""
    return (
        *_joint_rows(),
        *_radius_rows(radius_key),
        *_behaviour_rows(),
        *command_rows(),
        *frame_rows(diagonals=None),
    )


def library_topics() -> tuple[Topic, ...]:
    """Return what the library listens to and publishes."""
    stamped, plain = "geometry_msgs/TwistStamped", "geometry_msgs/Twist"
    frame, rate = "odom_frame_id", "every update"
    return (
        Topic("~/reference", stamped, "listens", ros_versions=(2,)),
        Topic("~/reference_unstamped", plain, "listens", ros_versions=(2,)),
        Topic("~/odometry", "nav_msgs/Odometry", rate=rate, frame=frame, ros_versions=(2,)),
        Topic("~/tf_odometry", "tf2_msgs/TFMessage", rate=rate, frame=frame, ros_versions=(2,)),
        Topic(
            "~/controller_state",
            "control_msgs/SteeringControllerStatus",
            rate=rate,
            ros_versions=(2,),
        ),
        Topic("~/set_odometry", "control_msgs/SetOdometry", "service", ros_versions=(2,)),
    )


def _row(key: str, kind: str, default: object, meaning: str, **more: object) -> Parameter:
    return Parameter(key, kind, default, meaning, ros_versions=(2,), **more)  # type: ignore[arg-type]


def _joint_rows() -> tuple[Parameter, ...]:
    old = "up to Humble: driven with front_steering: {}, else steered"
    return (
        _row("traction_joints_names", "texts", None, "driven joints, right first"),
        _row("steering_joints_names", "texts", None, "steered joints, right first"),
        _row("traction_joints_state_names", "texts", (), "joints read instead of the driven ones"),
        _row("steering_joints_state_names", "texts", (), "joints read instead of the steered ones"),
        _row("front_steering", "flag", True, "what the names with front and rear mean"),
        _row("rear_wheels_names", "texts", None, old.format("true")),
        _row("front_wheels_names", "texts", None, old.format("false")),
        _row("rear_wheels_state_names", "texts", (), "joints read instead of the rear ones"),
        _row("front_wheels_state_names", "texts", (), "joints read instead of the front ones"),
    )


def _radius_rows(radius_key: str) -> tuple[Parameter, ...]:
    word = radius_key.removeprefix("traction_")
    return (
        _row("wheelbase", "number", None, "distance of the axles", unit="m"),
        _row(radius_key, "number", None, "radius of the driven wheels", unit="m"),
        _row(f"rear_{word}", "number", None, "up to Humble, with front_steering: true", unit="m"),
        _row(f"front_{word}", "number", None, "up to Humble, with front_steering: false", unit="m"),
    )


def _behaviour_rows() -> tuple[Parameter, ...]:
    return (
        _row("reference_timeout", "number", 1.0, "how long a reference holds", unit="s", live=True),
        _row(
            "reduce_wheel_speed_until_steering_reached",
            "flag",
            False,
            "drive slower while the steering is more than 30° from its target",
            live=True,
        ),
        _row("position_feedback", "flag", False, "odometry from positions of the driven joints"),
        _row(
            "use_stamped_vel",
            "flag",
            True,
            "whether the stamp of a TwistStamped tells its age; both types are taken anyway",
        ),
        _row("tf_frame_prefix", "text", "", "prefix of the frames, ~ stands for the namespace"),
    )


class SteeringKind(Enum):
    """Kinds of bases: name, driven joints, steered joints."""

    BICYCLE = ("bicycle", 1, 1)
    TRICYCLE = ("tricycle", 2, 1)
    ACKERMANN = ("ackermann", 2, 2)


class SteeringDrive:
    """Drives one or two joints and steers one or two (steering_controllers_library)."""

    def __init__(self, context: ControllerContext, kind: SteeringKind) -> None:
        self._context = context
        self._interface_values = context.robot.interface_values
        parameters = context.parameters
        _, self._driven, self._steered = kind.value
        names = _JointNames(context, kind)
        self._open_loop = parameters.flag("open_loop")
        self._reduces = parameters.flag("reduce_wheel_speed_until_steering_reached")
        self._feedback = "position" if parameters.flag("position_feedback") else "velocity"
        self.commands = (
            *(f"{name}/velocity" for name in names.traction),
            *(f"{name}/position" for name in names.steering),
        )
        self.states = (
            *(f"{name}/{self._feedback}" for name in names.traction_states),
            *(f"{name}/position" for name in names.steering_states),
        )
        self._command_indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
        self._geometry = _geometry(context, kind)
        self._measured_angle = 0.0
        self._active = False
        self._offer()

    def start(self, time_ns: int) -> None:
        """Wait for a reference."""
        self._active = True
        self._input.open(time_ns)
        self._output.start(time_ns, self._odometry)
        self._travel.clear()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheels, then command them."""
        twist = self._input.current(time_ns)
        linear, _, angular = twist or REST
        self._follow(linear, angular, period_ns * 1e-9)
        commands = self._interface_values.commands
        if twist is None:
            commands[self._command_indices[: self._driven]] = 0.0
        else:
            commands[self._command_indices] = self._values(linear, angular)
        self._output.publish(time_ns, self._odometry)
        if self._state.matched:
            self._publish_state(time_ns)

    def stop(self, time_ns: int) -> None:
        """Let go of the joints: the driven ones stand, the steered ones stay where they are."""
        self._active = False
        self._input.close()
        self._interface_values.commands[self._command_indices[: self._driven]] = 0.0

    def changed(self, values: dict[str, Any]) -> str:
        """Take over live parameters."""
        if "reference_timeout" in values:
            self._input.timeout_s = float(values["reference_timeout"])
        if "reduce_wheel_speed_until_steering_reached" in values:
            self._reduces = bool(values["reduce_wheel_speed_until_steering_reached"])
        self._output.changed(values)
        return ""

    def _offer(self) -> None:
        context, parameters, ports = self._context, self._context.parameters, self._context.ports
        self._odometry = PlanarOdometry(parameters.integer("velocity_rolling_window_size"))
        self._travel = WheelTravel()
        frames = read_frames(context, namespace_prefix=False)
        keys = ("pose_covariance_diagonal", "twist_covariance_diagonal")
        pose, twist = (read_covariance(parameters, key, LIBRARY_DIAGONAL) for key in keys)
        self._output = OdometryOutput(
            context,
            frames,
            odom_topic="~/odometry",
            tf_topic="~/tf_odometry",
            covariances=(pose, twist),
        )
        type_name = "control_msgs/SteeringControllerStatus"
        self._state = ports.publisher("~/controller_state", type_name)
        timeout_s = parameters.number("reference_timeout")
        uses_stamps = parameters.flag("use_stamped_vel")
        self._input = TwistInput(ports, timeout_s, uses_stamps=uses_stamps)
        self._input.listen("~/reference", stamped_first=True)
        self._input.listen("~/reference_unstamped")
        offer_set_odometry(ports, self._odometry, lambda: self._active)

    def _follow(self, linear: float, angular: float, period_s: float) -> None:
        values = self._interface_values.states[self._state_indices].tolist()
        known = all(map(math.isfinite, values))
        speeds, angles = tuple(values[: self._driven]), values[self._driven :]
        if known:
            pair = len(angles) == 2
            angle = self._geometry.virtual_angle(AxlePair(*angles)) if pair else angles[0]
            self._measured_angle = angle
        if self._open_loop:
            self._odometry.drive_open_loop(linear, 0.0, angular, period_s)
        elif known:
            if self._feedback == "position":
                speeds = tuple(turned / period_s for turned in self._travel.step(speeds))
            linear = self._linear(speeds)
            angular = self._geometry.yaw_rate(linear, self._measured_angle)
            self._odometry.drive(linear, 0.0, angular, period_s)

    def _linear(self, speeds: tuple[float, ...]) -> float:
        if len(speeds) == 1:
            return speeds[0] * self._geometry.wheel_radius_m
        return self._geometry.axle_linear(AxlePair(*speeds), self._measured_angle)

    def _values(self, linear: float, angular: float) -> list[float]:
        geometry = self._geometry
        target = geometry.steering_angle(linear, angular)
        angle = target if self._open_loop else self._measured_angle
        if self._reduces and not self._open_loop:
            linear = reduced_until_steered(linear, angle - target)
        driven = [linear / geometry.wheel_radius_m]
        if self._driven == 2:
            driven = list(geometry.axle_speeds(linear, angle))
        steered = [target] if self._steered == 1 else list(geometry.wheel_angles(target))
        return driven + steered

    def _publish_state(self, time_ns: int) -> None:
        states = self._interface_values.states[self._state_indices]
        commands = self._interface_values.commands[self._command_indices]
        message = message_type("control_msgs/SteeringControllerStatus")(
            header=header(time_ns, self._output.frames.odom),
            steer_positions=states[self._driven :],
            linear_velocity_command=commands[: self._driven],
            steering_angle_command=commands[self._driven :],
        )
        setattr(message, f"traction_wheels_{self._feedback}", states[: self._driven])
        self._state.publish(message)


class _JointNames:
    """Names of the joints, from the new parameters or those up to Humble."""

    def __init__(self, context: ControllerContext, kind: SteeringKind) -> None:
        self._context = context
        self._label, driven, steered = kind.value
        front = context.parameters.flag("front_steering")
        old = ("rear_wheels", "front_wheels") if front else ("front_wheels", "rear_wheels")
        self.traction = self._read("traction_joints", old[0], driven)
        self.steering = self._read("steering_joints", old[1], steered)
        self.traction_states = self._states("traction_joints", old[0], self.traction)
        self.steering_states = self._states("steering_joints", old[1], self.steering)

    def _read(self, new: str, old: str, count: int) -> tuple[str, ...]:
        key = _first(self._context, f"{new}_names", f"{old}_names")
        self._context.parameters.require(key)
        names = self._context.parameters.texts(key)
        if len(names) != count:
            self._complain(key, names, count)
        return names

    def _states(self, new: str, old: str, names: tuple[str, ...]) -> tuple[str, ...]:
        parameters = self._context.parameters
        key = f"{new}_state_names"
        found = parameters.texts(key) or parameters.texts(f"{old}_state_names")
        if found and len(found) != len(names):
            self._complain(key, found, len(names))
        return found or names

    def _complain(self, key: str, names: tuple[str, ...], count: int) -> None:
        text = f"controller '{self._context.name}': {key} has {len(names)} joints, a "
        text += f"{self._label} base needs {count} ({self._label.capitalize()} configuration "
        raise ControllerError(f"{text}requires exactly {count}, but {len(names)} were provided)")


def _geometry(context: ControllerContext, kind: SteeringKind) -> SteeringGeometry:
    parameters = context.parameters
    old = "rear" if parameters.flag("front_steering") else "front"
    word = "wheel_radius" if kind is SteeringKind.BICYCLE else "wheels_radius"
    wheelbase_m = positive(context, "wheelbase")
    radius_m = positive(context, _first(context, f"traction_{word}", f"{old}_{word}"))
    if kind is SteeringKind.BICYCLE:
        return SteeringGeometry(wheelbase_m, radius_m)
    if kind is SteeringKind.TRICYCLE:
        track_m = positive(context, "traction_track_width")
        return SteeringGeometry(wheelbase_m, radius_m, track_m)
    track_m = positive(context, _first(context, "traction_track_width", f"{old}_wheel_track"))
    steered_m = parameters.number("steering_track_width", 0.0)
    return SteeringGeometry(wheelbase_m, radius_m, track_m, steered_m if steered_m > 0 else track_m)


def _first(context: ControllerContext, new: str, old: str) -> str:
    parameters = context.parameters
    return old if parameters.has(old) and not parameters.has(new) else new
