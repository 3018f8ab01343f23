"""turtle_teleop_key and mimic, with keys typed at a terminal."""

from __future__ import annotations

import io
import sys
import termios

import pytest

from gazelle.errors import LaunchError
from gazelle.interfaces import message_type
from gazelle.nodes.host import run_node

_NODE = "turtlesim/turtle_teleop_key"


def _is_taken(keyboard) -> bool:
    return keyboard.settings[3] & termios.ECHO == 0


@pytest.mark.parametrize(
    ("arrow", "linear", "angular"),
    [("\x1b[A", 2.0, 0.0), ("\x1b[B", -2.0, 0.0), ("\x1b[C", 0.0, -2.0), ("\x1b[D", 0.0, 2.0)],
)  # fmt: skip
def test_arrows_drive_and_q_ends(bench, keyboard, capsys, arrow, linear, angular) -> None:
    twists = bench.listen("/turtle1/cmd_vel", "geometry_msgs/msg/Twist")
    bench.start(_NODE)
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type(arrow)
    bench.eventually(lambda: twists)
    assert (twists[0].linear.x, twists[0].angular.z) == (linear, angular)
    keyboard.type("xq")
    assert bench.wait() == [0]
    assert len(twists) == 1
    assert keyboard.settings == keyboard.before
    assert capsys.readouterr().out == (
        "Reading from keyboard\n---------------------------\n"
        "Use arrow keys to move the turtle. 'q' to quit.\n"
    )


def test_scales_come_from_the_parameters_of_the_namespace(bench, keyboard) -> None:
    bench.node.parameters.set("/scale_linear", 0.5)
    twists = bench.listen("/turtle1/cmd_vel", "geometry_msgs/msg/Twist")
    bench.start(_NODE)
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("\x1b[A")
    assert bench.eventually(lambda: twists)[0].linear.x == 0.5
    assert bench.stop() == [0]
    assert keyboard.settings == keyboard.before


def test_ros2_letters_turn_the_turtle_to_headings(bench, keyboard, capfd) -> None:
    bench.start("turtlesim/turtlesim_node", "--ros-args")
    poses = bench.listen("/turtle1/pose", "turtlesim/msg/Pose")
    bench.start(_NODE, "--ros-args", "-p", "scale_angular:=0.25")
    bench.eventually(lambda: poses and _is_taken(keyboard))
    keyboard.type("t")
    bench.eventually(lambda: abs(poses[-1].theta - 0.7854) < 0.03)
    keyboard.type("d")
    bench.eventually(lambda: poses[-1].theta > 1.0)
    keyboard.type("f")
    bench.eventually(lambda: poses[-1].angular_velocity == 0.0)
    assert poses[-1].theta < 3.0
    keyboard.type("\x1b[D")
    bench.eventually(lambda: poses[-1].angular_velocity == 0.25)
    assert len(bench.stop()) == 2
    assert "Use G|B|V|C|D|E|R|T keys to rotate to absolute" in capfd.readouterr().out


def test_ros2_letter_without_a_turtle_is_told(bench, keyboard, capfd) -> None:
    bench.start(_NODE, "--ros-args")
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("gq")
    assert bench.wait() == [0]
    text = "".join(capfd.readouterr())
    assert "/turtle1/rotate_absolute" in text
    assert "Waiting for an action server" in text


def test_terminal_that_goes_away_ends_it(bench, keyboard) -> None:
    bench.start(_NODE)
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.hang_up()
    assert bench.wait() == [0]


def test_without_a_terminal_it_says_so(bench, monkeypatch) -> None:
    from threading import Event

    monkeypatch.setattr(sys, "stdin", io.StringIO())
    with pytest.raises(LaunchError, match="standard input is no terminal: start it in a terminal"):
        run_node({"node": _NODE, "argv": []}, bench.graph, Event())


@pytest.mark.parametrize(
    "rules",
    [
        ("input:=sim1/turtle1", "output:=sim2/turtle1"),
        ("/input/pose:=/sim1/turtle1/pose", "/output/cmd_vel:=/sim2/turtle1/cmd_vel"),
    ],
    ids=["namespaces", "topics"],
)
def test_mimic_passes_velocities_on(bench, rules) -> None:
    bench.start("turtlesim/mimic", *rules)
    twists = bench.listen("/sim2/turtle1/cmd_vel", "geometry_msgs/msg/Twist")
    pose = message_type("turtlesim/msg/Pose")
    out = bench.node.create_publisher("/sim1/turtle1/pose", pose)
    bench.eventually(lambda: out.matched)
    assert "/turtle_mimic" in bench.graph.node_names()
    out.publish(pose(linear_velocity=1.5, angular_velocity=-0.5))
    twist = bench.eventually(lambda: twists)[0]
    assert (twist.linear.x, twist.angular.z) == (1.5, -0.5)


def test_scale_below_the_node_of_ros1_has_no_effect_and_that_is_told(
    bench, keyboard, capfd
) -> None:
    bench.start(_NODE, "_scale_linear:=0.5")
    bench.eventually(lambda: _is_taken(keyboard))
    keyboard.type("q")
    assert bench.wait() == [0]
    text = "parameter 'scale_linear' (0.5) has no effect here: the node reads /scale_linear"
    assert text in "".join(capfd.readouterr())


@pytest.mark.parametrize(
    ("words", "name"),
    [((), "/scale_linear"), (("--ros-args", "-p", "scale_linear:=fast"), "/teleop_turtle/scale_l")],
    ids=["ros1", "ros2"],
)
def test_scale_that_is_no_number_ends_it(bench, keyboard, words, name) -> None:
    from threading import Event

    bench.node.parameters.set("/scale_linear", "fast")
    with pytest.raises(LaunchError, match=f"'{name}.*' is 'fast', not a number"):
        run_node({"node": _NODE, "argv": list(words)}, bench.graph, Event())
    assert keyboard.settings == keyboard.before
