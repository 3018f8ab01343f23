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
    # Of the two 2011-style <controller:…> tags one has no effect: named once, with its place.
    # What the world says can come later than what the spawner does.
    line = robot.wait_for_line(r"warning:.*'libgazebo_ros_time\.so'")
    assert re.match(r".*/tutorial_controller/robot\.xml:\d+:\d+: warning:", line)
    assert robot.text.count("'libgazebo_ros_time.so'") == 1
    # The other is the controller manager, which drives both wheels by efforts.
    robot.wait_for_line("driven by efforts, as on the PR2")
    listed = robot.call(
        "/controller_manager/list_controllers", "controller_manager_msgs/srv/ListControllers"
    )
    assert list(listed.controller) == []
    world = robot.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")
    assert len(world.model_names) > 2, "the office has furniture"
    robot.messages({"/clock": 3})
