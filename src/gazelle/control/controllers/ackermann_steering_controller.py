"""``ackermann_steering_controller/AckermannSteeringController`` of ROS 1 and ROS 2.

The name is the same, the controllers are not: ROS 1's drives a bicycle (one rear wheel, one front
steering joint), ROS 2's the four joints of a car.
"""

from __future__ import annotations

import math
from typing import Any

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.drive_controller_base import Drive, DriveController
from gazelle.control.controllers.steering_controllers_library import (
    LIBRARY_BEHAVIOUR,
    SteeringDrive,
    SteeringKind,
    library_rows,
    library_topics,
)
from gazelle.control.wheels.drive_parameters import limit_rows
from gazelle.control.wheels.kinematics import SteeringGeometry
from gazelle.control.wheels.odometry import PlanarOdometry, WheelTravel
from gazelle.control.wheels.odometry_publisher import OdometryOutput, read_frames
from gazelle.control.wheels.speed_limiter import SpeedLimiter, read_limits
from gazelle.control.wheels.velocity_command import REST, TwistInput
from gazelle.control.wheels.wheel_geometry import joint_offset_m, measure, wheel_radius_m
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["ROS1_ROWS", "AckermannSteeringController", "Ros1AckermannDrive"]


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit=unit, ros_versions=(1,))


ROS1_ROWS = (
    _row("rear_wheel", "text", "rear_wheel_joint", "driven joint"),
    _row("front_steer", "text", "front_steer_joint", "steering joint"),
    _row("wheel_separation_h", "number", None, "wheelbase; from the URDF when absent", "m"),
    _row("wheel_radius", "number", None, "rear wheel; from the URDF when absent", "m"),
    _row("wheel_separation_h_multiplier", "number", 1.0, "corrects the wheelbase in odometry"),
    _row("wheel_radius_multiplier", "number", 1.0, "corrects the radius in odometry"),
    _row("steer_pos_multiplier", "number", 1.0, "corrects the steering angle in odometry"),
    _row("cmd_vel_timeout", "number", 0.5, "how long a command holds", "s"),
    _row("publish_rate", "number", 50.0, "rate of odometry and tf", "Hz"),
    Parameter(
        "allow_multiple_cmd_vel_publishers",
        "refused",
        True,
        "senders are not counted; all of them are heard",
        ros_versions=(1,),
    ),
)


