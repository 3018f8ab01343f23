"""``teleop_twist_keyboard``: letters around k drive, any other key stops.

Keys and factors are those of ros-teleop's ``teleop_twist_keyboard``.
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import number_or_end, private_parameters, start_node
from gazelle.nodes.teleop.keyboard import CTRL_C, Keys, say
from gazelle.nodes.twist_publisher import TwistPublisher
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "Driving", "run", "run_ros2"]

PARAMETERS = ParameterTable(
    "teleop_twist_keyboard",
    "Drives any robot from the keyboard. What should be a number and is none ends it.",
    (
        "teleop_twist_keyboard/teleop_twist_keyboard.py",
        "teleop_twist_keyboard/teleop_twist_keyboard",
    ),
    (
        Parameter("speed", "number", 0.5, "how fast it drives at the start", "m/s"),
        Parameter("turn", "number", 1.0, "how fast it turns at the start", "rad/s"),
        Parameter("speed_limit", "number", 1000.0, "the most that `speed` becomes", "m/s"),
        Parameter("turn_limit", "number", 1000.0, "the most that `turn` becomes", "rad/s"),
        Parameter("repeat_rate", "number", 0.0, "sends the last again; 0 for never", "Hz"),
        Parameter(
            "key_timeout",
            "number",
            0.5,
            "the robot stops after so long without a key; 0 for never",
            "s",
            ros2_default=0.0,
        ),
        Parameter("stamped", "flag", False, "send TwistStamped"),
        Parameter("frame_id", "text", "", "frame of TwistStamped"),
    ),
)

_HEAD = """
Reading from the keyboard  and Publishing to Twist!"""
_ROS2_HEAD = """
This node takes keypresses from the keyboard and publishes them
as Twist/TwistStamped messages. It works best with a US keyboard layout."""
_HELP = """
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

For Holonomic mode (strafing), hold down the shift key:
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

anything else : stop

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%

CTRL-C to quit
"""
# Along x, y and z, and about z.
_MOVES = {
    "i": (1, 0, 0, 0),
    "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1),
    "l": (0, 0, 0, -1),
    "u": (1, 0, 0, 1),
    ",": (-1, 0, 0, 0),
    ".": (-1, 0, 0, 1),
    "m": (-1, 0, 0, -1),
    "O": (1, -1, 0, 0),
    "I": (1, 0, 0, 0),
    "J": (0, 1, 0, 0),
    "L": (0, -1, 0, 0),
    "U": (1, 1, 0, 0),
    "<": (-1, 0, 0, 0),
    ">": (-1, -1, 0, 0),
    "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0),
    "b": (0, 0, -1, 0),
}
_STOP = (0, 0, 0, 0)
# Factors of linear and angular speed.
_FACTORS = {
    "q": (1.1, 1.1),
    "z": (0.9, 0.9),
    "w": (1.1, 1.0),
    "x": (0.9, 1.0),
    "e": (1.0, 1.1),
    "c": (1.0, 0.9),
}
_LINES_PER_HELP = 15
_WAITING_S = 2.5
_POLL_S = 0.05


@dataclass(slots=True)
class Driving:
    """What keys have come to.

    Attributes:
        speed_m_s, turn_rad_s: how fast.
        speed_limit_m_s, turn_limit_rad_s: the most they can become.
        move: along x, y and z, and about z, each -1, 0 or 1.
    """

    speed_m_s: float = 0.5
    turn_rad_s: float = 1.0
    speed_limit_m_s: float = 1000.0
    turn_limit_rad_s: float = 1000.0
    move: tuple[int, int, int, int] = _STOP

    def press(self, key: str) -> list[str]:
        """Take a key, empty when none came in time; return what is printed."""
        if key not in _FACTORS:
            self.move = _MOVES.get(key, _STOP)
            return []
        speed, turn = _FACTORS[key]
        self.speed_m_s = min(self.speed_limit_m_s, self.speed_m_s * speed)
        self.turn_rad_s = min(self.turn_limit_rad_s, self.turn_rad_s * turn)
        texts = []
        if self.speed_m_s == self.speed_limit_m_s:
            texts.append("Linear speed limit reached!")
        if self.turn_rad_s == self.turn_limit_rad_s:
            texts.append("Angular speed limit reached!")
        return [*texts, self.text]

    @property
    def text(self) -> str:
        """The speeds in words."""
        return f"currently:\tspeed {self.speed_m_s}\tturn {self.turn_rad_s} "

    def publish(self, twists: TwistPublisher) -> None:
        """Publish the velocities."""
        x, y, z, turn = self.move
        speed = self.speed_m_s
        twists.publish(x * speed, y * speed, turn * self.turn_rad_s, z_m_s=z * speed)


@dataclass(frozen=True, slots=True)
class _Times:
    """Seconds; 0 for never."""

    key_s: float
    repeat_s: float


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 1: wait for somebody who listens, then drive until Ctrl-C or told to stop."""
    return _drive(arguments, graph, stop, is_ros2=arguments.ros_version == 2)


