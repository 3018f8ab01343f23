"""Config packages of the Setup Assistant as their person uses them: plan, and execute in Gazebo."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched
from tests.shared_files import needs_shared

from gazelle.graph.actions import ActionClient
from gazelle.interfaces import action_type, fill

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_ARM_WS = Path(__file__).parents[2] / "examples" / "arm_ws"
_KIND = action_type("moveit_msgs/MoveGroup")
_GOAL = dict(
    zip([f"joint_{n}" for n in range(1, 7)], [0.4, 0.5, -0.6, 0.3, 0.4, -0.2], strict=True)
)
_READY = "You can start planning now!"
_SUCCESS = 1


def test_herons_own_config_package_is_replaced_by_a_made_one_and_the_arm_moves_in_gazebo(
    gazelle: Callable[..., Any], tmp_path: Path
) -> None:
    workspace = tmp_path / "arm_ws"
    shutil.copytree(_ARM_WS, workspace)
    made = tmp_path / "made"
    _make(gazelle, workspace, "src/heron_description/urdf/heron.urdf.xacro",
          "--name", "heron_made", "--into", str(made))  # fmt: skip
    own = workspace / "src" / "heron_moveit_config"
    shutil.rmtree(own)
    shutil.copytree(made / "heron_made", own)
    for file in own.rglob("*"):
        if file.is_file():
            text = file.read_text(encoding="utf-8")
            file.write_text(text.replace("heron_made", "heron_moveit_config"), encoding="utf-8")
    launched = gazelle("ros2", "launch", "heron_bringup", "heron.launch.py", cwd=workspace)
    launched.wait_for_line(_READY)
    _moves(launched, "/move_action", _GOAL)
    assert launched.stop() == 0


@needs_shared
@pytest.mark.parametrize(
    "launch",
    [
        ("demo.launch.py", "use_rviz:=false"),
        ("gazebo.launch.py", "gui:=false"),
    ],
    ids=["mock", "gazebo"],
)
def test_luck_plans_and_executes_with_a_made_package_of_ros_2(
    gazelle: Callable[..., Any], workspaces_dir: Path, tmp_path: Path, launch: tuple[str, ...]
) -> None:
    workspace = _luck(gazelle, workspaces_dir, tmp_path, "--ros2")
    launched = gazelle("ros2", "launch", "luck_made", *launch, cwd=workspace)
    launched.wait_for_line(_READY)
    _moves(launched, "/move_action", _GOAL)


@needs_shared
@pytest.mark.parametrize(
    "launch",
    [
        ("demo.launch", "use_rviz:=false"),
        ("demo_gazebo.launch", "use_rviz:=false", "gazebo_gui:=false"),
    ],
    ids=["fake", "gazebo"],
)
def test_luck_plans_and_executes_with_a_made_package_of_ros_1(
    gazelle: Callable[..., Any], workspaces_dir: Path, tmp_path: Path, launch: tuple[str, ...]
) -> None:
    workspace = _luck(gazelle, workspaces_dir, tmp_path, "--ros1")
    launched = gazelle("roslaunch", "luck_made", *launch, cwd=workspace)
    launched.wait_for_line(_READY)
    _moves(launched, "/move_group", _GOAL, ros_version=1)


def _luck(gazelle: Callable[..., Any], workspaces: Path, folder: Path, version: str) -> Path:
    source = workspaces / "ros2_ws" / "src" / "luck_description"
    shutil.copytree(source, folder / "src" / "luck_description")
    robot = "src/luck_description/urdf/luck_description.urdf"
    _make(gazelle, folder, robot, version, "--name", "luck_made")
    return folder


def _make(gazelle: Callable[..., Any], workspace: Path, *words: str) -> None:
    made = gazelle("new", "moveit_config", *words, "--trials", "500", cwd=workspace)
    assert made.wait() == 0, made.text


def _moves(launched: Any, action: str, goal: Mapping[str, float], ros_version: int = 2) -> None:
    """Plan to positions of the arm's joints, execute, and look where they are."""
    client = ActionClient(launched.node, action, _KIND, ros_version=ros_version)
    assert client.wait_for_server(stretched()), launched.text
    rows = [
        {"joint_name": name, "position": value, "tolerance_above": 1e-4,
         "tolerance_below": 1e-4, "weight": 1.0}
        for name, value in goal.items()
    ]  # fmt: skip
    request: Any = _KIND.Goal()
    fill(request.request, {
        "group_name": "arm", "num_planning_attempts": 1, "allowed_planning_time": 10.0,
        "max_velocity_scaling_factor": 1.0, "max_acceleration_scaling_factor": 1.0,
        "goal_constraints": [{"joint_constraints": rows}],
    })  # fmt: skip
    sent = client.send_goal(request)
    assert sent.wait(stretched()), launched.text
    assert sent.result.error_code.val == _SUCCESS, launched.text
    message = launched.messages({"/joint_states": 3})["/joint_states"][-1]
    at = dict(zip(message.name, message.position, strict=True))
    assert {name: at[name] for name in goal} == pytest.approx(dict(goal), abs=0.02)
