"""``turtlebot3_fake_node``: a TurtleBot3 that drives without physics.

It hears ``cmd_vel`` and sends ``odom``, ``joint_states`` and the transform from odom to the base,
30 times a second; a command holds for one second. Parameters of the namespace:

| name | default | meaning |
| --- | --- | --- |
| tb3_model | – | burger, waffle or waffle_pi: how far the wheels are apart |
| wheel_left_joint_name, wheel_right_joint_name | wheel_left_joint, wheel_right_joint | joints |
| joint_states_frame | base_footprint | frame of the joint states |
| odom_frame, base_frame | odom, base_footprint | ends of the transform |

Numbers are those of ``turtlebot3_fake`` (turtlebot3_simulations, noetic).
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node, ticks

__all__ = ["FakeBase", "run"]

_PERIOD_NS = 1_000_000_000 // 30
_TIMEOUT_NS = 1_000_000_000
_WHEEL_RADIUS_M = 0.033
_SEPARATIONS_M = {"burger": 0.160, "waffle": 0.287, "waffle_pi": 0.287}
_DIAGONAL = (0.1, 0.1, 1e6, 1e6, 1e6, 0.2)
_COVARIANCE = [value if column == row else 0.0 for row, value in enumerate(_DIAGONAL)
               for column in range(6)]  # fmt: skip


@dataclass(slots=True)
class FakeBase:
    """Two wheels and where they have taken the robot.

    Attributes:
        separation_m: between the wheels.
        x_m, y_m, yaw_rad: pose in the odom frame.
        linear_m_s, angular_rad_s: as commanded.
        left_rad, right_rad: how far the wheels have turned.
        commanded_ns: time of the last command.
    """

    separation_m: float
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
        outward = self.angular_rad_s * self.separation_m / 2
        return (
            (self.linear_m_s - outward) / _WHEEL_RADIUS_M,
            (self.linear_m_s + outward) / _WHEEL_RADIUS_M,
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


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Drive until told to stop."""
    node = start_node(arguments, graph)
    base, lock = FakeBase(_separation(node)), threading.Lock()
    publish = _publishing(node, base)

    def on_twist(twist: Any) -> None:
        linear, angular = twist.linear.x, twist.angular.z
        if not (math.isfinite(linear) and math.isfinite(angular)):
            node.log("warn", f"a command that is no number is left out: {linear}, {angular}")
            return
        with lock:
            base.command(linear, angular, node.clock.now_ns())

    twist_type = message_type("geometry_msgs/msg/Twist")
    node.create_subscription("cmd_vel", twist_type, on_twist, queue_size=100)
    last_ns = node.clock.now_ns()
    for now_ns in ticks(node, _PERIOD_NS, stop):
        with lock:
            # Time that went back starts anew.
            base.move(now_ns, max(0, now_ns - last_ns))
        publish(now_ns)
        last_ns = now_ns
    node.shutdown()
    return 0


def _separation(node: Node) -> float:
    model = str(_parameter(node, "tb3_model", ""))
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


def _publishing(node: Node, base: FakeBase) -> Callable[[int], None]:
    """Return what tells others the state at a time."""
    odometry: Any = message_type("nav_msgs/msg/Odometry")
    joints: Any = message_type("sensor_msgs/msg/JointState")
    tf: Any = message_type("tf2_msgs/msg/TFMessage")
    odom_out = node.create_publisher("odom", odometry, queue_size=100)
    joints_out = node.create_publisher("joint_states", joints, queue_size=100)
    tf_out = node.create_publisher("/tf", tf, queue_size=100)
    names = [_name(node, "wheel_left_joint_name", "wheel_left_joint"),
             _name(node, "wheel_right_joint_name", "wheel_right_joint")]  # fmt: skip
    joints_frame = _name(node, "joint_states_frame", "base_footprint")
    frames = _name(node, "odom_frame", "odom"), _name(node, "base_frame", "base_footprint")

    def publish(now_ns: int) -> None:
        odom_out.publish(_odometry(odometry, base, frames, now_ns))
        state = joints(
            name=names,
            position=[base.left_rad, base.right_rad],
            velocity=list(base.wheel_speeds_rad_s),
            effort=[0.0, 0.0],
        )
        _stamp(state, now_ns, joints_frame)
        joints_out.publish(state)
        tf_out.publish(tf(transforms=[_transform(base, frames, now_ns)]))

    return publish


def _odometry(kind: Any, base: FakeBase, frames: tuple[str, str], now_ns: int) -> Any:
    message = kind(child_frame_id=frames[1])
    _stamp(message, now_ns, frames[0])
    pose, twist = message.pose, message.twist
    pose.pose.position.x, pose.pose.position.y = base.x_m, base.y_m
    _set_yaw(pose.pose.orientation, base.yaw_rad)
    twist.twist.linear.x, twist.twist.angular.z = base.linear_m_s, base.angular_rad_s
    pose.covariance = twist.covariance = _COVARIANCE
    return message


def _transform(base: FakeBase, frames: tuple[str, str], now_ns: int) -> Any:
    message: Any = message_type("geometry_msgs/msg/TransformStamped")(child_frame_id=frames[1])
    _stamp(message, now_ns, frames[0])
    message.transform.translation.x, message.transform.translation.y = base.x_m, base.y_m
    _set_yaw(message.transform.rotation, base.yaw_rad)
    return message


def _set_yaw(rotation: Any, yaw_rad: float) -> None:
    rotation.z, rotation.w = math.sin(yaw_rad / 2), math.cos(yaw_rad / 2)


def _stamp(message: Any, now_ns: int, frame_id: str) -> None:
    message.header.frame_id = frame_id
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(now_ns, 1_000_000_000)


def _parameter(node: Node, name: str, default: Any) -> Any:
    return node.parameters.get(name) if node.parameters.has(name) else default


def _name(node: Node, name: str, default: str) -> str:
    return str(_parameter(node, name, default))