class Ros1AckermannDrive:
    """Passes a command's linear.x to the wheel and its angular.z, as an angle, to the steering."""

    def __init__(self, context: ControllerContext) -> None:
        parameters, ports = context.parameters, context.ports
        self._interface_values = context.robot.interface_values
        wheel, steer = parameters.text("rear_wheel"), parameters.text("front_steer")
        self.commands: tuple[str, ...] = (f"{wheel}/velocity", f"{steer}/position")
        self.states: tuple[str, ...] = (f"{wheel}/position", f"{steer}/position")
        self._command_indices = context.command_indices(self.commands)
        self._state_indices = context.state_indices(self.states)
        self._read_geometry(context, wheel, steer)
        self._open_loop = parameters.flag("open_loop")
        self._limiters = (
            SpeedLimiter(read_limits(parameters, "linear.x", 1)),
            SpeedLimiter(read_limits(parameters, "angular.z", 1)),
        )
        self._applied = (0.0, 0.0)
        self._odometry = PlanarOdometry(parameters.integer("velocity_rolling_window_size"))
        self._travel = WheelTravel()
        frames = read_frames(context, namespace_prefix=False)
        rate_hz = parameters.number("publish_rate")
        self._output = OdometryOutput(context, frames, rate_hz=rate_hz)
        self._input = TwistInput(ports, parameters.number("cmd_vel_timeout"), uses_stamps=False)
        self._input.listen("~/cmd_vel")

    def start(self, time_ns: int) -> None:
        """Stand still and count time from now."""
        self._brake()
        for limiter in self._limiters:
            limiter.reset()
        self._input.open(time_ns)
        self._output.start(time_ns, self._odometry)
        self._travel.clear()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Follow the wheel, then command it."""
        period_s = period_ns * 1e-9
        if not self._follow(period_s):
            return
        self._output.publish(time_ns, self._odometry)
        twist = self._input.current(time_ns) or REST
        linear = self._limiters[0].limit(twist.linear_x, period_s)
        angle = self._limiters[1].limit(twist.angular_z, period_s)
        self._applied = (linear, angle)
        self._interface_values.commands[self._command_indices] = (linear / self._radius_m, angle)

    def stop(self, time_ns: int) -> None:
        """Brake and steer straight."""
        self._input.close()
        self._brake()

    def changed(self, values: dict[str, Any]) -> str:
        """Take over whether to send tf."""
        self._output.changed(values)
        return ""

    def _brake(self) -> None:
        self._applied = (0.0, 0.0)
        self._interface_values.commands[self._command_indices] = 0.0

    def _read_geometry(self, context: ControllerContext, wheel: str, steer: str) -> None:
        parameters, model = context.parameters, context.robot.model
        base_m = measure(
            context, "wheel_separation_h", lambda: abs(joint_offset_m(model, wheel, steer, 0))
        )
        self._radius_m = measure(context, "wheel_radius", lambda: wheel_radius_m(model, wheel))
        self._geometry = SteeringGeometry(
            base_m * parameters.number("wheel_separation_h_multiplier"),
            self._radius_m * parameters.number("wheel_radius_multiplier"),
        )
        self._angle_factor = parameters.number("steer_pos_multiplier")

    def _follow(self, period_s: float) -> bool:
        if self._open_loop:
            self._odometry.drive_open_loop(self._applied[0], 0.0, self._applied[1], period_s)
            return True
        position, angle = self._interface_values.states[self._state_indices].tolist()
        if math.isnan(position) or math.isnan(angle):
            return False
        (turned,) = self._travel.step((position,))
        linear = turned * self._geometry.wheel_radius_m / period_s
        angular = self._geometry.yaw_rate(linear, angle * self._angle_factor)
        self._odometry.drive(linear, 0.0, angular, period_s)
        return True


def _track(key: str, meaning: str) -> Parameter:
    return Parameter(key, "number", None, meaning, unit="m", ros_versions=(2,))


_TRACKS = (
    _track("traction_track_width", "distance of the driven wheels"),
    _track("steering_track_width", "distance of the steered wheels; of the driven when absent"),
    _track("rear_wheel_track", "up to Humble, with front_steering: true; both axles get it"),
    _track("front_wheel_track", "up to Humble, with front_steering: false; both axles get it"),
)

_ROS1_TOPICS = (
    Topic("~/cmd_vel", "geometry_msgs/Twist", "listens", ros_versions=(1,)),
    Topic(
        "~/odom", "nav_msgs/Odometry", rate="publish_rate", frame="odom_frame_id", ros_versions=(1,)
    ),
    Topic(
        "/tf", "tf2_msgs/TFMessage", rate="publish_rate", frame="odom_frame_id", ros_versions=(1,)
    ),
)


class AckermannSteeringController(DriveController):
    """ROS 2: two driven and two steered wheels; ROS 1: one of each."""

    TABLE = ControllerTable(
        ParameterTable(
            "ackermann_steering",
            "Drives a base with car-like steering and publishes odometry. ROS 2's takes two"
            " driven and two steered joints, ROS 1's one of each.",
            ("ackermann_steering_controller/AckermannSteeringController",),
            (
                *ROS1_ROWS,
                *library_rows("traction_wheels_radius"),
                *_TRACKS,
                *limit_rows("linear.x", "angular.z"),
            ),
        ),
        interfaces="claims velocity of the driven and position of the steered joints; reads"
        " velocity (ROS 1: position) and position",
        topics=(*_ROS1_TOPICS, *library_topics()),
        behaviour=(
            "ROS 1: angular.z of the command is the steering angle in rad, not a yaw rate, and"
            " angular.z limits bound that angle (AckermannSteeringController::update).",
            "ROS 2: joints are given right first, then left; the outer wheel runs faster and is"
            " steered less, so that all axes meet in one point. ROS 2's has no limits.",
            *LIBRARY_BEHAVIOUR,
        ),
    )

    def _make(self, context: ControllerContext) -> Drive:
        if context.ros_version == 1:
            return Ros1AckermannDrive(context)
        return SteeringDrive(context, SteeringKind.ACKERMANN)
