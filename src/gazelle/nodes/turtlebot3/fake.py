"""``turtlebot3_fake_node``: a TurtleBot3 that drives without physics.

It hears ``cmd_vel`` and sends ``odom``, ``joint_states`` and the transform from odom to the base,
30 times a second; a command holds for one second.

In ROS 2 it is ``turtlebot3_fake_node/turtlebot3_fake_node``: 100 times a second, without
covariances, with parameters of its own. Numbers are those of ``turtlebot3_fake`` and
``turtlebot3_fake_node`` (turtlebot3_simulations, noetic and humble).
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.errors import LaunchError
from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.graph.ros2_node_parameters import Descriptor
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_plane_pose, set_transform
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import (
    namespace_parameters,
    node_parameters,
    private_parameters,
    start_node,
    ticks,
)
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "ROS2_PARAMETERS", "FakeBase", "run", "run_ros2"]

_PERIOD_NS = 1_000_000_000 // 30
_ROS2_PERIOD_NS = 10_000_000
_TIMEOUT_NS = 1_000_000_000
_WHEEL_RADIUS_M = 0.033
_SEPARATIONS_M = {"burger": 0.160, "waffle": 0.287, "waffle_pi": 0.287}
_DIAGONAL = (0.1, 0.1, 1e6, 1e6, 1e6, 0.2)
_COVARIANCE = [value if column == row else 0.0 for row, value in enumerate(_DIAGONAL)
               for column in range(6)]  # fmt: skip

_FRAMES = (
    Parameter("joint_states_frame", "text", "base_footprint", "frame of the joint states"),
    Parameter("odom_frame", "text", "odom", "frame of the odometry"),
    Parameter("base_frame", "text", "base_footprint", "the robot's frame"),
)
PARAMETERS = ParameterTable(
    "turtlebot3_fake (ROS 1)",
    "A TurtleBot3 that drives without physics. The parameters are those of its namespace.",
    ("turtlebot3_fake/turtlebot3_fake_node",),
    (
        Parameter(
            "tb3_model", "text", None, "burger, waffle or waffle_pi: how far its wheels are apart"
        ),
        Parameter("wheel_left_joint_name", "text", "wheel_left_joint", "joint of the left wheel"),
        Parameter(
            "wheel_right_joint_name", "text", "wheel_right_joint", "joint of the right wheel"
        ),
        *_FRAMES,
    ),
)
ROS2_PARAMETERS = ParameterTable(
    "turtlebot3_fake_node (ROS 2)",
    "A TurtleBot3 that drives without physics. Without its wheels it does not start.",
    ("turtlebot3_fake_node/turtlebot3_fake_node",),
    (
        Parameter("wheels.separation", "number", None, "how far they are apart, above 0", "m"),
        Parameter("wheels.radius", "number", None, "their radius, above 0", "m"),
        *_FRAMES,
    ),
)


@dataclass(slots=True)
class FakeBase:
    """Two wheels and where they have taken the robot.

    Attributes:
        separation_m: between the wheels.
        radius_m: of the wheels.
        x_m, y_m, yaw_rad: pose in the odom frame.
        linear_m_s, angular_rad_s: as commanded.
        left_rad, right_rad: how far the wheels have turned.
        commanded_ns: time of the last command.
    """

    separation_m: float
    radius_m: float = _WHEEL_RADIUS_M
    x_m: float = 0.0
    y_m: float = 0.0
    yaw_rad: float = 0.0
    linear_m_s: float = 0.0
    angular_rad_s: float = 0.0
    left_rad: float = 0.0
    right_rad: float = 0.0
    commanded_ns: int = 0

    @property
    def wheel_speeds_rad_s(self) -> tuple[float, float]:
        """Left and right."""
        rim_m_s = self.angular_rad_s * self.separation_m / 2
        return (
            (self.linear_m_s - rim_m_s) / self.radius_m,
            (self.linear_m_s + rim_m_s) / self.radius_m,
        )

    def command(self, linear_m_s: float, angular_rad_s: float, now_ns: int) -> None:
        """Go on with these velocities for a second."""
        self.linear_m_s, self.angular_rad_s = linear_m_s, angular_rad_s
        self.commanded_ns = now_ns

    def move(self, now_ns: int, duration_ns: int) -> None:
        """Go on to a time; a duration is integrated along its middle heading."""
        if abs(now_ns - self.commanded_ns) > _TIMEOUT_NS:
            self.linear_m_s = self.angular_rad_s = 0.0
        duration_s = duration_ns / 1e9
        left, right = self.wheel_speeds_rad_s
        self.left_rad += left * duration_s
        self.right_rad += right * duration_s
        turn = self.angular_rad_s * duration_s
        way = self.linear_m_s * duration_s
        self.x_m += way * math.cos(self.yaw_rad + turn / 2)
        self.y_m += way * math.sin(self.yaw_rad + turn / 2)
        self.yaw_rad += turn


@dataclass(frozen=True, slots=True)
class _Setup:
    """What the two generations have different.

    Attributes:
        period_ns: between two messages.
        joints: left and right.
        joints_frame, frames: of joint states; ends of the transform.
        covariance: of pose and twist.
        takes_after: commands are taken after an update, as by roscpp's ``spinOnce()``; else as they
            come.
    """

    period_ns: int
    joints: tuple[str, str]
    joints_frame: str
    frames: tuple[str, str]
    covariance: list[float]
    takes_after: bool


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 1: drive until told to stop."""
    node = start_node(arguments, graph, offers_parameters=False)
    with namespace_parameters(node, arguments, PARAMETERS) as beside:
        setup = _Setup(
            _PERIOD_NS,
            (beside.text("wheel_left_joint_name"), beside.text("wheel_right_joint_name")),
            beside.text("joint_states_frame"),
            (beside.text("odom_frame"), beside.text("base_frame")),
            _COVARIANCE,
            takes_after=True,
        )
        model = beside.text("tb3_model")
    _drive(node, FakeBase(_separation(node, model)), setup, stop)
    return 0


