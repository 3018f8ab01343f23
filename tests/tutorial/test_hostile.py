"""A robot drives on, and every tool answers, whatever a program on the graph sends."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.fuzzing.hostile import Hostile
from tests.sets import few

pytestmark = [pytest.mark.tutorial, pytest.mark.slow(13)]

_WORKSPACE = Path(__file__).parents[2] / "examples" / "scout_ws"
_COUNT = 500
_TOOLS = (
    ("rostopic", "list"), ("rosnode", "list"), ("rosservice", "list"), ("rosparam", "list"),
    ("ros2", "topic", "list"), ("ros2", "node", "list"), ("rostopic", "info", "/cmd_vel"),
)  # fmt: skip


def test_scout_drives_and_tools_answer_after_hostile_calls_and_packets(
    gazelle: Callable[..., Any], free_port: int, next_port: Callable[[], int], tmp_path: Path
) -> None:
    untouched = _hash_of_empty_world(gazelle, next_port())
    world = gazelle("roslaunch", "scout_robot", "scout.launch", cwd=_WORKSPACE)
    world.wait_for_line("spawn_scout.*finished cleanly")
    hostile = Hostile(world.graph, world.node)
    for number in range(few(60, _COUNT)):
        hostile.do(number)
    hostile.close()
    assert _hash_of_empty_world(gazelle, next_port()) == untouched
    _see_it_drive(world)
    for words in _TOOLS:
        tool = gazelle(*words, port=free_port)
        assert tool.wait() == 0, tool.text
        assert "²" not in tool.text
    assert "Traceback" not in world.text
    assert world.popen.poll() is None
    assert world.stop() == 0, world.text


def _hash_of_empty_world(gazelle: Callable[..., Any], port: int) -> str:
    run = gazelle("gzserver", "--iters", "300", "--fast", "worlds/empty.world", port=port)
    assert run.wait() == 0, run.text
    return str(next(line.partition("state hash")[2] for line in run.lines if "state hash" in line))


def _see_it_drive(world: Any) -> None:
    """Put it back to where it began, for it may have been thrown far away, and drive."""
    world.call("/gazebo/reset_simulation", "std_srvs/srv/Empty")
    physics = {"time_step": 0.001, "max_update_rate": 1000.0, "gravity": {"z": -9.8}}
    kind = "gazebo_msgs/srv/SetPhysicsProperties"
    assert world.call("/gazebo/set_physics_properties", kind, **physics).success
    world.call("/gazebo/unpause_physics", "std_srvs/srv/Empty")
    odometry: list[Any] = []
    world.node.create_subscription("/odom", "nav_msgs/msg/Odometry", odometry.append)
    world.eventually(lambda: odometry)
    start = odometry[-1].pose.pose.position
    world.publish("/cmd_vel", "geometry_msgs/msg/Twist", linear={"x": 0.3})

    def moved() -> bool:
        now = odometry[-1].pose.pose.position
        return 0.2 < math.hypot(now.x - start.x, now.y - start.y) < math.inf

    world.eventually(moved)
