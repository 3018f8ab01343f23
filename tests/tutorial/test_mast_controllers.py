"""Controllers that a launch file starts hold a mast up and take gains: as M8–M11 print it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.interfaces import message_type, ros1_service_type

pytestmark = pytest.mark.tutorial

_LEAN = "/mast/lean_position_controller"
_CONTROLLERS = ("joint_state_controller", "lean_position_controller", "turn_position_controller")


def test_launch_starts_controllers_before_time_does_and_the_mast_stays_up(
    gazelle: Callable[..., Any], own_workspaces_dir: Path, free_port: int
) -> None:
    folder = own_workspaces_dir / "ros1"
    robot = gazelle("roslaunch", "leaning_mast", "mast.launch", "--fast", cwd=folder)
    robot.wait_for_line(r"Started controllers: .*joint_state_controller")
    kind = ros1_service_type("controller_manager_msgs/ListControllers")
    client = robot.node.create_client("/mast/controller_manager/list_controllers", kind)
    listed = client.call(kind._request_class(), timeout_s=stretched())
    assert sorted((row.name, row.state) for row in listed.controller) == [
        (name, "running") for name in _CONTROLLERS
    ]
    world = robot.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")
    assert world.sim_time == 0.0

    robot.call("/gazebo/unpause_physics", "std_srvs/srv/Empty")
    states = robot.messages({"/mast/joint_states": 101})["/mast/joint_states"]
    stamps_ns = [m.header.stamp.sec * 10**9 + m.header.stamp.nanosec for m in states]
    assert set(np.diff(stamps_ns)) == {20_000_000}
    assert states[-1].name == ["lean_joint", "turn_joint"]
    # Left alone it leans to its limit, 0.6 rad, within two seconds.
    assert np.abs(states[-1].position).max() < 0.02
    frames = {t.child_frame_id for m in robot.messages({"/tf": 20})["/tf"] for t in m.transforms}
    assert {"lower_link", "upper_link"} <= frames

    publisher = robot.node.create_publisher(f"{_LEAN}/command", "std_msgs/msg/Float64", latch=True)
    publisher.publish(message_type("std_msgs/Float64")(data=0.2))

    def lean() -> float:
        return float(robot.messages({"/mast/joint_states": 1})["/mast/joint_states"][0].position[0])

    robot.eventually(lambda: abs(lean() - 0.2) < 5e-3)

    words = ("rosrun", "dynamic_reconfigure", "dynparam")
    assert gazelle(*words, "set", f"{_LEAN}/pid", "p", "35.0", port=free_port).wait() == 0
    told = gazelle(*words, "get", f"{_LEAN}/pid", port=free_port)
    assert told.wait() == 0
    assert "'p': 35.0" in told.text
