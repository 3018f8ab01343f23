"""Which Python is taken for ROS's."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

import gazelle
from gazelle.bridge.ros2.interpreters import (
    Interpreter,
    candidates,
    child_environment,
    is_open,
    sourced_hint,
)
from gazelle.bridge.ros2.rclpy_process import start_rclpy
from gazelle.errors import GraphError


def program(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)
    return path


def test_named_python_is_the_only_one() -> None:
    assert candidates("/x/python", {"PATH": "/usr/bin"}) == (Interpreter("/x/python", "--python"),)


def test_python_of_the_ros2_command_comes_first(tmp_path: Path) -> None:
    python = program(tmp_path / "py" / "python3.12", "#!/bin/sh\n")
    command = program(tmp_path / "bin" / "ros2", f"#!{python}\n")
    found = candidates(None, {"PATH": str(command.parent), "AMENT_PREFIX_PATH": "/opt/ros/jazzy"})
    assert found[0] == Interpreter(str(python), f"the first line of {command}")
    assert found[-1] == Interpreter(sys.executable, "the Python that runs Gazelle")


def test_env_in_the_first_line_means_the_path(tmp_path: Path) -> None:
    python = program(tmp_path / "bin" / "python3", "#!/bin/sh\n")
    program(tmp_path / "bin" / "ros2", "#!/usr/bin/env python3\n")
    assert candidates(None, {"PATH": str(tmp_path / "bin")})[0].path == str(python)


def test_a_ros2_that_is_no_python_script_says_nothing(tmp_path: Path) -> None:
    program(tmp_path / "ros2", "#!/bin/sh\nexec python -m gazelle.cli ros2\n")
    found = candidates(None, {"PATH": str(tmp_path)})
    assert [one.path for one in found] == [sys.executable]


def test_stand_ins_of_gazelle_are_not_on_the_path_of_ros() -> None:
    drop_ins = str(Path(gazelle.__file__).parent / "compat" / "modules")
    found = child_environment({"PYTHONPATH": os.pathsep.join([drop_ins, "/opt/ros/x"]), "A": "b"})
    assert found == {"PYTHONPATH": "/opt/ros/x", "A": "b"}
    assert child_environment({"PYTHONPATH": drop_ins}) == {}


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET", True),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST", False),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF", False),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "nonsense", False),
        ("ROS_LOCALHOST_ONLY", "0", True),
        ("ROS_LOCALHOST_ONLY", "1", False),
        ("ROS_DOMAIN_ID", "3", False),
    ],
)
def test_only_the_user_opens_the_bridge_to_others(name: str, value: str, expected: bool) -> None:
    assert is_open({name: value}) is expected


def test_no_rclpy_is_told_with_every_python_that_was_tried(tmp_path: Path) -> None:
    mute = program(tmp_path / "mute", "#!/bin/sh\nexit 3\n")
    tried = [
        Interpreter(str(tmp_path / "none"), "--python"),
        Interpreter(str(mute), "test"),
        Interpreter(sys.executable, "the Python that runs Gazelle"),
    ]
    environ = {"PATH": os.defpath}
    with pytest.raises(GraphError) as caught:
        start_rclpy(tried, environ, lambda _: "source it")
    lines = str(caught.value).splitlines()
    assert lines[0] == "no Python with ROS 2's rclpy was found [bridge.no-rclpy]"
    assert lines[1].startswith(f"  {tmp_path}/none (--python): [Errno 2] No such file")
    assert lines[2] == f"  {mute} (test): it ended before it said anything (exit code 3)"
    assert "ModuleNotFoundError: No module named 'rclpy'" in lines[3]
    assert lines[4] == "  fix: source it"


def test_installed_ros_that_is_not_sourced_is_named(tmp_path: Path) -> None:
    program(tmp_path / "jazzy" / "setup.bash", "")
    hint = sourced_hint({}, tmp_path)
    assert hint == f"source {tmp_path}/jazzy/setup.bash in this shell, then start the bridge again"
    assert "gazelle bridge ros2 --python PATH" in sourced_hint({}, tmp_path / "none")
