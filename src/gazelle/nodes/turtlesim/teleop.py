"""``turtle_teleop_key``: arrow keys drive ``turtle1``; in ROS 2 letters turn it to headings."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.errors import GazelleError
from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import (
    namespace_parameters,
    node_parameters,
    number_or_end,
    private_parameters,
    start_node,
)
from gazelle.nodes.teleop.keyboard import Keys, say
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "run"]

PARAMETERS = ParameterTable(
    "turtle_teleop_key",
    "Drives a turtle from the keyboard. In ROS 1 the parameters are those of its namespace. What"
    " is no number ends it.",
    ("turtlesim/turtle_teleop_key",),
    (
        Parameter("scale_linear", "number", 2.0, "how fast an arrow drives", "m/s", live=True),
        Parameter("scale_angular", "number", 2.0, "how fast an arrow turns", "rad/s", live=True),
    ),
)

_PROMPT = """\
Reading from keyboard
---------------------------
Use arrow keys to move the turtle. 'q' to quit."""
_ROS2_PROMPT = """\
Reading from keyboard
---------------------------
Use arrow keys to move the turtle.
Use G|B|V|C|D|E|R|T keys to rotate to absolute orientations. 'F' to cancel a rotation.
'Q' to quit."""
# The last byte of what an arrow key sends (ESC [ A): linear and angular velocity.
_ARROWS = {"A": (1.0, 0.0), "B": (-1.0, 0.0), "C": (0.0, -1.0), "D": (0.0, 1.0)}
# The eight letters around F, seen from it.
_HEADINGS_RAD = {
    "g": 0.0,
    "t": 0.7854,
    "r": 1.5708,
    "e": 2.3562,
    "d": 3.1416,
    "c": -2.3562,
    "v": -1.5708,
    "b": -0.7854,
}
_SCALES = ("scale_linear", "scale_angular")
_POLL_S = 0.1


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Drive until ``q``, Ctrl-C, or told to stop."""
    # Who has looked is not ended in the midst: the terminal is put back.
    if stop.is_set():
        return 0
    with Keys("turtle_teleop_key", takes_ctrl_c=False) as keys:
        node = start_node(arguments, graph, offers_parameters=False)
        is_ros2 = arguments.ros_version == 2
        scales = (_ros2_scales if is_ros2 else _scales)(node, arguments)
        drive = _driver(node, scales)
        turner = _Turner(node) if is_ros2 else None
        say(_ROS2_PROMPT if is_ros2 else _PROMPT)
        while not stop.is_set():
            key = keys.read(_POLL_S)
            if key is None or key == "q":
                break
            if key in _ARROWS:
                drive(*_ARROWS[key])
            elif turner is not None:
                turner.press(key)
        node.shutdown()
    return 0


def _driver(node: Node, scales: Callable[[], tuple[float, float]]) -> Callable[..., None]:
    twist: Any = message_type("geometry_msgs/msg/Twist")
    publisher = node.create_publisher("turtle1/cmd_vel", twist, queue_size=1)

    def drive(linear: float, angular: float) -> None:
        scale_linear, scale_angular = scales()
        message = twist()
        message.linear.x = scale_linear * linear
        message.angular.z = scale_angular * angular
        publisher.publish(message)

    return drive


def _scales(node: Node, arguments: NodeArguments) -> Callable[[], tuple[float, float]]:
    with namespace_parameters(node, arguments, PARAMETERS) as beside:
        linear, angular = (number_or_end(beside, name) for name in _SCALES)
    return lambda: (linear, angular)


def _ros2_scales(node: Node, arguments: NodeArguments) -> Callable[[], tuple[float, float]]:
    with private_parameters(node, arguments, PARAMETERS) as own:
        values = {name: number_or_end(own, name) for name in _SCALES}
    parameters = node_parameters(node, values)
    return lambda: (parameters.values["scale_linear"], parameters.values["scale_angular"])


class _Turner:
    """Sends goals of ``turtle1/rotate_absolute``."""

    def __init__(self, node: Node) -> None:
        self._node = node
        name, kind = "turtle1/rotate_absolute", "turtlesim/RotateAbsolute"
        self._client = ActionClient(node, name, kind, ros_version=2)
        self._goal: ClientGoal | None = None

    def press(self, key: str) -> None:
        if key == "f" and self._goal is not None:
            self._goal.cancel()
        elif key in _HEADINGS_RAD:
            try:
                self._goal = self._client.send_goal({"theta": _HEADINGS_RAD[key]})
            except GazelleError as error:
                self._node.log("warn", str(error))