def run_ros2(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 2: drive until told to stop.

    Raises:
        LaunchError: the wheels are not given.
    """
    given = arguments.params
    wheels = [given.get(f"wheels/{name}") for name in ("separation", "radius")]
    if not all(isinstance(value, int | float) and value > 0 for value in wheels):
        raise LaunchError(
            f"wheels.separation and wheels.radius must be positive numbers, not {wheels[0]!r} and "
            f"{wheels[1]!r}; the original divides by 0 without them\n"
            "  fix: -p wheels.separation:=0.16 -p wheels.radius:=0.033, or --params-file"
        )
    node = start_node(arguments, graph, offers_parameters=False)
    with private_parameters(node, arguments, ROS2_PARAMETERS) as own:
        values = {row.key: own.text(row.key) for row in _FRAMES}
    separation, radius = (float(value) for value in wheels if value is not None)
    numbers = {"wheels.separation": separation, "wheels.radius": radius}
    declared = {**values, **numbers}
    # Read once, as the original does, which lets them be set to no effect.
    fixed = {name: Descriptor(read_only=True) for name in declared}
    node_parameters(node, declared, descriptors=fixed)
    node.log("info", "Turtlebot3 fake node has been initialised")
    setup = _Setup(
        _ROS2_PERIOD_NS,
        ("wheel_left_joint", "wheel_right_joint"),
        values["joint_states_frame"],
        (values["odom_frame"], values["base_frame"]),
        [0.0] * 36,
        takes_after=False,
    )
    _drive(node, FakeBase(separation, radius), setup, stop)
    return 0


def _drive(node: Node, base: FakeBase, setup: _Setup, stop: threading.Event) -> None:
    lock = threading.Lock()
    waiting: list[tuple[float, float]] = []
    publish = _publishing(node, base, setup)

    def take() -> None:
        for linear, angular in waiting:
            base.command(linear, angular, node.clock.now_ns())
        waiting.clear()

    def on_twist(twist: Any) -> None:
        linear, angular = twist.linear.x, twist.angular.z
        if not (math.isfinite(linear) and math.isfinite(angular)):
            node.log("warn", f"a command that is no number is left out: {linear}, {angular}")
            return
        with lock:
            waiting.append((linear, angular))
            if not setup.takes_after:
                take()

    twist_type = message_type("geometry_msgs/msg/Twist")
    node.create_subscription("cmd_vel", twist_type, on_twist, queue_size=100)
    last_ns = node.clock.now_ns()
    for now_ns in ticks(node, setup.period_ns, stop):
        with lock:
            # Time that went back starts anew.
            base.move(now_ns, max(0, now_ns - last_ns))
        publish(now_ns)
        with lock:
            take()
        last_ns = now_ns
    node.shutdown()


def _separation(node: Node, model: str) -> float:
    if model in _SEPARATIONS_M:
        return _SEPARATIONS_M[model]
    said = f"'{model}' is no TurtleBot3" if model else "the parameter tb3_model is not set"
    hint = did_you_mean(model, _SEPARATIONS_M) if model else ""
    node.log(
        "warn",
        f"{said}; there are {', '.join(_SEPARATIONS_M)}. {hint}\n"
        "  fix: export TURTLEBOT3_MODEL=burger (or waffle, waffle_pi) before the launch\n"
        "  burger's wheels are taken; the original computes with an arbitrary distance",
    )
    return _SEPARATIONS_M["burger"]


def _publishing(node: Node, base: FakeBase, setup: _Setup) -> Callable[[int], None]:
    """Return what tells others the state at a time."""
    odometry: Any = message_type("nav_msgs/msg/Odometry")
    joints: Any = message_type("sensor_msgs/msg/JointState")
    tf: Any = message_type("tf2_msgs/msg/TFMessage")
    odom_out = node.create_publisher("odom", odometry, queue_size=100)
    joints_out = node.create_publisher("joint_states", joints, queue_size=100)
    tf_out = node.create_publisher("/tf", tf, queue_size=100)

    def publish(now_ns: int) -> None:
        odom_out.publish(_odometry(odometry, base, setup, now_ns))
        state = joints(
            name=list(setup.joints),
            position=[base.left_rad, base.right_rad],
            velocity=list(base.wheel_speeds_rad_s),
            effort=[0.0, 0.0],
        )
        set_header(state, now_ns, setup.joints_frame)
        joints_out.publish(state)
        tf_out.publish(tf(transforms=[_transform(base, setup, now_ns)]))

    return publish


def _odometry(kind: Any, base: FakeBase, setup: _Setup, now_ns: int) -> Any:
    message = kind(child_frame_id=setup.frames[1])
    set_header(message, now_ns, setup.frames[0])
    pose, twist = message.pose, message.twist
    set_plane_pose(pose.pose, (base.x_m, base.y_m, base.yaw_rad))
    twist.twist.linear.x, twist.twist.angular.z = base.linear_m_s, base.angular_rad_s
    pose.covariance = twist.covariance = setup.covariance
    return message


def _transform(base: FakeBase, setup: _Setup, now_ns: int) -> Any:
    message: Any = message_type("geometry_msgs/msg/TransformStamped")()
    message.child_frame_id = setup.frames[1]
    set_header(message, now_ns, setup.frames[0])
    set_transform(message.transform, Pose.from_xy_yaw(base.x_m, base.y_m, base.yaw_rad))
    return message