def run_ros2(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 2: the same without waiting, and without stopping when no key comes."""
    return _drive(arguments, graph, stop, is_ros2=True)


def _drive(arguments: NodeArguments, graph: Graph, stop: threading.Event, *, is_ros2: bool) -> int:
    # Who has looked is not ended in the midst: the terminal is put back.
    if stop.is_set():
        return 0
    with Keys("teleop_twist_keyboard", takes_ctrl_c=True) as keys:
        node = start_node(arguments, graph)
        with private_parameters(node, arguments, PARAMETERS) as own:
            driving = Driving(
                number_or_end(own, "speed"),
                number_or_end(own, "turn"),
                number_or_end(own, "speed_limit"),
                number_or_end(own, "turn_limit"),
            )
            rate = number_or_end(own, "repeat_rate")
            key_s = number_or_end(own, "key_timeout", 0.0 if is_ros2 else None)
            stamped, frame_id = own.flag("stamped"), own.text("frame_id")
        times = _Times(key_s, 1 / rate if rate > 0 else 0.0)
        twists = TwistPublisher(node, is_stamped=stamped, frame_id=frame_id)
        if is_ros2 or _wait_for_listener(twists, keys, stop):
            say(f"{_ROS2_HEAD if is_ros2 else _HEAD}{_HELP}\n{driving.text}")
            _loop(driving, twists, keys, times, stop)
        twists.stop()
        node.shutdown()
    return 0


def _wait_for_listener(twists: TwistPublisher, keys: Keys, stop: threading.Event) -> bool:
    """Wait until somebody subscribes; False when told to end first."""
    told_s = time.monotonic()
    while not twists.publisher.matched:
        if stop.is_set() or keys.read(_POLL_S) in {None, CTRL_C}:
            return False
        if time.monotonic() - told_s >= _WAITING_S:
            say(f"Waiting for subscriber to connect to {twists.publisher.topic}")
            told_s = time.monotonic()
    return True


def _loop(
    driving: Driving, twists: TwistPublisher, keys: Keys, times: _Times, stop: threading.Event
) -> None:
    lines, key_s, sent_s = 0, time.monotonic(), time.monotonic()
    while not stop.is_set():
        key = keys.read(_POLL_S if not times.repeat_s else min(_POLL_S, times.repeat_s / 2))
        now_s = time.monotonic()
        if key is None or key == CTRL_C:
            return
        is_late = not key and times.key_s > 0 and now_s - key_s >= times.key_s
        if key or (is_late and any(driving.move)):
            texts = driving.press(key)
            for text in texts:
                say(text)
            lines += bool(texts)
            if lines == _LINES_PER_HELP:
                say(f"{_HEAD}{_HELP}")
                lines = 0
            key_s = now_s
        elif not times.repeat_s or now_s - sent_s < times.repeat_s:
            continue
        driving.publish(twists)
        sent_s = now_s
