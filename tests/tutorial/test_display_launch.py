"""``roslaunch urdf_tutorial display.launch model:=…`` without the window (T11), and an own one."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.tutorial


@pytest.mark.parametrize(
    "model", ["mobile_robot.urdf", "mobile_robot.urdf.xacro", "mobile_robot_visual.urdf"]
)
def test_every_wheel_has_a_place_in_the_tree(
    in_workspace: Callable, workspaces_dir: Path, model: str
) -> None:
    folder = workspaces_dir / "catkin_ws/src/urdf_tutorial"
    _check_tree(
        in_workspace(
            "roslaunch", "urdf_tutorial", "display.launch", f"model:=urdf/{model}", cwd=folder
        )
    )


@pytest.mark.parametrize("model", ["barrow.urdf", "barrow.urdf.xacro"])
def test_every_wheel_of_an_own_package_has_a_place_in_the_tree(
    gazelle: Callable, own_workspaces_dir: Path, model: str
) -> None:
    folder = own_workspaces_dir / "ros1/src/shown_robot"
    display = gazelle("roslaunch", "shown_robot", "show.launch", f"model:=urdf/{model}", cwd=folder)
    _check_tree(display)
    assert not re.search("error|warning|died", display.text)


def _check_tree(display: Any) -> None:
    wheels = {f"{where}_wheel" for where in ("left", "right")}
    found: set[str] = set()

    def complete() -> bool:
        for message in display.messages({"/tf": 1})["/tf"]:
            found.update(item.child_frame_id for item in message.transforms)
        return wheels <= found

    display.eventually(complete)
    joints = display.messages({"/joint_states": 1})["/joint_states"][0]
    assert set(joints.name) == {f"base_to_{where}_wheel" for where in ("caster", "left", "right")}


def test_mesh_robot_comes_up_and_stays(in_workspace: Callable, workspaces_dir: Path) -> None:
    folder = workspaces_dir / "catkin_ws/src/urdf_tutorial"
    display = in_workspace(
        "roslaunch",
        "urdf_tutorial",
        "display.launch",
        "model:=urdf/mobile_robot_stl.urdf",
        cwd=folder,
    )
    display.wait_for_line(r"process\[rviz-\d+\]: started")
    display.eventually(lambda: "/robot_state_publisher" in display.graph.node_names())
    assert " * /robot_description: <?xml" in display.text
    assert not re.search("error|warning|died", display.text)
