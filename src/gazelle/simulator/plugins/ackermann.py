"""``libgazebo_ros_ackermann_drive``: a car with PIDs on steering and rear wheels (ROS 2)."""

from __future__ import annotations

import math

import numpy as np

from gazelle.engine import JointHandle
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import transform_stamped
from gazelle.simulator.plugins.ackermann_table import TABLE
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.drive import Velocity, needed_joints, run_drive, take_velocities
from gazelle.simulator.plugins.drive_odometry import DriveOdometry, OdometrySetup, given_covariance
from gazelle.simulator.plugins.gazebo_pid import GazeboPid
from gazelle.simulator.plugins.parameters import PluginReader
from gazelle.simulator.plugins.wheel_geometry import wheel_radius_m
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load", "steering_angles"]

_NEEDED = (
    "front_right_joint",
    "front_left_joint",
    "rear_right_joint",
    "rear_left_joint",
    "right_steering_joint",
    "left_steering_joint",
)
_STEERING_WHEEL = "steering_wheel_joint"


def load(context: PluginContext) -> None:
    """Start a car; one diagnostic and nothing else when a joint is missing."""
    parameters = context.reader(TABLE)
    names = needed_joints(context, parameters, _NEEDED)
    if names is not None:
        wheel = parameters.text(_STEERING_WHEEL)
        if wheel in [joint.name for joint in context.model.joints]:
            names[_STEERING_WHEEL] = f"{context.model.name}::{wheel}"
        _Car(context, parameters, names)
    parameters.report_unread()


def steering_angles(angle_rad: float, track_m: float, wheel_base_m: float) -> tuple[float, float]:
    """Return the angles of the left and right wheel that turn about one centre with a bicycle's.

    ``tan δ_left = L tan δ / (L − t/2 tan δ)``, and with a plus for the right one.
    """
    tangent = math.tan(angle_rad)
    share = track_m / 2 / wheel_base_m * tangent
    return math.atan2(tangent, 1.0 - share), math.atan2(tangent, 1.0 + share)


