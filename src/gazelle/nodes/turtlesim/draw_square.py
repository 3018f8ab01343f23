"""``draw_square``: ``turtle1`` goes 2 m ahead and turns left by 90°, again and again."""

from __future__ import annotations

import math
import threading
import time
from dataclasses import dataclass
from enum import Enum
from typing import Any

from gazelle.errors import GazelleError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node
from gazelle.nodes.turtlesim.turtle import PERIOD_S, normalized

__all__ = ["Place", "Square", "run"]

_SIDE_M = 2.0
_NEAR_M = 0.1
_NEAR_RAD = 0.01
_STILL = 0.0001


class _State(Enum):
    FORWARD = "forward"
    STOP_FORWARD = "stop after a side"
    TURN = "turn"
    STOP_TURN = "stop after a corner"


# Linear and angular velocity, m/s and rad/s.
_SPEEDS = {_State.FORWARD: (1.0, 0.0), _State.TURN: (0.0, 0.4)}


@dataclass(frozen=True, slots=True)
class Place:
    """Where a turtle is, metres and radians."""

    x: float
    y: float
    theta: float


class Square:
    """Says which velocities come next.

    Attributes:
        goal: where the turtle is to go, None before the first pose.
    """

    def __init__(self) -> None:
        """Begin with the first side."""
        self.goal: Place | None = None
        self._state = _State.FORWARD

    def next(self, pose: Any) -> tuple[tuple[float, float] | None, list[str]]:
        """Go on from a ``turtlesim/Pose``.

        Returns:
            Linear and angular velocity, None when nothing is sent, and what to log.
        """
        if self.goal is None:
            return _SPEEDS[self._state], [self._set_goal(_ahead(pose))]
        if self._state in _SPEEDS:
            if not self._is_reached(pose):
                return _SPEEDS[self._state], []
            is_side = self._state is _State.FORWARD
            self._state = _State.STOP_FORWARD if is_side else _State.STOP_TURN
            return (0.0, 0.0), []
        if pose.angular_velocity >= _STILL or pose.linear_velocity >= _STILL:
            return (0.0, 0.0), []
        is_side = self._state is _State.STOP_TURN
        self._state = _State.FORWARD if is_side else _State.TURN
        text = self._set_goal(_ahead(pose) if is_side else _turned(pose))
        return None, ["Reached goal", text]

    def _set_goal(self, goal: Place) -> str:
        self.goal = goal
        return f"New goal [{goal.x:f} {goal.y:f}, {goal.theta:f}]"

    def _is_reached(self, pose: Any) -> bool:
        assert self.goal is not None
        return (
            abs(pose.x - self.goal.x) < _NEAR_M
            and abs(pose.y - self.goal.y) < _NEAR_M
            # Unlike the original's, it knows that π and -π are one heading, or a turtle that
            # looks west turns for ever.
            and abs(normalized(pose.theta - self.goal.theta)) < _NEAR_RAD
        )


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Reset the turtles and draw until told to stop."""
    node = start_node(arguments, graph)
    poses: list[Any] = []

    def on_pose(pose: Any) -> None:
        poses[:] = [pose]

    twist: Any = message_type("geometry_msgs/msg/Twist")
    out = node.create_publisher("turtle1/cmd_vel", twist, queue_size=1)
    node.create_subscription("turtle1/pose", "turtlesim/msg/Pose", on_pose, queue_size=1)
    _reset(node)
    # Where the turtle was before says nothing about the way to go.
    poses.clear()
    square = Square()
    next_s = time.monotonic()
    while not stop.wait(max(0.0, next_s - time.monotonic())):
        next_s = max(next_s, time.monotonic() - PERIOD_S) + PERIOD_S
        if not poses:
            continue
        command, texts = square.next(poses[0])
        for text in texts:
            node.log("info", text)
        if command is not None:
            message = twist()
            message.linear.x, message.angular.z = command
            out.publish(message)
    node.shutdown()
    return 0


def _ahead(pose: Any) -> Place:
    x = math.cos(pose.theta) * _SIDE_M + pose.x
    y = math.sin(pose.theta) * _SIDE_M + pose.y
    return Place(x, y, pose.theta)


def _turned(pose: Any) -> Place:
    return Place(pose.x, pose.y, normalized(pose.theta + math.pi / 2))


def _reset(node: Node) -> None:
    """Ask for a reset; without a simulator there is none, and none is needed."""
    service = service_type("std_srvs/Empty")
    client = node.create_client("reset", service)
    if not client.available:
        return
    try:
        client.call(service.Request(), timeout_s=5.0)
    except GazelleError as error:
        node.log("warn", f"the turtles were not reset: {error}")
