"""``roslaunch tutorial_controller robot.launch`` of 2011, as it is (P1, P2)."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

pytestmark = pytest.mark.tutorial


def test_the_old_launch_comes_up_and_says_what_has_no_effect(in_workspace: Callable) -> None:
    robot = in_workspace("roslaunch", "tutorial_controller", "robot.launch")
    robot.wait_for_line(r"Spawn status: SpawnModel: Successfully spawned entity")
    state = robot.call(
        "/gazebo/get_model_properties", "gazebo_msgs/srv/GetModelProperties", model_name="pr2"
    )
    assert state.success
    assert {"base_link", "wheel1", "wheel2"} <= set(state.body_names)
    # The two 2011-style <controller:…> tags: named, with their place, each once.
    for name in ("libgazebo_ros_time.so", "libgazebo_ros_controller_manager.so"):
        told = [line for line in robot.lines if f"'{name}'" in line and "warning:" in line]
        assert len(told) == 1
        assert re.match(r".*/tutorial_controller/robot\.xml:\d+:\d+: warning:", told[0])
    world = robot.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")
    assert len(world.model_names) > 2, "the office has furniture"
    robot.messages({"/clock": 3})