class _Car:
    """One running car."""

    def __init__(
        self, context: PluginContext, parameters: PluginReader, names: dict[str, str]
    ) -> None:
        self._context = context
        self._engine = context.host.engine
        self._joints = {key: self._engine.joint(name) for key, name in names.items()}
        self._max_speed = parameters.number("max_speed")
        self._max_steer = parameters.number("max_steer")
        self._ratio = self._max_steer / parameters.number("max_steering_angle")
        self._pids = {
            name: _pid(context, parameters, name)
            for name in ("right_steering", "left_steering", "linear_velocity")
        }
        self._measure()
        self._command = Velocity()
        self._distance_m = 0.0
        self._last_place = self._engine.model_pose(context.model.name).position_m
        self._offer(parameters)
        self._start(parameters)

    def _measure(self) -> None:
        """Take radius, track and wheelbase from the wheels, as the original does."""
        model = self._context.model
        rear = model.joint(self._joints["rear_right_joint"].joint.name)
        radius = wheel_radius_m(model, rear) if rear is not None else None
        if radius is None:
            self._context.report(
                "parameter.bad-value",
                f"plug-in '{self._context.plugin.name}' takes the wheel's radius from the rear"
                " right wheel's collision, which is no cylinder or sphere; 1 m is used",
            )
        self._radius_m = radius or 1.0
        places = {
            key: np.asarray(self._joints[key].joint.T_model_joint.position_m) for key in _NEEDED[:4]
        }
        right, left, rear_right, rear_left = (places[key] for key in _NEEDED[:4])
        self._track_m = float(np.linalg.norm(left - right))
        self._wheel_base_m = float(np.linalg.norm((left + right - rear_left - rear_right) / 2))

    def _offer(self, parameters: PluginReader) -> None:
        context, resources = self._context, self._context.resources
        take_velocities(context, context.topic(parameters, "cmd_vel"), self._take)
        covariance = given_covariance(parameters)
        topic = context.topic(parameters, "odom") if parameters.flag("publish_odom") else ""
        setup = OdometrySetup(
            topic,
            parameters.flag("publish_odom_tf"),
            parameters.text("odometry_frame"),
            parameters.text("robot_base_frame"),
            covariance,
            covariance,
        )
        self._odometry = DriveOdometry(context, setup)
        self._base_frame = setup.child_frame
        self._floats = {
            name: resources.publisher(context.topic(parameters, name), "std_msgs/Float32")
            for name in ("distance", "steerangle")
            if parameters.flag(f"publish_{name}")
        }
        self._tf = None
        if parameters.flag("publish_wheel_tf"):
            self._tf = resources.publisher("/tf", "tf2_msgs/TFMessage")

    def _start(self, parameters: PluginReader) -> None:
        step_ns = self._engine.step_ns
        period = period_in_steps(parameters.number("update_rate"), step_ns)
        self._steps = max(1.0, float(period))
        self._period_s = self._steps * step_ns * 1e-9
        run_drive(self._context, self._joints.values(), period, self._update, self._reset)

    def _take(self, command: Velocity) -> None:
        self._command = command

    def _update(self) -> None:
        self._measure_distance()
        self._odometry.publish()
        self._publish_wheels()
        self._drive()
        steer = self._steering()
        if _STEERING_WHEEL in self._joints:
            self._joints[_STEERING_WHEEL].lock_position(steer / self._ratio)
        for name, value in (("distance", self._distance_m), ("steerangle", steer)):
            publisher = self._floats.get(name)
            if publisher is not None and publisher.matched:
                publisher.publish(message_type("std_msgs/Float32")(data=value))

    def _drive(self) -> None:
        speed, _, turn = self._command
        speed = min(max(speed, -self._max_speed), self._max_speed)
        turn = math.copysign(1.0, self._command.forward) * turn
        turn = min(max(turn, -self._max_steer), self._max_steer)
        rear = self._joints["rear_right_joint"]
        push = self._pid("linear_velocity", rear.velocity - speed / self._radius_m)
        for key in ("rear_right_joint", "rear_left_joint"):
            self._push(self._joints[key], push)
        left, right = steering_angles(turn, self._track_m, self._wheel_base_m)
        for side, target in (("left", left), ("right", right)):
            joint = self._joints[f"{side}_steering_joint"]
            self._push(joint, self._pid(f"{side}_steering", joint.position - target))

    def _pid(self, name: str, error: float) -> float:
        return self._pids[name].update(error, self._period_s)

    def _push(self, joint: JointHandle, effort: float) -> None:
        """Apply what Gazebo applies for one step of a period, spread over the period."""
        limit = joint.effort_limit
        joint.set_effort(min(max(effort, -limit), limit) / self._steps)

    def _steering(self) -> float:
        sides = ("left_steering_joint", "right_steering_joint")
        return sum(self._joints[side].position for side in sides) / 2

    def _measure_distance(self) -> None:
        place = self._engine.model_pose(self._context.model.name).position_m
        self._distance_m += math.dist(place[:2], self._last_place[:2])
        self._last_place = place

    def _publish_wheels(self) -> None:
        if self._tf is None or not self._tf.matched:
            return
        back = self._engine.model_pose(self._context.model.name).inverse()
        transforms = []
        for joint in self._joints.values():
            child = joint.joint.child
            link = self._engine.link(f"{self._context.model.name}::{child}")
            pose = back @ link.T_world_link()
            transforms.append(
                transform_stamped(self._engine.time_ns, self._base_frame, child, pose)
            )
        self._tf.publish(message_type("tf2_msgs/TFMessage")(transforms=transforms))

    def _reset(self) -> None:
        self._command, self._distance_m = Velocity(), 0.0
        self._last_place = self._engine.model_pose(self._context.model.name).position_m
        for pid in self._pids.values():
            pid.reset()


def _pid(context: PluginContext, parameters: PluginReader, name: str) -> GazeboPid:
    p, i, d = parameters.vector(f"{name}_pid_gain")
    words = parameters.text(f"{name}_i_range").split()
    try:
        low, high = (float(word) for word in words)
    except ValueError:
        text = f"<{name}_i_range> is '{' '.join(words)}', not two numbers; 0 0 is used"
        context.report("parameter.bad-value", text)
        low = high = 0.0
    return GazeboPid(p, i, d, i_max=high, i_min=low)
