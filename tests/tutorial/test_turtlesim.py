"""Rows T1 and T4's beginning: a turtle drawn and driven from the keyboard, both generations."""

from __future__ import annotations

import math
import os
import re
import signal
import termios
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest

pytestmark = pytest.mark.tutorial


@pytest.fixture(scope="module")
def core(module_gazelle: Callable) -> Any:
    """A graph that all tests are on, one after the other."""
    core = module_gazelle("roscore")
    core.wait_for_line("setting /run_id to")
    return core


@pytest.fixture
def run(gazelle: Callable, core: Any) -> Callable:
    """Runs ``gazelle WORDS…`` on that graph; what it started ends with the test."""
    return partial(gazelle, port=core.port)


def test_arrow_keys_drive_the_turtle_and_the_picture_shows_it(
    run: Callable, core: Any, terminal: tuple[int, int], tmp_path
) -> None:
    from PIL import Image

    keys, seen = terminal
    before = termios.tcgetattr(seen)
    simulator = run("rosrun", "turtlesim", "turtlesim_node", "_png:=turtle.png")
    simulator.wait_for_line(r"Spawning turtle \[turtle1\] at x=\[5\.544445\], y=\[5\.544445\]")
    teleop = run("rosrun", "turtlesim", "turtle_teleop_key", stdin=seen)
    teleop.wait_for_line("Use arrow keys to move the turtle. 'q' to quit.")
    core.messages({"/turtle1/pose": 1})
    poses: list = []
    core.node.create_subscription("/turtle1/pose", "turtlesim/msg/Pose", poses.append)
    os.write(keys, b"\x1b[A")
    core.eventually(lambda: poses and poses[-1].x > 7.0 and poses[-1].linear_velocity == 0.0)
    # A key holds for one second at 2 m/s.
    assert poses[-1].x == pytest.approx(5.544 + 2.0, abs=0.1)
    os.write(keys, b"\x1b[D")
    core.eventually(lambda: poses[-1].theta > 1.5 and poses[-1].angular_velocity == 0.0)
    assert poses[-1].theta == pytest.approx(2.0, abs=0.1)
    os.write(keys, b"q")
    assert teleop.wait() == 0
    assert termios.tcgetattr(seen) == before
    assert simulator.stop() == 0
    with Image.open(tmp_path / "turtle.png") as image:
        assert image.getpixel((300, 250)) == (0xB3, 0xB8, 0xFF)
        assert image.getpixel((300, 100)) == (69, 86, 255)


def test_ctrl_c_ends_the_keyboard_without_a_trace(run: Callable, terminal) -> None:
    _keys, seen = terminal
    before = termios.tcgetattr(seen)
    teleop = run("rosrun", "turtlesim", "turtle_teleop_key", stdin=seen)
    teleop.wait_for_line("'q' to quit")
    assert teleop.stop() == 0
    assert "Traceback" not in teleop.text
    assert termios.tcgetattr(seen) == before


def test_keyboard_without_a_terminal_says_what_to_do(run: Callable) -> None:
    teleop = run("rosrun", "turtlesim", "turtle_teleop_key", stdin=-3)
    assert teleop.wait() == 1
    assert "standard input is no terminal: start it in a terminal of its own" in teleop.text


def test_mimic_of_the_tutorial_goes_the_same_way(gazelle: Callable, tmp_path) -> None:
    # wiki.ros.org/ROS/Tutorials/UsingRqtconsoleRoslaunch, with names of our own.
    (tmp_path / "two.launch").write_text(
        '<launch><group ns="one"><node pkg="turtlesim" name="sim" type="turtlesim_node"/></group>'
        '<group ns="two"><node pkg="turtlesim" name="sim" type="turtlesim_node"/></group>'
        '<node pkg="turtlesim" name="mimic" type="mimic"><remap from="input" to="one/turtle1"/>'
        '<remap from="output" to="two/turtle1"/></node></launch>'
    )
    launch = gazelle("roslaunch", "two.launch")
    launch.wait_for_line("setting /run_id to")
    launch.messages({"/two/turtle1/pose": 1})
    poses: list = []
    launch.node.create_subscription("/two/turtle1/pose", "turtlesim/msg/Pose", poses.append)
    launch.publish(
        "/one/turtle1/cmd_vel",
        "geometry_msgs/msg/Twist",
        linear={"x": 1.0},
        angular={"z": math.pi / 2},
    )
    launch.eventually(lambda: poses and poses[-1].angular_velocity == pytest.approx(math.pi / 2))
    assert poses[-1].linear_velocity == 1.0
    assert launch.stop() == 0


def test_ros2_run_starts_ros2s_turtlesim(run: Callable) -> None:
    words = ("--ros-args", "--remap", "__node:=my_turtle")
    simulator = run("ros2", "run", "turtlesim", "turtlesim_node", *words)
    simulator.wait_for_line(r"^\[INFO\] \[\d+\.\d{9}\] \[my_turtle\]: Spawning turtle \[turtle1\]")
    listed = run("ros2", "param", "list", "/my_turtle")
    assert listed.wait() == 0
    assert [line.strip() for line in listed.lines] == [
        "background_b", "background_g", "background_r", "holonomic", "use_sim_time",
    ]  # fmt: skip
    turning = run(
        "ros2", "action", "send_goal", "/turtle1/rotate_absolute",
        "turtlesim/action/RotateAbsolute", "{theta: 0.5}",
    )  # fmt: skip
    assert turning.wait() == 0
    assert "Goal finished with status: SUCCEEDED" in turning.text
    assert simulator.stop(signal.SIGTERM) == 0


def test_recording_everything_leaves_the_picture_out(run: Callable, core: Any, tmp_path) -> None:
    simulator = run("rosrun", "turtlesim", "turtlesim_node")
    simulator.wait_for_line("Spawning turtle")
    core.messages({"/turtle1/pose": 1})
    recording = run("rosbag", "record", "-a", "-O", "all", "--duration=1")
    assert recording.wait() == 0
    info = run("rosbag", "info", "all.bag")
    assert info.wait() == 0
    assert re.search(r"/turtle1/color_sensor +\d+ msgs +: turtlesim/Color", info.text)
    assert re.search(r"/turtle1/pose +\d+ msgs +: turtlesim/Pose", info.text)
    assert "canvas" not in info.text
    assert (tmp_path / "all.bag").stat().st_size < 500_000
