"""``turtlebot3_teleop_key``: w, x, a and d change the speeds step by step, s and space stop.

The robot is that of the parameter ``model`` (ROS 1) or of ``TURTLEBOT3_MODEL`` (ROS 2, under the
name ``teleop_keyboard``); it sets the limits. From Jazzy on, ROS 2's sends ``TwistStamped``.
Numbers are those of ``turtlebot3_teleop`` (noetic and humble).
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from dataclasses import dataclass

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import namespace_parameters, start_node
from gazelle.nodes.teleop.keyboard import CTRL_C, Keys, say
from gazelle.nodes.twist_publisher import TwistPublisher
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["PARAMETERS", "Limits", "Speeds", "limits_of", "run", "run_ros2"]

PARAMETERS = ParameterTable(
    "turtlebot3_teleop",
    "Drives a TurtleBot3 from the keyboard. The parameter is one of the namespace; in ROS 2 the"
    " variable `TURTLEBOT3_MODEL` has its place.",
    ("turtlebot3_teleop/turtlebot3_teleop_key", "turtlebot3_teleop/teleop_keyboard"),
    (
        Parameter(
            "model",
            "text",
            "burger",
            "burger, waffle or waffle_pi: how fast it may go",
            ros_versions=(1,),
        ),
    ),
)

_HELP = """
Control Your TurtleBot3!
---------------------------
Moving around:
        w
   a    s    d
        x

w/x : increase/decrease linear velocity (Burger : ~ 0.22, Waffle and Waffle Pi : ~ 0.26)
a/d : increase/decrease angular velocity (Burger : ~ 2.84, Waffle and Waffle Pi : ~ 1.82)

space key, s : force stop

CTRL-C to quit
"""
_LINEAR_STEP_M_S = 0.01
_ANGULAR_STEP_RAD_S = 0.1
_PERIOD_S = 0.1
_LINES_PER_HELP = 20
_STAMPED = frozenset({"jazzy", "kilted", "rolling"})
_STEPS = {"w": (1, 0), "x": (-1, 0), "a": (0, 1), "d": (0, -1)}


@dataclass(frozen=True, slots=True)
class Limits:
    """The fastest a robot may be told to go."""

    linear_m_s: float
    angular_rad_s: float


_BURGER = Limits(0.22, 2.84)
_WAFFLE = Limits(0.26, 1.82)


def limits_of(model: str) -> Limits:
    """Return the limits of burger, waffle or waffle_pi; burger's for any other."""
    return _WAFFLE if model in {"waffle", "waffle_pi"} else _BURGER


@dataclass(slots=True)
class Speeds:
    """What was asked for by keys, and what is sent on the way there.

    Attributes:
        limits: of the robot.
        linear_m_s, angular_rad_s: asked for.
        sent_m_s, sent_rad_s: sent last.
    """

    limits: Limits
    linear_m_s: float = 0.0
    angular_rad_s: float = 0.0
    sent_m_s: float = 0.0
    sent_rad_s: float = 0.0

    def press(self, key: str) -> bool:
        """Take a key; return whether it means something."""
        if key in {" ", "s"}:
            self.linear_m_s = self.angular_rad_s = self.sent_m_s = self.sent_rad_s = 0.0
            return True
        if key not in _STEPS:
            return False
        ahead, left = _STEPS[key]
        linear = self.linear_m_s + ahead * _LINEAR_STEP_M_S
        angular = self.angular_rad_s + left * _ANGULAR_STEP_RAD_S
        self.linear_m_s = _within(linear, self.limits.linear_m_s)
        self.angular_rad_s = _within(angular, self.limits.angular_rad_s)
        return True

    def advance(self) -> tuple[float, float]:
        """Return what is sent next: at most half a step from what was sent last."""
        self.sent_m_s = _towards(self.sent_m_s, self.linear_m_s, _LINEAR_STEP_M_S / 2)
        self.sent_rad_s = _towards(self.sent_rad_s, self.angular_rad_s, _ANGULAR_STEP_RAD_S / 2)
        return self.sent_m_s, self.sent_rad_s


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 1: drive until Ctrl-C, or told to stop; the robot is stopped."""

    def model_of(beside: ParameterReader) -> str:
        return beside.text("model")

    text = "currently:\tlinear vel %s\t angular vel %s "
    return _drive(arguments, graph, stop, model_of, text, is_stamped=False)


def run_ros2(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 2: the same with its words and, from Jazzy on, stamps."""
    is_stamped = os.environ.get("ROS_DISTRO", "") in _STAMPED
    text = "currently:\tlinear velocity %s\t angular velocity %s "

    def model_of(_beside: ParameterReader) -> str:
        return os.environ.get("TURTLEBOT3_MODEL", "burger")

    return _drive(arguments, graph, stop, model_of, text, is_stamped=is_stamped)


def _drive(
    arguments: NodeArguments,
    graph: Graph,
    stop: threading.Event,
    model_of: Callable[[ParameterReader], str],
    text: str,
    *,
    is_stamped: bool,
) -> int:
    # Who has looked is not ended in the midst: the terminal is put back.
    if stop.is_set():
        return 0
    with Keys("turtlebot3_teleop_key", takes_ctrl_c=True) as keys:
        node = start_node(arguments, graph)
        with namespace_parameters(node, arguments, PARAMETERS) as beside:
            speeds = Speeds(limits_of(model_of(beside)))
        twists = TwistPublisher(node, is_stamped=is_stamped, frame_id="")
        say(_HELP)
        lines = 0
        while not stop.is_set():
            key = keys.read(_PERIOD_S)
            if key is None or key == CTRL_C:
                break
            if speeds.press(key):
                lines += key in _STEPS
                say(text % (speeds.linear_m_s, speeds.angular_rad_s))
            if lines == _LINES_PER_HELP:
                say(_HELP)
                lines = 0
            linear, angular = speeds.advance()
            twists.publish(linear, 0.0, angular)
        twists.stop()
        node.shutdown()
    return 0


def _within(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)


def _towards(value: float, target: float, step: float) -> float:
    return min(target, value + step) if target > value else max(target, value - step)
