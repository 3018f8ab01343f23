"""teleop_twist_keyboard: keys, speeds, timeouts, stamps."""

from __future__ import annotations

import termios
import threading

import pytest

from gazelle.errors import LaunchError
from gazelle.nodes.host import run_node
from gazelle.nodes.teleop.twist_keyboard import Driving

_NODE = "teleop_twist_keyboard/teleop_twist_keyboard.py"
_ROS2_NODE = "teleop_twist_keyboard/teleop_twist_keyboard"


def _is_taken(keyboard) -> bool:
    return keyboard.settings[3] & (termios.ECHO | termios.ISIG) == 0


@pytest.mark.parametrize(
    ("key", "move"),
    [
        ("i", (1, 0, 0, 0)), ("m", (-1, 0, 0, -1)), (".", (-1, 0, 0, 1)), ("J", (0, 1, 0, 0)),
        (">", (-1, -1, 0, 0)), ("t", (0, 0, 1, 0)), ("k", (0, 0, 0, 0)), ("?", (0, 0, 0, 0)),
    ],
)  # fmt: skip
def test_keys_around_k_move(key: str, move: tuple) -> None:
    driving = Driving(move=(1, 1, 1, 1))
    assert driving.press(key) == []
    assert driving.move == move


def test_speeds_change_by_a_tenth_while_it_goes_on() -> None:
    driving = Driving()
    driving.press("i")
    assert driving.press("q") == ["currently:\tspeed 0.55\tturn 1.1 "]
    driving.press("x")
    assert driving.speed_m_s == pytest.approx(0.495)
    driving.press("e")
    assert driving.turn_rad_s == pytest.approx(1.21)
    assert driving.move == (1, 0, 0, 0)


def test_limits_are_told_when_reached() -> None:
    driving = Driving(speed_limit_m_s=0.52, turn_limit_rad_s=1.05)
    texts = driving.press("q")
    assert texts[:2] == ["Linear speed limit reached!", "Angular speed limit reached!"]
    assert (driving.speed_m_s, driving.turn_rad_s) == (0.52, 1.05)


def test_waits_for_a_listener_then_drives_and_stops_when_no_key_comes(
    bench, keyboard, capfd
) -> None:
    bench.start(_NODE, "_key_timeout:=0.05", "_speed:=0.4")
    twists = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    text: list[str] = []

    def prompt() -> bool:
        text.append(capfd.readouterr().out)
        return "currently:\tspeed 0.4\tturn 1.0 " in "".join(text)

    bench.eventually(prompt)
    assert "Reading from the keyboard  and Publishing to Twist!" in "".join(text)
    keyboard.type("u")
    bench.eventually(lambda: (0.4, 1.0) in [(one.linear.x, one.angular.z) for one in twists])
    bench.eventually(lambda: (twists[-1].linear.x, twists[-1].angular.z) == (0.0, 0.0))
    count = len(twists)
    keyboard.type("\x03")
    assert bench.wait() == [0]
    bench.eventually(lambda: len(twists) == count + 1)
    assert keyboard.settings == keyboard.before


def test_ctrl_c_ends_the_waiting(bench, keyboard) -> None:
    bench.start(_NODE)
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("\x03")
    assert bench.wait() == [0]


def test_repeat_rate_sends_the_command_again(bench, keyboard) -> None:
    twists = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    bench.start(_NODE, "_repeat_rate:=100", "_key_timeout:=0")
    bench.eventually(lambda: _is_taken(keyboard) and twists)
    keyboard.type("J")
    bench.eventually(lambda: [one.linear.y for one in twists].count(0.5) >= 3)


def test_ros2_goes_on_without_keys_and_sends_stamps(bench, keyboard, capfd) -> None:
    twists = bench.listen("/cmd_vel", "geometry_msgs/msg/TwistStamped")
    words = ("-p", "stamped:=true", "-p", "frame_id:=base", "-p", "repeat_rate:=50.0")
    bench.start(_ROS2_NODE, "--ros-args", *words)
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("i")
    bench.eventually(lambda: [one.twist.linear.x for one in twists].count(0.5) > 5)
    assert twists[-1].header.frame_id == "base"
    assert bench.stop() == [0]
    assert "This node takes keypresses from the keyboard" in capfd.readouterr().out


def test_speed_that_is_no_number_is_named_and_the_terminal_put_back(bench, keyboard) -> None:
    with pytest.raises(LaunchError, match="'/teleop_twist_keyboard/speed' is 'fast', not a number"):
        run_node({"node": _NODE, "argv": ["_speed:=fast"]}, bench.graph, threading.Event())
    assert keyboard.settings == keyboard.before


def test_stamped_that_is_the_text_false_is_false(bench, keyboard) -> None:
    twists = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    bench.start(_ROS2_NODE, "--ros-args", "-p", "stamped:='false'", "-p", "repeat_rate:=50.0")
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("i")
    bench.eventually(lambda: any(one.linear.x == 0.5 for one in twists))


def test_unknown_parameters_are_told(bench, keyboard, capfd) -> None:
    bench.start(_NODE, "_spede:=0.4")
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("\x03")
    assert bench.wait() == [0]
    text = "parameter 'spede' is not one of teleop_twist_keyboard; it has no effect"
    assert text in "".join(capfd.readouterr())
