"""``libgazebo_ros_ackermann_drive``: a car with PIDs on steering and rear wheels (ROS 2)."""

from __future__ import annotations

import math

import numpy as np

from gazelle.engine import JointHandle
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import transform_stamped
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.diff_drive_geometry import wheel_radius_m
from gazelle.simulator.plugins.drive import (
    GZ_COMMANDS,
    GZ_NO_JERK,
    GZ_ODOMETRY,
    GZ_RATE,
    GZ_SEPARATION,
    GZ_SIDES,
    GZ_TOPICS,
    GZ_WHEEL_RADIUS,
    Velocity,
    covariances,
    needed_joints,
    run_drive,
    take_velocities,
)
from gazelle.simulator.plugins.drive_odometry import DriveOdometry, OdometrySetup, given_covariance
from gazelle.simulator.plugins.gazebo_pid import GazeboPid
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["GZ_TABLE", "TABLE", "load", "steering_angles"]


_NO_GAIN = (0.0, 0.0, 0.0)

TABLE = PluginTable(
    ParameterTable(
        "ackermann_drive",
        "Steers the front wheels and drives the rear wheels of a car with PIDs (ROS 2).",
        ("gazebo_ros_ackermann_drive",),
        (
            Parameter("front_right_joint", "text", "front_right_joint", "a wheel's joint"),
            Parameter("front_left_joint", "text", "front_left_joint", "a wheel's joint"),
            Parameter("rear_right_joint", "text", "rear_right_joint", "a driven wheel's joint"),
            Parameter("rear_left_joint", "text", "rear_left_joint", "a driven wheel's joint"),
            Parameter(
                "right_steering_joint", "text", "right_steering_joint", "steers the right wheel"
            ),
            Parameter(
                "left_steering_joint", "text", "left_steering_joint", "steers the left wheel"
            ),
            Parameter("steering_wheel_joint", "text", "steering_wheel_joint", "the driver's wheel"),
            Parameter("max_speed", "number", 20.0, "speed limit", "m/s"),
            Parameter("max_steer", "number", 0.6, "limit of the steering angle", "rad"),
            Parameter("max_steering_angle", "number", 7.85, "the driver's wheel at it", "rad"),
            Parameter("right_steering_pid_gain", "vector", _NO_GAIN, "p, i, d"),
            Parameter("right_steering_i_range", "text", "0 0", "bounds of the integral"),
            Parameter("left_steering_pid_gain", "vector", _NO_GAIN, "p, i, d"),
            Parameter("left_steering_i_range", "text", "0 0", "bounds of the integral"),
            Parameter("linear_velocity_pid_gain", "vector", _NO_GAIN, "p, i, d"),
            Parameter("linear_velocity_i_range", "text", "0 0", "bounds of the integral"),
            Parameter("update_rate", "number", 100.0, "update and publish rate", "Hz"),
            Parameter("odometry_frame", "text", "odom", "frame of the odometry"),
            Parameter("robot_base_frame", "text", "base_footprint", "child frame"),
            Parameter("publish_odom", "flag", False, "publish odometry"),
            Parameter("publish_odom_tf", "flag", False, "publish odom → base"),
            Parameter("publish_wheel_tf", "flag", False, "publish base → wheels"),
            Parameter("publish_distance", "flag", False, "publish the distance driven"),
            Parameter("publish_steerangle", "flag", False, "publish the mean steering angle"),
            *covariances(1e-5, 1e-3),
        ),
    ),
    topics=(
        Topic("cmd_vel", "geometry_msgs/msg/Twist", kind="listens"),
        Topic("odom", "nav_msgs/msg/Odometry", rate="`update_rate`", frame="`odometry_frame`"),
        Topic("distance", "std_msgs/msg/Float32", rate="`update_rate`"),
        Topic("steerangle", "std_msgs/msg/Float32", rate="`update_rate`"),
        Topic(
            "/tf",
            "tf2_msgs/msg/TFMessage",
            rate="`update_rate`",
            frame="`odometry_frame`, wheels: the base",
        ),
    ),
    behaviour=(
        "`linear.x` is the speed, `angular.z` the steering angle of the middle front wheel, with"
        " the sign of the speed; the wheels' own angles meet in one turning centre.",
        "Wheel radius, track and wheelbase are measured at the joints and the rear right wheel's"
        " collision.",
        "The PIDs are Gazebo's: their effort acts for one physics step of a period. The engine"
        " applies the same impulse evenly over the period.",
        "Odometry is the true pose and velocity.",
        "A `steering_wheel_joint` that is there turns with the wheels, over the steering ratio.",
    ),
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim ackermann steering",
        "The gz-sim car: wheel speeds and steering angles from a Twist or an angle.",
        (
            "gz-sim-ackermann-steering-system",
            "ignition-gazebo-ackermann-steering-system",
            "gz::sim::systems::AckermannSteering",
            "ignition::gazebo::systems::AckermannSteering",
        ),
        (
            Parameter("topic", "text", "", "commands, by default /model/M/cmd_vel"),
            Parameter("sub_topic", "text", "", "the same, below /model/M"),
            *GZ_ODOMETRY,
            *GZ_SIDES,
            Parameter("left_steering_joint", "text", "", "left steering joints, repeatable"),
            Parameter("right_steering_joint", "text", "", "right steering joints, repeatable"),
            GZ_SEPARATION,
            Parameter("kingpin_width", "number", 0.8, "distance of the steering axes", "m"),
            Parameter("wheel_base", "number", 1.0, "distance of the axles", "m"),
            GZ_WHEEL_RADIUS,
            Parameter("steering_limit", "number", 0.5, "largest steering angle", "rad"),
            Parameter("steer_p_gain", "number", 1.0, "steering rate per error", "1/s"),
            Parameter("steering_only", "flag", False, "only steer, from an angle"),
            GZ_RATE,
            Parameter("min_velocity", "number", -1e12, "lowest speed and turn rate", "m/s, rad/s"),
            Parameter("max_velocity", "number", 1e12, "highest speed and turn rate", "m/s, rad/s"),
            Parameter("min_acceleration", "number", -1e12, "hardest braking", "m/s²"),
            Parameter("max_acceleration", "number", 1e12, "hardest acceleration", "m/s²"),
            *GZ_NO_JERK,
            Parameter("use_actuator_msg", "refused", "", "there is no actuators message in ROS"),
            Parameter("actuator_number", "refused", "", "there is no actuators message in ROS"),
        ),
    ),
    topics=(
        GZ_COMMANDS,
        Topic("/model/M/steer_angle", "std_msgs/msg/Float64", kind="listens"),
        *GZ_TOPICS,
    ),
    behaviour=(
        "The turning radius is v/ω, at least `wheel_base`/sin(`steering_limit`); the steering"
        " joints turn with `steer_p_gain` times their error.",
        "Odometry is dead reckoning from wheels and steering.",
        "With `steering_only` the topic carries an angle and wheels are left alone.",
        "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to.",
    ),
)

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
    tokens = parameters.text(f"{name}_i_range").split()
    try:
        low, high = (float(token) for token in tokens)
    except ValueError:
        text = f"<{name}_i_range> is '{' '.join(tokens)}', not two numbers; 0 0 is used"
        context.report("parameter.bad-value", text)
        low = high = 0.0
    return GazeboPid(p, i, d, i_max=high, i_min=low)
