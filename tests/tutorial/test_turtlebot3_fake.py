"""Row T7: the published TurtleBot3 packages, a fake robot and its keyboard."""

from __future__ import annotations

import os
import termios
from collections.abc import Callable
from pathlib import Path

import pytest

pytestmark = pytest.mark.tutorial


def test_fake_waffle_is_driven_from_the_keyboard_and_echoed(
    gazelle: Callable, terminal: tuple[int, int], workspaces_dir: Path
) -> None:
    keys, seen = terminal
    before = termios.tcgetattr(seen)
    place = {"cwd": workspaces_dir / "turtlebot3_ws", "TURTLEBOT3_MODEL": "waffle"}
    robot = gazelle("roslaunch", "turtlebot3_fake", "turtlebot3_fake.launch", **place)
    robot.wait_for_line(r"process\[turtlebot3_fake_node-\d+\]: started")
    robot.messages({"/odom": 1, "/joint_states": 1, "/tf": 1})
    teleop = gazelle(
        "roslaunch", "turtlebot3_teleop", "turtlebot3_teleop_key.launch", stdin=seen, **place
    )
    teleop.wait_for_line("CTRL-C to quit")
    os.write(keys, b"w" * 12 + b"a")
    teleop.wait_for_line(r"currently:\tlinear vel 0\.1[12]\d*\t angular vel 0\.1 ")
    robot.eventually(
        lambda: (
            (twist := robot.messages({"/odom": 1})["/odom"][0].twist.twist).linear.x > 0.1
            and twist.angular.z == pytest.approx(0.1)
        )
    )
    echo = gazelle("rostopic", "echo", "-n1", "/odom", **place)
    assert echo.wait() == 0
    assert 'frame_id: "odom"' in echo.text
    assert 'child_frame_id: "base_footprint"' in echo.text
    # The robot's own links hang below the frame that the odometry moves.
    frames = {
        (one.header.frame_id, one.child_frame_id)
        for message in robot.messages({"/tf": 20})["/tf"]
        for one in message.transforms
    }
    assert {("odom", "base_footprint"), ("base_link", "wheel_left_link")} <= frames
    os.write(keys, b"\x03")
    assert teleop.wait() == 0
    assert termios.tcgetattr(seen) == before
    robot.eventually(lambda: robot.messages({"/odom": 1})["/odom"][0].twist.twist.linear.x == 0.0)
    assert robot.stop() == 0
