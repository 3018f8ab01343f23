"""The arm of document LUCK, by the launch file as it is printed (L3, L4, L5)."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.launch.environment import drop_in_folder
from gazelle.nodes.registry import builtin_node

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_LAUNCH = ("ros2", "launch", "luck_gazebo", "gazebo_moveit.launch.py")
_JOINTS = [f"joint_{number}" for number in range(1, 7)]
_HARDWARE = ("mock_components/GenericSystem", "gazebo_ros2_control/GazeboSystem")
# Of the launch file: seconds, and what starts then.
_TIMES = {"spawn_entity.py": 8.0, "spawner": 10.0, "move_group": 12.0, "rviz2": 17.0}
# A machine that does other things starts processes late, the first one too.
_FIRST_LATE_S = 5.0
_PATIENCE_S = 180.0
_HAS_MOVEIT = (drop_in_folder() / "moveit_configs_utils").is_dir()
_HAS_MOVE_GROUP = builtin_node("moveit_ros_move_group", "move_group") is not None
needs_moveit = pytest.mark.skipif(
    not (_HAS_MOVEIT and _HAS_MOVE_GROUP), reason="moveit_configs_utils or move_group is not here"
)


def _started(launched: Any, name: str) -> float:
    """Return the seconds from the first process to the one of a name, by launch's own log."""
    lines = _log(launched).splitlines()
    found = {
        match["name"]: float(match["time"])
        for line in reversed(lines)
        if (match := re.match(r"(?P<time>[\d.]+) \[INFO\] \[(?P<name>.*)-\d+\]: process st", line))
    }
    return found[name] - min(found.values())


def _log(launched: Any) -> str:
    line = launched.wait_for_line("All log files can be found below")
    folder = Path(line.rpartition("below ")[2])
    return (folder / "launch.log").read_text(encoding="utf-8")


def _positions(launched: Any) -> list[float]:
    message = launched.messages({"/joint_states": 1})["/joint_states"][-1]
    assert sorted(message.name) == _JOINTS
    by_name = dict(zip(message.name, message.position, strict=True))
    return [by_name[name] for name in _JOINTS]


@needs_moveit
def test_arm_comes_up_in_the_order_of_its_timers_and_holds_its_pose(
    gazelle: Callable[..., Any], workspaces_dir: Path
) -> None:
    arm = gazelle(*_LAUNCH, cwd=workspaces_dir / "ros2_ws")
    spawned = r"Spawn status: SpawnEntity: Successfully spawned entity \[luck_robot\]"
    arm.wait_for_line(spawned, _PATIENCE_S)
    poses = arm.messages({"/joint_states": 1}, _PATIENCE_S)["/joint_states"]
    arm.wait_for_line("Configured and activated test_group_controller", _PATIENCE_S)
    assert max(map(abs, [*poses[0].position, *_positions(arm)])) < 1e-3
    listed = arm.call(
        "/controller_manager/list_controllers", "controller_manager_msgs/srv/ListControllers"
    )
    assert {row.name: row.state for row in listed.controller} == {
        "joint_state_broadcaster": "active",
        "test_group_controller": "active",
    }
    hardware = arm.call(
        "/controller_manager/list_hardware_components",
        "controller_manager_msgs/srv/ListHardwareComponents",
    )
    types = {row.plugin_name or row.class_type for row in hardware.component}
    assert types == {_HARDWARE[1]}
    arm.wait_for_line(r"\[rviz2-\d+\]: process started", _PATIENCE_S)
    # The screen is told before the file.
    arm.eventually(lambda: "[rviz2-" in _log(arm), _PATIENCE_S)
    started = {name: _started(arm, name) for name in _TIMES}
    assert sorted(started, key=started.__getitem__) == list(_TIMES)
    for name, seconds in _TIMES.items():
        assert started[name] > seconds - _FIRST_LATE_S, started
    nodes = {"/move_group", "/rviz2"}
    arm.eventually(lambda: nodes <= set(arm.graph.node_names()), _PATIENCE_S)
    assert max(map(abs, _positions(arm))) < 1e-3
    # Nothing was complained about, and nothing of it is left.
    assert "[ERROR]" not in arm.text and ": error:" not in arm.text
    assert arm.stop() == 0
    assert arm.processes() == {}


def test_hardware_is_that_of_use_sim(gazelle: Callable[..., Any], workspaces_dir: Path) -> None:
    mock, gazebo = (f"<plugin>{name}</plugin>" for name in _HARDWARE)
    text = _expanded(gazelle, workspaces_dir, use_sim="false")
    assert mock in text and gazebo not in text
    text = _expanded(gazelle, workspaces_dir, use_sim="true")
    assert gazebo in text and mock not in text


def _expanded(gazelle: Callable[..., Any], workspaces_dir: Path, **arguments: str) -> str:
    folder = workspaces_dir / "ros2_ws" / "src" / "luck_robot" / "config"
    words = [f"{name}:={value}" for name, value in arguments.items()]
    positions = f"initial_positions_file:={folder / 'initial_positions.yaml'}"
    run = gazelle("xacro", str(folder / "luck_description.urdf.xacro"), positions, *words,
                  cwd=workspaces_dir / "ros2_ws")  # fmt: skip
    assert run.wait() == 0, run.text
    return str(run.text)


def test_launch_file_is_shown_without_being_launched(
    gazelle: Callable[..., Any], workspaces_dir: Path
) -> None:
    if not _HAS_MOVEIT:
        pytest.skip("moveit_configs_utils is not here")
    shown = gazelle(*_LAUNCH, "--show-args", cwd=workspaces_dir / "ros2_ws")
    assert shown.wait() == 0
    # moveit_configs_utils says before that which SRDF it takes.
    head = "Arguments (pass arguments as '<name>:=<value>'):"
    assert shown.lines[-3:] == [head, "", "  No arguments."]
    tree = gazelle(*_LAUNCH, "--print", cwd=workspaces_dir / "ros2_ws")
    assert tree.wait() == 0
    assert "ExecInPkg(pkg='robot_state_publisher', exec='robot_state_publisher')" in tree.text
    assert tree.text.count("timer.TimerAction object") == 5


def test_mistake_in_the_documents_file_is_shown_at_its_line(
    gazelle: Callable[..., Any], workspaces_dir: Path, tmp_path: Path
) -> None:
    source = workspaces_dir / "ros2_ws" / "src"
    for package in ("luck_gazebo", "luck_robot"):
        shutil.copytree(source / package, tmp_path / "src" / package, copy_function=shutil.copy)
    file = tmp_path / "src/luck_gazebo/launch/gazebo_moveit.launch.py"
    file.parent.chmod(0o755)
    file.chmod(0o644)
    text = file.read_text(encoding="utf-8")
    wrong = "get_package_share_directory('luck_gazbo')"
    file.write_text(text.replace("get_package_share_directory('luck_gazebo')", wrong))
    number = next(n for n, line in enumerate(text.splitlines(), 1) if "'luck_gazebo')" in line)
    if not _HAS_MOVEIT:
        pytest.skip("moveit_configs_utils is not here")
    launched = gazelle(*_LAUNCH, cwd=tmp_path)
    assert launched.wait() == 1
    assert f"gazebo_moveit.launch.py:{number}" in launched.text
    assert "package 'luck_gazbo' not found" in launched.text
    assert "did you mean 'luck_gazebo'" in launched.text
    assert "site-packages" not in launched.text and "/gazelle/" not in launched.text
