"""``turtlebot3_drive``: wanders about, turning away from what the scan shows.

Ahead is free from 0.7 m, 30° to the sides from 0.6 m; a turn takes 30°. Numbers are those of
``turtlebot3_gazebo`` (turtlebot3_simulations, noetic).
"""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence
from enum import Enum
from typing import Any, NamedTuple

from gazelle.geometry import yaw_from_quat_xyzw
from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import quat_xyzw_of
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import namespace_parameters, start_node, ticks
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "Ranges", "Wanderer", "ranges_of", "run"]

PARAMETERS = ParameterTable(
    "turtlebot3_drive",
    "Wanders about without bumping into things. The parameter is one of the namespace.",
    ("turtlebot3_gazebo/turtlebot3_drive",),
    (
        Parameter(
            "cmd_vel_topic_name", "text", "cmd_vel", "where commands are sent", ros_versions=(1,)
        ),
    ),
)

_PERIOD_NS = 8_000_000
_LINEAR_M_S = 0.3
_ANGULAR_RAD_S = 1.5
_ESCAPE_RAD = math.radians(30)
_AHEAD_M = 0.7
_ASIDE_M = 0.6
_ANGLES_DEG = (0, 30, 330)


class Ranges(NamedTuple):
    """What is seen, metres."""

    center: float = 0.0
    left: float = 0.0
    right: float = 0.0


class _State(Enum):
    LOOK = 0
    FORWARD = 1
    RIGHT = 2
    LEFT = 3


class Wanderer:
    """Says which velocities come next.

    Attributes:
        ranges: as seen last; all 0, which is blocked, before the first scan.
        yaw_rad: heading.
    """

    def __init__(self) -> None:
        """Begin by looking."""
        self.ranges = Ranges()
        self.yaw_rad = 0.0
        self._from_rad = 0.0
        self._state = _State.LOOK

    def next(self) -> tuple[float, float] | None:
        """Return linear and angular velocity, None when nothing is sent."""
        if self._state is _State.LOOK:
            self._state, self._from_rad = self._look(), self.yaw_rad
            return None
        if self._state is _State.FORWARD:
            self._state = _State.LOOK
            return _LINEAR_M_S, 0.0
        # As the original, which ends a turn where the heading goes from π to −π.
        if abs(self._from_rad - self.yaw_rad) >= _ESCAPE_RAD:
            self._state = _State.LOOK
            return None
        return 0.0, _ANGULAR_RAD_S if self._state is _State.LEFT else -_ANGULAR_RAD_S

    def _look(self) -> _State:
        if self.ranges.center < _AHEAD_M or self.ranges.left < _ASIDE_M:
            return _State.RIGHT
        return _State.LEFT if self.ranges.right < _ASIDE_M else _State.FORWARD


def ranges_of(scan: Any) -> Ranges:
    """Return what a ``LaserScan`` shows at 0°, 30° and 330°; what it does not see is far.

    The original takes the samples of these numbers, which are the angles of a TurtleBot3's 360
    samples only; of other scans the samples at these angles are taken.
    """
    return Ranges(*(_range(scan, angle) for angle in _ANGLES_DEG))


def _range(scan: Any, angle_deg: int) -> float:
    ranges: Sequence[float] = scan.ranges
    index = angle_deg
    if len(ranges) != 360:
        if not ranges or not scan.angle_increment:
            return float(scan.range_max)
        offset = (math.radians(angle_deg) - scan.angle_min) % math.tau
        index = round(offset / scan.angle_increment)
    value = float(ranges[index]) if 0 <= index < len(ranges) else math.inf
    return value if math.isfinite(value) else float(scan.range_max)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Wander until told to stop, then stand still."""
    node = start_node(arguments, graph)
    node.log("info", "TurtleBot3 Simulation Node Init")
    wanderer = Wanderer()

    def on_scan(scan: Any) -> None:
        wanderer.ranges = ranges_of(scan)

    def on_odometry(odometry: Any) -> None:
        wanderer.yaw_rad = yaw_from_quat_xyzw(quat_xyzw_of(odometry.pose.pose.orientation))

    with namespace_parameters(node, arguments, PARAMETERS) as beside:
        topic = beside.text("cmd_vel_topic_name") or "cmd_vel"
    twist: Any = message_type("geometry_msgs/msg/Twist")
    out = node.create_publisher(topic, twist, queue_size=10)
    node.create_subscription("scan", "sensor_msgs/msg/LaserScan", on_scan, queue_size=10)
    node.create_subscription("odom", "nav_msgs/msg/Odometry", on_odometry, queue_size=10)
    for _now_ns in ticks(node, _PERIOD_NS, stop):
        command = wanderer.next()
        if command is not None:
            message = twist()
            message.linear.x, message.angular.z = command
            out.publish(message)
    out.publish(twist())
    node.shutdown()
    return 0
