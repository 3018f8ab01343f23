"""The launch file of document LUCK before anything starts (L3, L4)."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.launch.environment import drop_in_folder

pytestmark = pytest.mark.tutorial

_LAUNCH = ("ros2", "launch", "luck_gazebo", "gazebo_moveit.launch.py")
_HARDWARE = ("mock_components/GenericSystem", "gazebo_ros2_control/GazeboSystem")
_HAS_MOVEIT = (drop_in_folder() / "moveit_configs_utils").is_dir()


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
    assert tree.text.count(".TimerAction object") == 5


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
