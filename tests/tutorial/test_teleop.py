"""``rosrun slam_robot slam_robot_teleop.py``, Python 2 source and all, at a terminal (S6)."""

from __future__ import annotations

import os
import pty
import termios
from collections.abc import Callable, Iterator
from typing import Any

import pytest

pytestmark = pytest.mark.tutorial


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    """A pseudo-terminal: the end where keys are typed, the end the program sees."""
    keys, seen = pty.openpty()
    yield keys, seen
    os.close(keys)
    os.close(seen)


def test_teleop_drives_forward_and_back_and_ctrl_c_stops_the_robot(
    in_workspace: Callable, terminal: tuple[int, int]
) -> None:
    keys, seen = terminal
    before = termios.tcgetattr(seen)
    robot = in_workspace("roslaunch", "slam_robot", "slam_robot_gazebo.launch")
    robot.wait_for_line("Successfully spawned")
    speeds: list[float] = []
    commands: list[float] = []
    listen = robot.node.create_subscription
    odometry, twist = "nav_msgs/msg/Odometry", "geometry_msgs/msg/Twist"
    listen("/odom", odometry, lambda message: speeds.append(message.twist.twist.linear.x))
    listen("/cmd_vel", twist, lambda message: commands.append(message.linear.x))

    teleop = in_workspace("rosrun", "slam_robot", "slam_robot_teleop.py", stdin=seen)
    teleop.wait_for_line("CTRL-C to quit")

    def typed(key: bytes, arrived: Callable[[], Any]) -> None:
        """Hold a key down until something is so."""

        def press() -> bool:
            os.write(keys, key)
            return bool(arrived())

        robot.eventually(press)

    typed(b"i", lambda: speeds and speeds[-1] > 0.05)
    typed(b",", lambda: speeds[-1] < -0.05)
    typed(b"\x03", lambda: teleop.popen.poll() is not None)
    assert teleop.wait() == 0
    robot.eventually(lambda: commands[-1] == 0.0 and abs(speeds[-1]) < 0.005)
    assert termios.tcgetattr(seen) == before
    assert "translated on the fly; the file stays as it is [launch.python2]" in teleop.text
    assert "currently:\tspeed 1\tturn 1" in teleop.text
